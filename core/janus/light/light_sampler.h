// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "janus/light/light.h"
#include "janus/math/discrete.h"

namespace janus {

// Chooses a light. Emission and illumination have probabilities of their own; every weight uses
// the one that belongs to its technique.
class LightSampler {
 public:
  LightSampler() = default;
  explicit LightSampler(const std::vector<std::unique_ptr<Light>>& lights);

  bool emits() const { return !emission_.empty(); }
  bool illuminates() const { return !illumination_.empty(); }

  // `u` comes back rescaled to [0, 1). Only if emits().
  size_t sample_emission(float& u) const { return emission_.sample(u, &u); }
  float pmf_emission(size_t light) const { return emission_.pmf(light); }

  // For a receiver (the choice does not depend on where it is). Only if illuminates().
  size_t sample_illumination(vec3 /*receiver*/, float& u) const {
    return illumination_.sample(u, &u);
  }
  float pmf_illumination(vec3 /*receiver*/, size_t light) const {
    return illuminates() ? illumination_.pmf(light) : 0.0f;
  }

 private:
  DiscreteDistribution emission_, illumination_;
};

}  // namespace janus
