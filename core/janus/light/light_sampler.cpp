// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/light/light_sampler.h"

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

}  // namespace

LightSampler::LightSampler(const std::vector<std::unique_ptr<Light>>& lights) {
  std::vector<float> emission, illumination;
  for (size_t i = 0; i < lights.size(); ++i) {
    emission.push_back(lights[i]->power());
    first_.push_back(emitters_.size());
    uint32_t primitive = 0;
    for (const Emitter& emitter : lights[i]->emitters()) {
      emitters_.push_back({static_cast<uint32_t>(i), primitive++});
      illumination.push_back(emitter.power);
    }
  }
  emission_ = by_power(std::move(emission), 0.1f);
  illumination_ = by_power(std::move(illumination), 0.5f);
}

}  // namespace janus
