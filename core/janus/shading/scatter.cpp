// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/shading/scatter.h"

#include "janus/shading/albedo.h"
#include "janus/shading/diffuse.h"
#include "janus/shading/fresnel.h"
#include "janus/shading/hair.h"
#include "janus/shading/microfacet.h"

namespace janus {

namespace {

// The lobe's normal on the side of the surface where a direction with cosine `w_ng` to Ng is. The
// side is decided by Ng alone, so that both walks agree on it.
vec3 facing_normal(const Lobe& lobe, float w_ng) {
  return w_ng < 0.0f ? -lobe.normal : lobe.normal;
}

// The normal of a GGX or Translucent lobe as seen from `w`. Values take it from the camera side;
// each density from the side that draws.
vec3 seen_normal(const Lobe& lobe, vec3 ng, vec3 w, float w_ng) {
  return valid_normal(facing_normal(lobe, w_ng), w_ng < 0.0f ? -ng : ng, w);
}

// Index of the far side relative to the side of a direction with cosine `w_ng` to Ng.
float far_index(const Lobe& lobe, float w_ng) { return w_ng < 0.0f ? 1.0f / lobe.ior : lobe.ior; }

// What Cycles leaves of light from `wi` on a diffuse lobe of normal `n` where the surface's own is
// `ns`: nothing where it is above one of them and below the other; and less towards the horizon
// where `n` is tilted, so that bumps do not end in the dark at once (Conty et al. 2019). Of light
// through a translucent lobe it does so only where it looked for the light: that is left out here.
float lit_bumps(vec3 n, vec3 ns, vec3 wi) {
  const float cos_i = dot(ns, wi), cos_n = dot(ns, n);
  if (cos_i * cos_n * dot(n, wi) < 0.0f || std::abs(cos_i) < 1e-6f) {
    return 0.0f;
  }
  const float tan2 = 1.0f / std::max(sqr(cos_n), 1e-12f) - 1.0f;
  const float alpha2 = std::clamp(0.125f * tan2, 0.0f, 1.0f);
  return 1.0f / (1.0f + ggx_lambda(alpha2, std::abs(cos_i)));
}

// Diffuse lobes. f |wi . N| is weight/pi max(0, wi . N), on the side of wo or on the other one.
// Camera walks draw wi by the cosine to N. Light walks draw wo by the cosine to Ng, because the
// adjoint of the lobe is proportional to |wo . Ng|; this also reaches every wo for which the lobe
// is not zero.
LobeEval evaluate_diffuse(const Lobe& lobe, vec3 ng, const Directions& d) {
  const bool translucent = lobe.type == LobeType::Translucent;
  if (d.same_side() == translucent) {
    return {};
  }
  const float uniform = std::abs(d.wo_ng) * kInvPi;
  if (translucent) {
    const float cos_i = std::max(0.0f, -dot(d.wi, seen_normal(lobe, ng, d.wo, d.wo_ng)));
    return {lobe.weight * (cos_i * kInvPi), cos_i * kInvPi, uniform};
  }
  const vec3 n = facing_normal(lobe, d.wi_ng);
  const float cos_i = dot(d.wi, n);
  if (!(cos_i > 0.0f)) {
    return {};
  }
  LobeEval out{lobe.weight, cos_i * kInvPi, uniform};
  const float cos_o = dot(d.wo, n);
  if (lobe.type == LobeType::OrenNayar) {
    out.f *=
        OrenNayar(lobe.sigma).evaluate(std::max(0.0f, cos_o), cos_i, dot(d.wo, d.wi), lobe.color) *
        cos_i;
  } else {
    out.f *= out.pdf_radiance;
  }
  if (lobe.layered) {
    out.f *= layer_transmittance(lobe, cos_o);
  }
  if (lobe.bumped) {
    out.f *= lit_bumps(n, d.ns, d.wi);
  }
  return out;
}

// Where the shading normal is not Ng, the normal that the camera side sees may be another one than
// the light side's, and light walks would miss pairs that have a value. A small share of their
// directions is therefore drawn by the cosine to Ng.
constexpr float kDefensive = 0.05f;
bool needs_defence(const Lobe& lobe, vec3 ng) { return lobe.normal != ng; }
float defensive_share(const Lobe& lobe, bool transmitted) {
  if (lobe.type == LobeType::Glass) {
    return 0.5f;
  }
  return transmitted == (lobe.type == LobeType::Refraction) ? 1.0f : 0.0f;
}

// Fresnel term of a facet under the cosine `cos`, for lobes that only reflect.
Rgb reflectance(const Lobe& lobe, float cos) {
  switch (lobe.type) {
    case LobeType::Metal:
      return lobe.color + (1.0f - lobe.color) * schlick(cos);
    case LobeType::Specular:
      return Rgb(fresnel_closure(cos, lobe.ior));
    default:
      return Rgb(1.0f);
  }
}

// Reflection and refraction at a facet of a Glass or Refraction lobe: what they keep, and the
// probability of choosing reflection. Both are the same from both ends of a refraction.
struct GlassEvents {
  Rgb reflected, transmitted;
  float pmf_reflect;

  GlassEvents(const Lobe& lobe, float cos, float eta) {
    const float f = fresnel_closure(cos, eta);
    if (lobe.type == LobeType::Refraction) {
      reflected = Rgb(0.0f);
      transmitted = Rgb(f < 1.0f ? 1.0f : 0.0f);  // total reflection is lost
      pmf_reflect = 0.0f;
    } else {
      reflected = lobe.tinted_reflection ? f * lobe.color : Rgb(f);
      transmitted = (1.0f - f) * lobe.color;
      const float r = average(reflected), t = average(transmitted);
      pmf_reflect = r + t > 0.0f ? r / (r + t) : 1.0f;
    }
  }
};

// Cycles' Multiscatter GGX, from the camera side: the share of light that facets scatter at once,
// and the colour of what bounces on.
struct Multiscatter {
  float albedo;
  Rgb bounces;
};
Multiscatter multiscatter(const Lobe& lobe, float cos_o, float eta) {
  const float rough = std::sqrt(lobe.alpha);
  float albedo;
  Rgb bounces = lobe.color;
  if (lobe.type == LobeType::Glass) {
    albedo = glass_albedo(rough, cos_o, eta);
    bounces = multiple_bounces(lobe.color, glass_albedo_average(rough, eta));
  } else {
    albedo = reflection_albedo(rough, cos_o);
    if (lobe.type == LobeType::Metal) {
      // The average of Schlick's term is F0 + (1 - F0) / 21.
      bounces = multiple_bounces(lobe.color + (1.0f - lobe.color) / 21.0f,
                                 reflection_albedo_average(rough));
    }
  }
  return {albedo, bounces};
}
Rgb energy_scale(const Lobe& lobe, float cos_o, float eta) {
  const auto [albedo, bounces] = multiscatter(lobe, cos_o, eta);
  return 1.0f + bounces * (1.0f / albedo - 1.0f);
}

LobeEval evaluate_reflection(const Lobe& lobe, const Directions& d, vec3 n, vec3 n_light) {
  if (lobe.type == LobeType::Refraction) {
    return {};
  }
  const vec3 h = normalize(d.wo + d.wi);
  const float alpha2 = sqr(lobe.alpha), cos_h = dot(d.wo, h);
  const float eta = far_index(lobe, d.wo_ng);
  float pmf = 1.0f;
  Rgb fresnel;
  if (lobe.type == LobeType::Glass) {
    const GlassEvents events(lobe, cos_h, eta);
    fresnel = events.reflected;
    pmf = events.pmf_reflect;
  } else {
    fresnel = reflectance(lobe, cos_h);
  }
  LobeEval out;
  const float cos_o = dot(d.wo, n), cos_i = dot(d.wi, n);
  if (cos_o > 0.0f && cos_i > 0.0f) {
    const float common = 0.25f * ggx_distribution(alpha2, n, h) / cos_o;
    const float lambda_o = ggx_lambda(alpha2, cos_o), lambda_i = ggx_lambda(alpha2, cos_i);
    out.f = lobe.weight * fresnel * (common / (1.0f + lambda_o + lambda_i));
    if (lobe.multiscatter) {
      out.f *= energy_scale(lobe, cos_o, eta);
    }
    out.pdf_radiance = pmf * common / (1.0f + lambda_o);
  }
  if (dot(d.wo, n_light) > 0.0f && dot(d.wi, n_light) > 0.0f) {
    const float cos = dot(d.wi, n_light);
    out.pdf_importance = pmf * 0.25f * ggx_distribution(alpha2, n_light, h) /
                         (cos * (1.0f + ggx_lambda(alpha2, cos)));
  }
  return out;
}

// Walter et al. 2007, eq. 21, without the eta^2 of radiance (Cycles' meaning). The jacobians of the
// half vector differ between the two walks: each measures the direction that it draws (eq. 17).
// `n` on the side of wo, `n_light` on the side of wi.
LobeEval evaluate_refraction(const Lobe& lobe, const Directions& d, vec3 n, vec3 n_light) {
  const float eta = far_index(lobe, d.wo_ng);
  vec3 h = d.wo + eta * d.wi;
  const float scale2 = length2(h);
  h *= (eta > 1.0f ? -1.0f : 1.0f) / std::sqrt(scale2);  // towards wo, if it refracts at all
  const float cos_ho = dot(d.wo, h), cos_hi = -dot(d.wi, h);
  if (!(scale2 > 0.0f && cos_ho > 0.0f && cos_hi > 0.0f)) {
    return {};  // no facet refracts one into the other
  }
  const float alpha2 = sqr(lobe.alpha);
  const GlassEvents events(lobe, cos_ho, eta);
  const float pmf = 1.0f - events.pmf_reflect, common = cos_ho * cos_hi / scale2;
  LobeEval out;
  const float cos_o = dot(d.wo, n), cos_i = -dot(d.wi, n);
  if (cos_o > 0.0f && cos_i > 0.0f && dot(h, n) > 0.0f) {
    const float lambda_o = ggx_lambda(alpha2, cos_o), lambda_i = ggx_lambda(alpha2, cos_i);
    const float density = sqr(eta) * common * ggx_distribution(alpha2, n, h) / cos_o;
    out.f = lobe.weight * events.transmitted * (density / (1.0f + lambda_o + lambda_i));
    if (lobe.multiscatter) {
      out.f *= energy_scale(lobe, cos_o, eta);
    }
    out.pdf_radiance = pmf * density / (1.0f + lambda_o);
  }
  const float cos = dot(d.wi, n_light);
  if (cos > 0.0f && dot(d.wo, n_light) < 0.0f && dot(h, n_light) < 0.0f) {
    out.pdf_importance = pmf * common * ggx_distribution(alpha2, n_light, h) /
                         (cos * (1.0f + ggx_lambda(alpha2, cos)));
  }
  return out;
}

}  // namespace

vec3 valid_normal(vec3 n, vec3 ng, vec3 wo) {
  const float cos_g = dot(wo, ng);
  const float least = std::min(0.9f * cos_g, 0.01f);  // cosine that a reflection must keep to ng
  if (2.0f * dot(n, wo) * dot(n, ng) - cos_g >= least) {
    return n;
  }
  // In the plane of both normals, with z = ng: of N = (sqrt(1 - z^2), z) the reflection has cosine
  // 2 z (sqrt(1 - z^2) x + z cos_g) - cos_g, to be `least`. Squared, that is quadratic in z^2, with
  // the discriminant x^2 (a - least^2); the sign of x says which root solves it unsquared.
  const vec3 across = n - dot(n, ng) * ng;
  const float length = glm::length(across);
  if (!(length > 0.0f)) {
    return ng;
  }
  const vec3 axis = across / length;
  const float x = dot(wo, axis);
  const float a = sqr(x) + sqr(cos_g);
  const float root = x * std::sqrt(std::max(0.0f, a - sqr(least)));
  const float z2 = std::clamp(0.5f * (a + cos_g * least - root) / a, 0.0f, 1.0f);
  return std::sqrt(1.0f - z2) * axis + std::sqrt(z2) * ng;
}

LobeEval evaluate_lobe(const Lobe& lobe, vec3 ng, const Directions& d) {
  if (is_diffuse(lobe.type)) {
    return evaluate_diffuse(lobe, ng, d);
  }
  if (is_fiber(lobe.type)) {
    return evaluate_fiber(lobe, ng, d);
  }
  if (!d.same_side() && !transmits(lobe)) {
    return {};
  }
  const vec3 n = seen_normal(lobe, ng, d.wo, d.wo_ng);
  const vec3 n_light = seen_normal(lobe, ng, d.wi, d.wi_ng);
  LobeEval out = d.same_side() ? evaluate_reflection(lobe, d, n, n_light)
                               : evaluate_refraction(lobe, d, n, n_light);
  if (needs_defence(lobe, ng)) {
    const float share = defensive_share(lobe, !d.same_side());
    out.pdf_importance += kDefensive * (share * std::abs(d.wo_ng) * kInvPi - out.pdf_importance);
  }
  return out;
}

std::optional<vec3> sample_lobe(const Lobe& lobe, vec3 ng, vec3 from, float u_event, vec2 u,
                                TransportMode mode) {
  const float from_ng = dot(from, ng);
  const vec3 ng_from = from_ng < 0.0f ? -ng : ng;
  // A direction on the wrong side is refused here: for other lobes it may be a good one, but then
  // it would be drawn more often than their densities say.
  const auto on_side = [](vec3 to, vec3 normal, bool transmitted) {
    const float cos = dot(to, normal);
    return transmitted ? cos < 0.0f : cos > 0.0f;
  };
  if (is_diffuse(lobe.type)) {
    const bool transmitted = lobe.type == LobeType::Translucent;
    vec3 axis = ng_from;
    if (mode == TransportMode::Radiance) {
      axis = transmitted ? seen_normal(lobe, ng, from, from_ng) : facing_normal(lobe, from_ng);
    } else if (!transmitted && dot(from, facing_normal(lobe, from_ng)) <= 0.0f) {
      return std::nullopt;  // this lobe is lit from behind its normal: its density is zero
    }
    const vec3 to = Frame(transmitted ? -axis : axis).to_world(square_to_cosine_hemisphere(u));
    return on_side(to, ng_from, transmitted) ? std::optional(to) : std::nullopt;
  }
  if (mode == TransportMode::Importance && needs_defence(lobe, ng)) {
    if (u_event < kDefensive) {
      const bool transmitted = u_event >= kDefensive * defensive_share(lobe, false);
      return Frame(transmitted ? -ng_from : ng_from).to_world(square_to_cosine_hemisphere(u));
    }
    u_event = (u_event - kDefensive) / (1.0f - kDefensive);
  }
  const vec3 n = seen_normal(lobe, ng, from, from_ng);
  if (dot(from, n) <= 0.0f) {
    return std::nullopt;
  }
  const vec3 h = sample_visible_normal(from, n, lobe.alpha, u);
  std::optional<vec3> to = reflect_about(from, h);
  bool transmitted = false;
  if (transmits(lobe)) {
    const float eta = far_index(lobe, from_ng);
    const GlassEvents events(lobe, std::max(0.0f, dot(from, h)), eta);
    if (u_event >= events.pmf_reflect) {
      to = refract_through(from, h, eta);
      transmitted = true;
    }
  }
  if (!to || !on_side(*to, ng_from, transmitted) || !on_side(*to, n, transmitted)) {
    return std::nullopt;
  }
  return to;
}

std::optional<DeltaEvent> sample_delta(const Lobe& lobe, vec3 ng, vec3 from, float u,
                                       TransportMode mode) {
  const float from_ng = dot(from, ng);
  const bool radiance = mode == TransportMode::Radiance;
  const vec3 plain = facing_normal(lobe, from_ng);
  DeltaEvent event;
  // A turned normal sends a whole region of views to one curve of directions: no light walk comes
  // out of it, so that only camera walks make such an event.
  event.normal = radiance ? seen_normal(lobe, ng, from, from_ng) : plain;
  event.one_way = event.normal != plain;
  const float cos = dot(from, event.normal);
  if (cos <= 0.0f) {
    return std::nullopt;
  }
  event.direction = reflect_about(from, event.normal);
  if (transmits(lobe)) {
    const float eta = far_index(lobe, from_ng);
    const GlassEvents events(lobe, cos, eta);
    event.transmitted = u >= events.pmf_reflect;
    if (event.transmitted) {
      const auto refracted = refract_through(from, event.normal, eta);
      if (!refracted) {
        return std::nullopt;
      }
      event.direction = *refracted;
      event.eta = eta;
    }
    event.probability = event.transmitted ? 1.0f - events.pmf_reflect : events.pmf_reflect;
    event.color = lobe.weight * (event.transmitted ? events.transmitted : events.reflected) /
                  event.probability;
  } else {
    event.probability = 1.0f;
    event.color = lobe.weight * reflectance(lobe, cos);
  }
  const float to_ng = dot(event.direction, ng);
  // A shading normal can send a reflection below the surface, or a refraction above it.
  if ((to_ng * from_ng < 0.0f) != event.transmitted || to_ng == 0.0f) {
    return std::nullopt;
  }
  if (!radiance && seen_normal(lobe, ng, event.direction, to_ng) != facing_normal(lobe, to_ng)) {
    return std::nullopt;  // the camera side sees another normal here
  }
  return event;
}

float estimated_albedo(const Lobe& lobe, float cos) {
  switch (lobe.type) {
    case LobeType::Metal:
    case LobeType::Specular:
      return average(lobe.weight * reflectance(lobe, cos));
    case LobeType::Glass: {
      const GlassEvents events(lobe, cos, std::max(lobe.ior, 1.0f / lobe.ior));
      return average(lobe.weight * (events.reflected + events.transmitted));
    }
    case LobeType::ChiangReflection:
      return average(lobe.weight) * fresnel_dielectric(cos, lobe.ior);
    case LobeType::ChiangRest:  // most of it goes through once
      return average(lobe.weight * glm::exp(-2.0f * lobe.color)) *
             sqr(1.0f - fresnel_dielectric(cos, lobe.ior));
    default:
      // Light walks arrive at grazing angles without the loss that the camera side sees.
      return average(lobe.weight) *
             (lobe.layered ? std::max(0.25f, layer_transmittance(lobe, cos)) : 1.0f);
  }
}

float layer_transmittance(const Lobe& lobe, float cos_o) {
  const float rough = std::sqrt(lobe.alpha);
  float albedo = dielectric_reflectance(rough, cos_o, lobe.ior);
  if (lobe.multiscatter) {
    // Cycles leaves the energy scale out of the layer's albedo, but not the loss to its colour.
    const float single = reflection_albedo(rough, cos_o);
    albedo *= single + specular_bounces(lobe.ior, rough) * (1.0f - single);
  }
  return std::clamp(1.0f - albedo, 0.0f, 1.0f);
}

Rgb multiscatter_color(const Lobe& lobe, float cos_o, float eta) {
  if (!lobe.multiscatter) {
    return Rgb(1.0f);
  }
  const auto [albedo, bounces] = multiscatter(lobe, cos_o, eta);
  return albedo + bounces * (1.0f - albedo);
}

float specular_bounces(float eta, float rough) {
  const float fss = std::clamp(fresnel_dielectric_average(eta), fresnel_normal(eta), 1.0f);
  return multiple_bounces(Rgb(fss), reflection_albedo_average(rough)).x;
}

}  // namespace janus
