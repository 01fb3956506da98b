// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/shading/surface_color.h"

#include "janus/shading/albedo.h"
#include "janus/shading/facet_lobes.h"
#include "janus/shading/fresnel.h"
#include "janus/shading/hair.h"
#include "janus/shading/layers.h"
#include "janus/shading/sheen.h"

namespace janus {

SurfaceColor surface_color(const Lobe& lobe, vec3 front, vec3 wo) {
  SurfaceColor color;
  if (is_fiber(lobe.type)) {
    const bool reflects =
        lobe.type == LobeType::HairReflection || lobe.type == LobeType::ChiangReflection;
    (reflects ? color.glossy : color.transmission) = fiber_color(lobe, front, wo);
    return color;
  }
  const bool back = dot(wo, front) < 0.0f;
  const vec3 ng = back ? -front : front;
  const vec3 n = back ? -lobe.normal : lobe.normal;
  const Rgb lit = lobe.weight * covers_transmittance(lobe, front, wo);
  if (!has_facets(lobe.type)) {
    const float share =
        lobe.type == LobeType::Sheen ? SheenLobe(lobe.alpha, dot(wo, n)).albedo : 1.0f;
    (is_diffuse(lobe.type) ? color.diffuse : color.glossy) = share * lit;
    return color;
  }
  const float cos = dot(wo, valid_normal(n, ng, wo));
  const float eta = back ? 1.0f / lobe.ior : lobe.ior;
  const bool layer = lobe.type == LobeType::Specular || lobe.type == LobeType::Coat;
  const Rgb weight = lit * (layer ? Rgb(1.0f) : multiscatter_color(lobe, cos, eta));
  switch (lobe.type) {
    case LobeType::Metal:
      color.glossy =
          weight * (lobe.color + (1.0f - lobe.color) * schlick_reflectance(roughness(lobe), cos));
      break;
    case LobeType::Conductor:
      color.glossy = weight * reflectance(lobe, cos);
      break;
    case LobeType::Specular:
    case LobeType::Coat:
      color.glossy = weight * layer_reflectance(lobe, cos);
      break;
    case LobeType::Glass: {
      // As in Cycles, only the reflection of Principled's glass is that of a rough one.
      const GlassEvents events(lobe, cos, eta);
      color.glossy = weight * events.reflected;
      color.transmission = weight * events.transmitted;
      if (!lobe.tinted_reflection && eta > 1.0f && !film(lobe).exists()) {
        const Rgb f0 = glm::min(fresnel_normal(eta) * lobe.edge, Rgb(1.0f));
        color.glossy = weight * (f0 + (1.0f - f0) * dielectric_position(roughness(lobe), cos, eta));
      }
      break;
    }
    case LobeType::Refraction:
    case LobeType::MirroredGlossy:
      color.transmission = weight;
      break;
    default:
      color.glossy = weight;
  }
  return color;
}

SurfaceColor surface_color(const BsdfView& bsdf, vec3 wo) {
  SurfaceColor sum;
  for (const Lobe& lobe : bsdf.lobes()) {
    const SurfaceColor color = surface_color(lobe, bsdf.ng(), wo);
    sum.diffuse += color.diffuse;
    sum.glossy += color.glossy;
    sum.transmission += color.transmission;
  }
  return sum;
}

}  // namespace janus
