// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/shading/lobe.h"

#include "janus/shading/albedo.h"
#include "janus/shading/fresnel.h"
#include "janus/shading/scatter.h"

namespace janus {

namespace {

Lobe lobe(LobeType type, Rgb weight) {
  Lobe out{};
  out.type = type;
  out.weight = weight;
  out.color = Rgb(1.0f);
  out.normal = vec3(0.0f, 0.0f, 1.0f);
  out.ior = 1.0f;
  out.pmf_normal = out.pmf_grazing = 1.0f;
  return out;
}

Lobe ggx_lobe(LobeType type, Rgb weight, float alpha, bool multiscatter) {
  Lobe out = lobe(type, weight);
  out.alpha = std::clamp(alpha, 0.0f, 1.0f);
  if (sqr(out.alpha) <= 2e-10f) {  // Cycles' threshold
    out.alpha = 0.0f;
  }
  out.multiscatter = multiscatter && out.alpha > 0.0f;
  return out;
}

// An index too close to 1 has no usable half vector: the light goes straight on.
void set_index(Lobe& lobe, float ior) {
  lobe.ior = ior;
  if (std::abs(ior - 1.0f) < 1e-4f) {
    lobe.ior = 1.0f;
    lobe.alpha = 0.0f;
    lobe.multiscatter = false;
  }
}

}  // namespace

Lobe diffuse_lobe(Rgb weight) { return lobe(LobeType::Diffuse, weight); }

Lobe oren_nayar_lobe(Rgb weight, Rgb albedo, float roughness) {
  Lobe out = lobe(LobeType::OrenNayar, weight);
  out.color = glm::clamp(albedo, 0.0f, 1.0f);
  out.sigma = std::clamp(roughness, 0.0f, 1.0f);
  return out;
}

Lobe translucent_lobe(Rgb weight) { return lobe(LobeType::Translucent, weight); }

Lobe glossy_lobe(Rgb weight, float alpha, bool multiscatter, Rgb color) {
  Lobe out = ggx_lobe(LobeType::Glossy, weight, alpha, multiscatter);
  out.color = multiple_bounces(color, reflection_albedo_average(std::sqrt(out.alpha)));
  return out;
}

Lobe metal_lobe(Rgb weight, Rgb f0, float alpha, bool multiscatter) {
  Lobe out = ggx_lobe(LobeType::Metal, weight, alpha, multiscatter);
  out.color = glm::clamp(f0, 0.0f, 1.0f);
  return out;
}

Lobe specular_lobe(Rgb weight, float eta, float alpha, bool multiscatter) {
  Lobe out = ggx_lobe(LobeType::Specular, weight, alpha, multiscatter);
  out.ior = eta;
  out.color = Rgb(specular_bounces(eta, std::sqrt(out.alpha)));
  return out;
}

Lobe glass_lobe(Rgb weight, Rgb tint, bool tinted_reflection, float ior, float alpha,
                bool multiscatter) {
  Lobe out = ggx_lobe(LobeType::Glass, weight, alpha, multiscatter);
  out.color = tint;
  out.tinted_reflection = tinted_reflection;
  set_index(out, ior);
  return out;
}

Lobe refraction_lobe(Rgb weight, float ior, float alpha) {
  Lobe out = ggx_lobe(LobeType::Refraction, weight, alpha, false);
  set_index(out, ior);
  return out;
}

Lobe below(Lobe lobe, const Lobe& layer) {
  lobe.layered = true;
  lobe.alpha = layer.alpha;
  lobe.ior = layer.ior;
  lobe.multiscatter = layer.multiscatter;
  return lobe;
}

}  // namespace janus
