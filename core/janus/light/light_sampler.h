// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "janus/light/light.h"
#include "janus/light/light_tree.h"
#include "janus/math/discrete.h"

namespace janus {

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
  explicit LightSampler(const LightList& lights);

  bool emits() const { return !emission_.empty(); }
  bool illuminates() const { return !tree_.empty() || !infinite_.empty(); }

  // `u` comes back rescaled to [0, 1). Only if emits().
  size_t sample_emission(float& u) const { return emission_.sample(u, &u); }
  float pmf_emission(size_t light) const { return emits() ? emission_.pmf(light) : 0.0f; }

  // An emitter for a receiver. Only if illuminates().
  LightChoice sample_illumination(const Receiver& receiver, float u) const;
  // The probability of that choice; above 0 for every emitter whose light can reach the receiver.
  float pmf_illumination(const Receiver& receiver, size_t light, uint32_t primitive) const;

 private:
  struct EmitterId {
    uint32_t light, primitive;
  };
  // Infinite lights stand outside the tree: there are few of them.
  struct Infinite {
    EmitterId id;
    vec3 axis;
    float cos_o, sin_o, strength;
    LinkMask links;
  };
  static float importance(const Infinite& light, const Receiver& receiver);
  float infinite_importance(const Receiver& receiver) const;
  float share_infinite(const Receiver& receiver, float importance) const;
  float pmf_infinite(const Infinite& light, const Receiver& receiver, float sum) const;

  DiscreteDistribution emission_;
  LightTree tree_;
  std::vector<EmitterId> emitters_;  // of the tree, by its numbers
  std::vector<Infinite> infinite_;
  std::vector<size_t> first_;         // by light: its first emitter
  std::vector<int32_t> infinite_of_;  // by light: index in infinite_, or -1
};

}  // namespace janus
