// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/light/light_sampler.h"

namespace janus {

namespace {

// Power is a poor guide where a weak lamp is close or a strong one hidden: a share of the choices
// is uniform.
DiscreteDistribution by_power(const std::vector<std::unique_ptr<Light>>& lights, float uniform,
                              bool finite_only) {
  std::vector<float> weights;
  float total = 0.0f;
  int count = 0;
  for (const auto& light : lights) {
    const bool wanted = light->power() > 0.0f && !(finite_only && light->infinite());
    weights.push_back(wanted ? light->power() : 0.0f);
    total += weights.back();
    count += wanted ? 1 : 0;
  }
  for (float& w : weights) {
    if (w > 0.0f) {
      w = (1.0f - uniform) * w / total + uniform / count;
    }
  }
  return DiscreteDistribution(weights);
}

}  // namespace

LightSampler::LightSampler(const std::vector<std::unique_ptr<Light>>& lights)
    : emission_(by_power(lights, 0.1f, false)), illumination_(by_power(lights, 0.5f, true)) {}

}  // namespace janus
