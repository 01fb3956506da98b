// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "janus/light/light.h"
#include "janus/math/discrete.h"

namespace janus {

// A surface point that wants light, as the choice of a light may depend on it. Both walks must
// describe a vertex in the same way: `n` is Ng on the side of the vertex's camera direction, which
// for a surface that does not transmit is the side of the light, too.
struct Receiver {
  vec3 p;
  vec3 n;
  bool two_sided;  // can light from behind `n` matter? (transmission)
};

struct LightChoice {
  size_t light;
  uint32_t primitive;
  float pmf;
};

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

  // An emitter for a receiver. Only if illuminates().
  LightChoice sample_illumination(const Receiver& /*receiver*/, float u) const {
    const size_t i = illumination_.sample(u);
    return {emitters_[i].light, emitters_[i].primitive, illumination_.pmf(i)};
  }
  // The probability of that choice.
  float pmf_illumination(const Receiver& /*receiver*/, size_t light, uint32_t primitive) const {
    return illuminates() ? illumination_.pmf(first_[light] + primitive) : 0.0f;
  }

 private:
  struct EmitterId {
    uint32_t light, primitive;
  };
  DiscreteDistribution emission_, illumination_;
  std::vector<EmitterId> emitters_;
  std::vector<size_t> first_;  // by light: its first emitter
};

}  // namespace janus
