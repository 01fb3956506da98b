// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/shading/surface_color.h"

#include "janus/shading/fresnel.h"
#include "janus/shading/scatter.h"

namespace janus {

SurfaceColor surface_color(const BsdfView& bsdf, vec3 wo) {
  SurfaceColor color;
  const bool back = dot(wo, bsdf.ng()) < 0.0f;
  const vec3 ng = back ? -bsdf.ng() : bsdf.ng();
  for (const Lobe& lobe : bsdf.lobes()) {
    const vec3 n = back ? -lobe.normal : lobe.normal;
    if (!is_ggx(lobe.type)) {
      color.diffuse += lobe.weight * (lobe.layered ? layer_transmittance(lobe, dot(wo, n)) : 1.0f);
      continue;
    }
    const float cos = dot(wo, valid_normal(n, ng, wo));
    switch (lobe.type) {
      case LobeType::Metal:
        color.glossy += lobe.weight * (lobe.color + (1.0f - lobe.color) * schlick(cos));
        break;
      case LobeType::Specular:
        color.glossy += lobe.weight * (1.0f - layer_transmittance(lobe, cos));
        break;
      case LobeType::Glass: {
        const float reflected = fresnel_closure(cos, back ? 1.0f / lobe.ior : lobe.ior);
        color.glossy +=
            lobe.weight * reflected * (lobe.tinted_reflection ? lobe.color : Rgb(1.0f));
        color.transmission += lobe.weight * (1.0f - reflected) * lobe.color;
        break;
      }
      case LobeType::Refraction:
        color.transmission += lobe.weight;
        break;
      default:
        color.glossy += lobe.weight;
    }
  }
  return color;
}

}  // namespace janus
