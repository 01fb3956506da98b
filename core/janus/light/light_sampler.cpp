// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/light/light_sampler.h"

#include <algorithm>

#include "janus/math/warp.h"

namespace janus {

namespace {

// Power is a poor guide where a weak lamp is close or a strong one hidden: a share of the choices
// is uniform.
DiscreteDistribution by_power(std::vector<float> weights, float uniform) {
  float total = 0.0f;
  int count = 0;
  for (const float w : weights) {
    total += w;
    count += w > 0.0f ? 1 : 0;
  }
  for (float& w : weights) {
    if (w > 0.0f) {
      w = (1.0f - uniform) * w / total + uniform / count;
    }
  }
  return DiscreteDistribution(weights);
}

// Where both kinds of light may shine, neither gets less than this.
constexpr float kLeastShare = 0.1f;

}  // namespace

LightSampler::LightSampler(const LightList& lights) {
  std::vector<float> emission;
  std::vector<Emitter> finite;
  for (size_t i = 0; i < lights.size(); ++i) {
    const auto light = static_cast<uint32_t>(i);
    const bool shines = (lights[i]->visibility & kLabels) != 0;  // on anything
    emission.push_back(shines ? lights[i]->power() : 0.0f);
    first_.push_back(finite.size());
    infinite_of_.push_back(-1);
    uint32_t primitive = 0;
    for (Emitter& emitter : lights[i]->emitters()) {
      emitter.strength = shines ? emitter.strength : 0.0f;
      emitter.links = link_bit(lights[i]->link_set);
      const EmitterId id{light, primitive++};
      if (!emitter.infinite) {
        finite.push_back(emitter);
        emitters_.push_back(id);
      } else if (emitter.strength > 0.0f) {
        infinite_of_.back() = static_cast<int32_t>(infinite_.size());
        infinite_.push_back({id, emitter.axis, cos_sin(emitter.theta_o).x,
                             cos_sin(emitter.theta_o).y, emitter.strength, emitter.links});
      }
    }
  }
  emission_ = by_power(std::move(emission), 0.1f);
  tree_ = LightTree(finite);
}

float LightSampler::importance(const Infinite& light, const Receiver& receiver) {
  if (!shines_on(light.links, receiver.unlit_by)) {
    return 0.0f;
  }
  return light.strength * cos_receiver(receiver, light.axis, light.cos_o, light.sin_o);
}

float LightSampler::infinite_importance(const Receiver& receiver) const {
  float sum = 0.0f;
  for (const Infinite& light : infinite_) {
    sum += importance(light, receiver);
  }
  return sum;
}

float LightSampler::share_infinite(const Receiver& receiver, float importance) const {
  if (tree_.empty()) {
    return 1.0f;
  }
  if (infinite_.empty()) {
    return 0.0f;
  }
  const float finite = tree_.importance(receiver);
  if (importance > 0.0f && finite > 0.0f) {
    return std::clamp(importance / (importance + finite), kLeastShare, 1.0f - kLeastShare);
  }
  return importance > 0.0f ? 1.0f : finite > 0.0f ? 0.0f : 0.5f;
}

float LightSampler::pmf_infinite(const Infinite& light, const Receiver& receiver, float sum) const {
  const auto count = static_cast<float>(infinite_.size());
  return sum > 0.0f ? importance(light, receiver) / sum : 1.0f / count;
}

LightChoice LightSampler::sample_illumination(const Receiver& receiver, float u) const {
  const float sum = infinite_importance(receiver);
  const float share = share_infinite(receiver, sum);
  if (u >= share) {
    const double rest = std::min((static_cast<double>(u) - share) / (1.0 - share), 1.0 - 0x1p-53);
    const LightTree::Choice choice = tree_.sample(receiver, rest);
    const EmitterId id = emitters_[choice.emitter];
    return {id.light, id.primitive, (1.0f - share) * choice.pmf};
  }
  double rest = static_cast<double>(u) / share;
  const Infinite* chosen = nullptr;
  float pmf = 0.0f;
  for (const Infinite& light : infinite_) {
    const float p = pmf_infinite(light, receiver, sum);
    if (p > 0.0f) {  // the last one of these where rounding leaves a rest
      chosen = &light;
      pmf = p;
      if (rest < p) {
        break;
      }
      rest -= p;
    }
  }
  return {chosen->id.light, chosen->id.primitive, share * pmf};
}

float LightSampler::pmf_illumination(const Receiver& receiver, size_t light,
                                     uint32_t primitive) const {
  if (!illuminates()) {
    return 0.0f;
  }
  const int32_t infinite = infinite_of_[light];
  const size_t first = first_[light];
  const bool in_tree = infinite < 0 && first + primitive < emitters_.size() &&
                       emitters_[first + primitive].light == light;
  if (infinite < 0 && !in_tree) {
    return 0.0f;  // left out of next event estimation
  }
  const float sum = infinite_importance(receiver);
  const float share = share_infinite(receiver, sum);
  if (infinite >= 0) {
    return share * pmf_infinite(infinite_[infinite], receiver, sum);
  }
  return (1.0f - share) * tree_.pmf(receiver, static_cast<uint32_t>(first + primitive));
}

}  // namespace janus
