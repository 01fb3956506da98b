// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "janus/film/film.h"
#include "janus/path/roulette.h"

namespace janus {

// How small a contribution must be to risk its ray: thresholds by blocks of pixels, in proportion
// to the picture so far. They depend on whole passes alone, so they are the same with any number
// of threads, and a pass's own samples never decide over themselves.
class RouletteMap {
 public:
  // Learns from `film` before pass `pass`, at powers of two; before the first pass there is none.
  void update(const Film& film, int pass);

  // What a sample at `raster` is worth: about the value of its block, and no less than a tenth of
  // the frame's; 0 before there is a picture.
  float value(vec2 raster) const;

  // For a contribution to the film at `raster` (pixels of the full frame).
  Roulette at(vec2 raster) const;

 private:
  float block(vec2 raster) const;

  static constexpr int kBlock = 8;  // pixels

  FilmRect rect_;
  int columns_ = 0, rows_ = 0;
  std::vector<float> values_;  // by block; empty before there is a picture
  float floor_ = 0.0f;
};

}  // namespace janus
