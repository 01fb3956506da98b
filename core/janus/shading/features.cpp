// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/shading/features.h"

#include "janus/shading/scatter.h"
#include "janus/shading/surface_color.h"

namespace janus {

namespace {

// A GGX lobe is nearly smooth up to this width: Cycles compares the square of it (its roughness is
// the width) with that of 0.075.
constexpr float kSmoothAlpha = 0.075f;
// Of the weight, above which rough lobes are what is looked at.
constexpr float kRoughShare = 0.25f;

// `ns`: the surface's own, on the side of wo, which is that of fibres.
vec3 facing_normal(const Lobe& lobe, vec3 ng, vec3 ns, vec3 wo) {
  if (is_fiber(lobe.type)) {
    return ns;
  }
  const bool back = dot(wo, ng) < 0.0f;
  const vec3 n = back ? -lobe.normal : lobe.normal;
  return has_facets(lobe.type) ? valid_normal(n, back ? -ng : ng, wo) : n;
}

// Of the lobes that count(lobe) says; `ns` where there are none.
template <class Count>
vec3 mean_normal(const BsdfView& bsdf, vec3 ns, vec3 wo, Count&& count) {
  vec3 sum(0.0f);
  for (const Lobe& lobe : bsdf.lobes()) {
    if (count(lobe)) {
      sum += std::abs(average(lobe.weight)) * facing_normal(lobe, bsdf.ng(), ns, wo);
    }
  }
  const float length = glm::length(sum);
  return length > 0.0f ? sum / length : ns;
}

}  // namespace

vec3 average_normal(const BsdfView& bsdf, vec3 ns, vec3 wo) {
  return mean_normal(bsdf, ns, wo, [](const Lobe&) { return true; });
}

vec3 diffuse_normal(const BsdfView& bsdf, vec3 ns, vec3 wo) {
  return mean_normal(bsdf, ns, wo, [](const Lobe& lobe) { return is_diffuse(lobe.type); });
}

SurfaceFeatures surface_features(const BsdfView& bsdf, Rgb transparency, vec3 ns, vec3 wo) {
  SurfaceFeatures features;
  features.smooth = transparency;
  float sum = std::abs(average(transparency)), rough = 0.0f;
  features.normal = sum * ns;
  for (const Lobe& lobe : bsdf.lobes()) {
    const float weight = std::abs(average(lobe.weight));
    features.normal += weight * facing_normal(lobe, bsdf.ng(), ns, wo);
    sum += weight;
    const SurfaceColor color = surface_color(lobe, bsdf.ng(), wo);
    const Rgb albedo = color.diffuse + color.glossy + color.transmission;
    if (has_facets(lobe.type) && lobe.alpha * lobe.alpha_y <= sqr(kSmoothAlpha)) {
      features.smooth += albedo;
    } else {
      features.albedo += albedo;
      rough += weight;
    }
  }
  features.rough = sum == 0.0f || rough > kRoughShare * sum;
  features.normal = sum > 0.0f ? features.normal / sum : features.normal;
  return features;
}

}  // namespace janus
