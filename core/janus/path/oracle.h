// SPDX-License-Identifier: GPL-3.0-or-later
//
// The definition of the MIS weights, evaluated by brute force in double precision: the density of
// every technique as a product over the whole path (Veach 1997, eq. 10.9). Slow on purpose, and
// kept as the judge of path/mis.h, in tests and in the renderer's debug mode.
#pragma once

#include <cstdint>

#include "janus/path/connect.h"

namespace janus {

struct WeightCheck {
  uint64_t paths = 0;         // joins compared
  uint64_t by_class[4] = {};  // hit, nee, connection, splat
  double max_error = 0.0;     // largest |weight - definition|
  double sum_error = 0.0;     // sum of |weight - definition|
  uint64_t inaccurate = 0;    // joins with an error above 1e-4
  uint64_t degenerate = 0;    // joins left out: an edge too short for single precision
};

// Traces light path `index` and a camera path through `raster`, joins them in every way, and
// compares the recursion's weight of each join with the definition.
WeightCheck check_weights(const Scene& scene, const Camera& camera, vec2 raster,
                          Heuristic heuristic, const SampleCounts& counts,
                          const WalkSettings& settings, uint32_t seed, uint64_t index);

}  // namespace janus
