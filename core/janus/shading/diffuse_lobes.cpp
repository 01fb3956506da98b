// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/shading/diffuse_lobes.h"

#include "janus/shading/diffuse.h"
#include "janus/shading/fresnel.h"
#include "janus/shading/microfacet.h"
#include "janus/shading/sheen.h"
#include "janus/shading/sides.h"

namespace janus {

namespace {

// --- Velvet --------------------------------------------------------------------------------------

// Ashikhmin et al., "A Microfacet-Based BRDF Generator" (2000), section 4, with the masking that
// Cycles has: f |wi . N|.
float velvet(float sigma, vec3 n, vec3 wo, vec3 wi) {
  const float cos_o = dot(n, wo), cos_i = dot(n, wi);
  if (!(cos_o > 0.0f && cos_i > 0.0f)) {
    return 0.0f;
  }
  const vec3 h = normalize(wo + wi);
  const float cos_h = dot(n, h), cos_d = dot(wo, h);
  if (!(std::abs(cos_h) < 1.0f - 1e-5f && cos_d > 1e-5f)) {
    return 0.0f;
  }
  const float sin2 = 1.0f - sqr(cos_h), inverse2 = 1.0f / sqr(sigma);
  const float d = std::exp(-sqr(cos_h) / sin2 * inverse2) * inverse2 * kInvPi / sqr(sin2);
  const float g = 2.0f * std::max(cos_h / cos_d, 1e-5f) * std::min(cos_o, cos_i);
  return 0.25f * d * std::min(1.0f, g) / cos_o;
}

// --- Toon ----------------------------------------------------------------------------------------

// The cone of a Toon lobe ends here.
float cone_angle(const Lobe& lobe) { return std::min(lobe.alpha + lobe.sigma, 0.5f * kPi); }

// Light at an angle to the axis: the whole of it, and less over that of `sigma`.
float toon_intensity(const Lobe& lobe, float angle) {
  if (angle < lobe.alpha) {
    return 1.0f;
  }
  return lobe.sigma > 0.0f ? std::max(0.0f, 1.0f - (angle - lobe.alpha) / lobe.sigma) : 0.0f;
}

// 1 - its cosine, with all digits.
float cone_opening(const Lobe& lobe) { return 2.0f * sqr(std::sin(0.5f * cone_angle(lobe))); }

vec3 sample_cone(const Lobe& lobe, vec3 axis, vec2 u) {
  return Frame(axis).to_world(square_to_cone(u, cone_opening(lobe)));
}

}  // namespace

float lit_bumps(vec3 n, vec3 ns, vec3 wi) {
  const float cos_i = dot(ns, wi), cos_n = dot(ns, n);
  if (cos_i * cos_n * dot(n, wi) < 0.0f || std::abs(cos_i) < 1e-6f) {
    return 0.0f;
  }
  const float tan2 = 1.0f / std::max(sqr(cos_n), 1e-12f) - 1.0f;
  const float alpha2 = std::clamp(0.125f * tan2, 0.0f, 1.0f);
  return 1.0f / (1.0f + ggx_lambda(alpha2, std::abs(cos_i)));
}

float toon_density(const Lobe& lobe) { return 0.5f * kInvPi / cone_opening(lobe); }

// Diffuse lobes, on the side of wo or, of translucent ones, on the other one. Camera walks draw wi
// as the lobe scatters, mostly by the cosine to N. Light walks draw wo by the cosine to Ng, because
// the adjoint of the lobe is proportional to |wo . Ng|; this also reaches every wo for which the
// lobe is not zero.
LobeEval evaluate_diffuse(const Lobe& lobe, vec3 ng, const Directions& d) {
  if (d.same_side() == is_translucent(lobe.type)) {
    return {};
  }
  const float uniform = std::abs(d.wo_ng) * kInvPi;
  if (lobe.type == LobeType::Translucent) {
    const float cos_i = std::max(0.0f, -dot(d.wi, seen_normal(lobe, ng, d.wo, d.wo_ng)));
    return {lobe.weight * (cos_i * kInvPi), cos_i * kInvPi, uniform};
  }
  const vec3 n = facing_normal(lobe, d.wi_ng);
  const float cos_i = dot(d.wi, n);
  if (!(cos_i > 0.0f)) {
    return {};
  }
  LobeEval out{lobe.weight, cos_i * kInvPi, uniform};
  const vec3 wo = lobe.type == LobeType::RoughTranslucent ? mirrored(d.wo, n) : d.wo;
  const float cos_o = dot(wo, n);
  switch (lobe.type) {
    case LobeType::OrenNayar:
    case LobeType::RoughTranslucent:
      out.f *=
          OrenNayar(lobe.sigma).evaluate(std::max(0.0f, cos_o), cos_i, dot(wo, d.wi), lobe.color) *
          cos_i;
      break;
    case LobeType::Sheen: {
      const SheenLobe sheen(lobe.alpha, cos_o);
      out.pdf_radiance = sheen.albedo > 0.0f ? sheen.density(n, d.wo, d.wi) : 0.0f;
      out.f *= sheen.albedo * out.pdf_radiance;
      break;
    }
    case LobeType::Velvet:
      out.pdf_radiance = 0.5f * kInvPi;
      out.f *= velvet(lobe.sigma, n, d.wo, d.wi);
      break;
    case LobeType::DiffuseToon: {
      const float angle = angle_between(d.wi, n);
      if (angle >= cone_angle(lobe)) {
        return {Rgb(0.0f), 0.0f, uniform};
      }
      out.pdf_radiance = toon_density(lobe);
      out.f *= out.pdf_radiance * toon_intensity(lobe, angle);
      break;
    }
    case LobeType::Subsurface:
      return {};  // it scatters nothing here: see subsurface.h
    default:
      out.f *= out.pdf_radiance;
  }
  // Velvet is glossy for Cycles, and what comes through a surface is dimmed by it only where next
  // event estimation finds the light.
  if (lobe.bumped && lobe.type != LobeType::Velvet && lobe.type != LobeType::RoughTranslucent) {
    out.f *= lit_bumps(n, d.ns, d.wi);
  }
  return out;
}

std::optional<vec3> sample_diffuse(const Lobe& lobe, vec3 ng, vec3 from, vec2 u,
                                   TransportMode mode) {
  const float from_ng = dot(from, ng);
  const vec3 ng_from = from_ng < 0.0f ? -ng : ng;
  const bool transmitted = is_translucent(lobe.type);
  vec3 axis = ng_from, to;
  if (mode == TransportMode::Radiance) {
    axis = lobe.type == LobeType::Translucent ? seen_normal(lobe, ng, from, from_ng)
                                              : facing_normal(lobe, from_ng);
  } else if (!transmitted && dot(from, facing_normal(lobe, from_ng)) <= 0.0f) {
    return std::nullopt;  // this lobe is lit from behind its normal: its density is zero
  }
  const LobeType shape = mode == TransportMode::Radiance ? lobe.type : LobeType::Diffuse;
  switch (shape) {
    case LobeType::Sheen: {
      const SheenLobe sheen(lobe.alpha, dot(from, axis));
      if (sheen.albedo == 0.0f) {
        return std::nullopt;
      }
      to = sheen.sample(axis, from, u);
      break;
    }
    case LobeType::Velvet:
      to = Frame(axis).to_world(square_to_cone(u, 1.0f));
      break;
    case LobeType::DiffuseToon:
      to = sample_cone(lobe, axis, u);
      break;
    default:
      to = Frame(transmitted ? -axis : axis).to_world(square_to_cosine_hemisphere(u));
  }
  // A direction on the wrong side is refused here: for other lobes it may be a good one, but then
  // it would be drawn more often than their densities say.
  const float cos = dot(to, ng_from);
  return (transmitted ? cos < 0.0f : cos > 0.0f) ? std::optional(to) : std::nullopt;
}

// Reflections of the same cone from both sides.
LobeEval evaluate_glossy_toon(const Lobe& lobe, const Directions& d) {
  const vec3 n = facing_normal(lobe, d.wo_ng);
  if (!d.same_side() || !(dot(n, d.wo) > 0.0f && dot(n, d.wi) > 0.0f)) {
    return {};
  }
  const float angle = angle_between(reflect_about(d.wo, n), d.wi);
  if (angle >= cone_angle(lobe)) {
    return {};
  }
  const float density = toon_density(lobe);
  return {lobe.weight * (density * toon_intensity(lobe, angle)), density, density};
}

std::optional<vec3> sample_glossy_toon(const Lobe& lobe, vec3 ng, vec3 from, vec2 u) {
  const float from_ng = dot(from, ng);
  const vec3 n = facing_normal(lobe, from_ng);
  if (dot(n, from) <= 0.0f) {
    return std::nullopt;
  }
  const vec3 to = sample_cone(lobe, reflect_about(from, n), u);
  return dot(to, n) > 0.0f && dot(to, ng) * from_ng > 0.0f ? std::optional(to) : std::nullopt;
}

}  // namespace janus
