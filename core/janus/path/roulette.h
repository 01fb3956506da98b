// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "janus/math/vec.h"
#include "janus/sampling/sampler.h"

namespace janus {

// Russian roulette on contributions (Veach 1997, 10.3.2): one that is smaller than `threshold` is
// worth its ray only now and then, and then counts as much as the threshold. It plays before the
// ray is traced, and, on a bound, before the BSDFs are evaluated. Weights know nothing of it.
class Roulette {
 public:
  Roulette() = default;  // plays never
  explicit Roulette(float threshold) : threshold_(threshold) {}

  // Whether a contribution of about `size` (> 0) goes on; `scale` is divided by the probability.
  bool survives(float size, Sampler& sampler, float& scale) const {
    if (!(size < threshold_)) {
      return true;
    }
    const float q = size / threshold_;
    if (!(sampler.next_1d() < q)) {
      return false;
    }
    scale /= q;
    return true;
  }

 private:
  float threshold_ = 0.0f;
};

}  // namespace janus
