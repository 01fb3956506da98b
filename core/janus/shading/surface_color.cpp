// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/shading/surface_color.h"

#include "janus/shading/albedo.h"
#include "janus/shading/fresnel.h"
#include "janus/shading/hair.h"
#include "janus/shading/scatter.h"

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
  if (is_diffuse(lobe.type)) {
    color.diffuse = lobe.weight * (lobe.layered ? layer_transmittance(lobe, dot(wo, n)) : 1.0f);
    return color;
  }
  const float cos = dot(wo, valid_normal(n, ng, wo));
  const float eta = back ? 1.0f / lobe.ior : lobe.ior;
  const Rgb weight =
      lobe.weight *
      (lobe.type == LobeType::Specular ? Rgb(1.0f) : multiscatter_color(lobe, cos, eta));
  switch (lobe.type) {
    case LobeType::Metal:
      color.glossy = weight * (lobe.color + (1.0f - lobe.color) *
                                                schlick_reflectance(std::sqrt(lobe.alpha), cos));
      break;
    case LobeType::Specular:
      color.glossy = weight * (1.0f - layer_transmittance(lobe, cos));
      break;
    case LobeType::Glass: {
      // As in Cycles, only the reflection of Principled's glass is that of a rough one.
      const float smooth = fresnel_closure(cos, eta);
      const float reflected = lobe.tinted_reflection || eta <= 1.0f
                                  ? smooth
                                  : dielectric_reflectance(std::sqrt(lobe.alpha), cos, eta);
      color.glossy = weight * reflected * (lobe.tinted_reflection ? lobe.color : Rgb(1.0f));
      color.transmission = weight * (1.0f - smooth) * lobe.color;
      break;
    }
    case LobeType::Refraction:
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
