// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace janus {

// A part of a pass: a range of its light paths, and some of its pixels, spread over the picture.
struct Wave {
  int pass = 0;
  size_t index = 0, count = 1;

  bool includes(size_t column, size_t row) const {
    return count == 1 || (column + 3 * row) % count == index;
  }
  // Of `total`, where the share of this wave begins, and where it ends.
  size_t begin(size_t total) const { return total * index / count; }
  size_t end(size_t total) const { return total * (index + 1) / count; }

  // Its `index`th part of `count`, as one of all of them.
  Wave part(size_t part, size_t parts) const { return {pass, index * parts + part, count * parts}; }
};

}  // namespace janus
