// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/shading/lobe.h"

#include "janus/math/pack.h"
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
  out.edge = Rgb(1.0f);
  out.normal = vec3(0.0f, 0.0f, 1.0f);
  out.ior = 1.0f;
  out.pmf_normal = out.pmf_grazing = 1.0f;
  return out;
}

Lobe facets_lobe(LobeType type, Rgb weight, FacetWidths alpha, bool multiscatter) {
  Lobe out = lobe(type, weight);
  out.alpha = std::clamp(alpha.x, 0.0f, 1.0f);
  out.alpha_y = std::clamp(alpha.y, 0.0f, 1.0f);
  if (out.alpha * out.alpha_y <= 2e-10f) {  // Cycles' threshold
    out.alpha = out.alpha_y = 0.0f;
  }
  if (out.alpha != out.alpha_y) {
    out.tangent = pack_direction(alpha.tangent);
  }
  out.multiscatter = multiscatter && out.alpha > 0.0f;
  return out;
}

// An index too close to 1 has no usable half vector: the light goes straight on.
void set_index(Lobe& lobe, float ior) {
  lobe.ior = ior;
  if (std::abs(ior - 1.0f) < 1e-4f) {
    lobe.ior = 1.0f;
    lobe.alpha = lobe.alpha_y = 0.0f;
    lobe.multiscatter = false;
  }
}

// Of facets that reflect `mean` of light from everywhere.
void set_bounces(Lobe& lobe, Rgb mean) {
  lobe.edge = multiple_bounces(mean, reflection_albedo_average(roughness(lobe)));
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

Lobe rough_translucent_lobe(Rgb weight, Rgb albedo, float roughness) {
  Lobe out = oren_nayar_lobe(weight, albedo, roughness);
  out.type = LobeType::RoughTranslucent;
  return out;
}

Lobe sheen_lobe(Rgb weight, float roughness, Rgb layer) {
  Lobe out = lobe(LobeType::Sheen, weight);
  out.alpha = std::clamp(roughness, 1e-3f, 1.0f);
  out.color = layer;
  return out;
}

Lobe velvet_lobe(Rgb weight, float sigma) {
  Lobe out = lobe(LobeType::Velvet, weight);
  out.sigma = std::clamp(sigma, 0.01f, 1.0f);
  return out;
}

Lobe toon_lobe(bool glossy, Rgb weight, float size, float smooth) {
  Lobe out = lobe(glossy ? LobeType::GlossyToon : LobeType::DiffuseToon, weight);
  out.alpha = 0.5f * kPi * std::clamp(size, 1e-5f, 1.0f);
  out.sigma = 0.5f * kPi * std::clamp(smooth, 0.0f, 1.0f);
  return out;
}

Lobe glossy_lobe(Rgb weight, FacetWidths alpha, bool multiscatter, Rgb color) {
  Lobe out = facets_lobe(LobeType::Glossy, weight, alpha, multiscatter);
  out.color = multiple_bounces(color, reflection_albedo_average(roughness(out)));
  return out;
}

Lobe ashikhmin_shirley_lobe(Rgb weight, FacetWidths alpha) {
  constexpr float kMirror = 1e-4f;  // Cycles' threshold
  if (std::max(alpha.x, alpha.y) <= kMirror) {
    return glossy_lobe(weight, 0.0f);
  }
  alpha.x = std::max(alpha.x, kMirror);
  alpha.y = std::max(alpha.y, kMirror);
  return facets_lobe(LobeType::AshikhminShirley, weight, alpha, false);
}

Lobe metal_lobe(Rgb weight, Rgb f0, FacetWidths alpha, bool multiscatter, Rgb edge) {
  Lobe out = facets_lobe(LobeType::Metal, weight, alpha, multiscatter);
  out.color = glm::clamp(f0, 0.0f, 1.0f);
  const Rgb untinted = out.color + (1.0f - out.color) * schlick(kEdgeCosine);
  out.edge = edge_factor(out.color, untinted * glm::clamp(edge, 0.0f, 1.0f));
  return out;
}

Lobe conductor_lobe(Rgb weight, Rgb n, Rgb k, FacetWidths alpha, bool multiscatter) {
  Lobe out = facets_lobe(LobeType::Conductor, weight, alpha, multiscatter);
  out.color = glm::max(n, Rgb(0.0f));
  out.edge = glm::max(k, Rgb(0.0f));
  return out;
}

Lobe specular_lobe(Rgb weight, float eta, FacetWidths alpha, bool multiscatter) {
  return specular_lobe(weight, eta, Rgb(fresnel_normal(eta)), alpha, multiscatter);
}

Lobe specular_lobe(Rgb weight, float eta, Rgb f0, FacetWidths alpha, bool multiscatter) {
  Lobe out = facets_lobe(LobeType::Specular, weight, alpha, multiscatter);
  out.ior = eta;
  out.color = glm::clamp(f0, 0.0f, 1.0f);
  const float straight = fresnel_normal(eta);
  const float position = std::clamp(
      (fresnel_dielectric_average(eta) - straight) / std::max(1.0f - straight, 1e-6f), 0.0f, 1.0f);
  set_bounces(out, out.color + (1.0f - out.color) * position);
  return out;
}

Lobe coat_lobe(Rgb weight, float eta, float alpha, float share, Rgb tint) {
  Lobe out = facets_lobe(LobeType::Coat, weight, alpha, true);
  out.ior = eta;
  out.sigma = share;
  out.color = tint;
  set_bounces(out, Rgb(fresnel_dielectric_average(eta)));
  return out;
}

Lobe glass_lobe(Rgb weight, Rgb tint, bool tinted_reflection, float ior, float alpha,
                bool multiscatter, Rgb f0_tint) {
  Lobe out = facets_lobe(LobeType::Glass, weight, alpha, multiscatter);
  out.color = tint;
  out.edge = f0_tint;
  out.tinted_reflection = tinted_reflection;
  set_index(out, ior);
  return out;
}

Lobe refraction_lobe(Rgb weight, float ior, float alpha) {
  Lobe out = facets_lobe(LobeType::Refraction, weight, alpha, false);
  set_index(out, ior);
  return out;
}

Lobe mirrored_glossy_lobe(Rgb weight, float alpha) {
  Lobe out = glossy_lobe(weight, alpha, true);
  out.type = LobeType::MirroredGlossy;
  return out;
}

Lobe with_film(Lobe lobe, float thickness, float ior) {
  lobe.sigma = std::max(thickness, 0.0f);
  lobe.tilt = std::max(ior, 1e-5f);
  return lobe;
}

Lobe with_beckmann(Lobe lobe) {
  lobe.beckmann = true;
  lobe.multiscatter = false;
  return lobe;
}

}  // namespace janus
