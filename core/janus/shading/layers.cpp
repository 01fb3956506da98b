// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/shading/layers.h"

#include "janus/shading/albedo.h"
#include "janus/shading/facet_lobes.h"
#include "janus/shading/fresnel.h"
#include "janus/shading/sheen.h"
#include "janus/shading/sides.h"

namespace janus {

namespace {

// Beer's law in a coat whose tint is that of light straight through it.
Rgb coat_tint(const Lobe& coat, float cos_o) {
  if (coat.color == Rgb(1.0f)) {
    return Rgb(1.0f);
  }
  const float cos_t = std::sqrt(std::max(1.0f - (1.0f - sqr(cos_o)) / sqr(coat.ior), 1e-6f));
  const Rgb tinted = glm::pow(coat.color, Rgb(1.0f / cos_t));
  return glm::max(1.0f + coat.sigma * (tinted - 1.0f), 0.0f);  // a share may be above 1
}

float remaining(float albedo) { return std::clamp(1.0f - albedo, 0.0f, 1.0f); }

}  // namespace

Rgb layer_reflectance(const Lobe& lobe, float cos_o) {
  const float rough = roughness(lobe);
  Rgb albedo;
  if (lobe.type == LobeType::Specular && film(lobe).exists()) {
    albedo = reflectance(lobe, cos_o);  // as in Cycles, of smooth facets
  } else {
    const Rgb f0 = lobe.type == LobeType::Coat ? Rgb(fresnel_normal(lobe.ior)) : lobe.color;
    albedo = f0 + (1.0f - f0) * dielectric_position(rough, cos_o, lobe.ior);
  }
  if (lobe.multiscatter) {
    // Cycles leaves the energy scale out of the layer's albedo, but not the loss to its colour.
    const float single = reflection_albedo(rough, cos_o);
    albedo *= single + lobe.edge * (1.0f - single);
  }
  return albedo;
}

Rgb layer_transmittance(const Lobe& layer, float cos_o) {
  switch (layer.type) {
    case LobeType::Sheen:
      return Rgb(remaining(max_component(layer.color) * SheenLobe(layer.alpha, cos_o).albedo));
    case LobeType::Coat:
      return remaining(layer.sigma * max_component(layer_reflectance(layer, cos_o))) *
             coat_tint(layer, cos_o);
    default:
      return Rgb(remaining(max_component(layer_reflectance(layer, cos_o))));
  }
}

Rgb through(const Lobe& layer, vec3 ng, vec3 wo) {
  const float wo_ng = dot(wo, ng);
  const vec3 n = layer.type == LobeType::Sheen ? facing_normal(layer, wo_ng)
                                               : seen_normal(layer, ng, wo, wo_ng);
  return layer_transmittance(layer, dot(wo, n)) * covers_transmittance(layer, ng, wo);
}

Rgb covers_transmittance(const Lobe& lobe, vec3 ng, vec3 wo) {
  return lobe.above ? through(*(&lobe - lobe.above), ng, wo) : Rgb(1.0f);
}

CoveredShare covered_share(const Lobe& lobe) {
  // Light walks arrive at grazing angles without the loss that the camera side sees.
  constexpr float kLeast = 0.25f;
  constexpr float kSheen = 0.2f;  // what it reflects, more or less
  CoveredShare share;
  for (const Lobe* layer = &lobe; layer->above;) {
    layer -= layer->above;
    if (layer->type == LobeType::Sheen) {
      share.normal *= 1.0f - kSheen;
      share.grazing *= 1.0f - kSheen;
    } else {
      const float whole = layer->type == LobeType::Coat ? layer->sigma : 1.0f;
      share.normal *= 1.0f - whole * max_component(straight_reflectance(*layer));
      share.grazing *= 1.0f - whole;
    }
  }
  return {std::max(kLeast, share.normal), std::max(kLeast, share.grazing)};
}

}  // namespace janus
