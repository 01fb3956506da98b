// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>

#include "janus/math/vec.h"

namespace janus {

// Cycles' clamping, a declared bias: no contribution adds more than its limit to a sample of a
// pixel, as a mean over the channels. It acts on what is added up: weighted by the other
// techniques, with its shadow ray, and a splat as it is divided among the light paths of a pass.
// Roulette divides what clamping has left, so that it changes no expectation.
class Clamp {
 public:
  Clamp() = default;
  // 0: no limit.
  Clamp(float direct, float indirect) : direct_(limit(direct)), indirect_(limit(indirect)) {}

  // Of a path of `edges` edges: with up to two, the light is seen directly or shines directly on
  // what is seen.
  Rgb operator()(Rgb value, int edges) const {
    const float sum = std::abs(value.x) + std::abs(value.y) + std::abs(value.z);
    const float most = edges > 2 ? indirect_ : direct_;
    return sum > most ? value * (most / sum) : value;
  }

 private:
  static constexpr float kNone = std::numeric_limits<float>::max();
  static float limit(float mean) { return mean > 0.0f ? 3.0f * mean : kNone; }

  float direct_ = kNone, indirect_ = kNone;
};

}  // namespace janus
