// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "janus/shading/lobe.h"
#include "janus/shading/node_reader.h"

namespace janus {

// What a closure node adds to a surface.
struct Closures {
  std::vector<Lobe> lobes;
  Rgb emission = Rgb(0.0f), transparency = Rgb(0.0f);
};

// The closures of a node (not Mix or Add) with constant inputs, in Cycles' meaning, times `share`.
// What is not supported is warned of through `reader`.
Closures make_closures(const NodeReader& reader, NodeOp op, float share);

}  // namespace janus
