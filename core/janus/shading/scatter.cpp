// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/shading/scatter.h"

#include "janus/shading/albedo.h"
#include "janus/shading/diffuse.h"
#include "janus/shading/fresnel.h"
#include "janus/shading/microfacet.h"

namespace janus {

namespace {

// The lobe's normal on the side of the surface where a direction with cosine `w_ng` to Ng is. The
// side is decided by Ng alone, so that both walks agree on it.
vec3 facing_normal(const Lobe& lobe, float w_ng) {
  return w_ng < 0.0f ? -lobe.normal : lobe.normal;
}

// Index of the far side relative to the side of a direction with cosine `w_ng` to Ng.
float far_index(const Lobe& lobe, float w_ng) { return w_ng < 0.0f ? 1.0f / lobe.ior : lobe.ior; }

// Diffuse lobes. f |wi . N| is weight/pi max(0, wi . N), on the side of wo or on the other one.
// Camera walks draw wi by the cosine to N. Light walks draw wo by the cosine to Ng, because the
// adjoint of the lobe is proportional to |wo . Ng|; this also reaches every wo for which the lobe
// is not zero.
LobeEval evaluate_diffuse(const Lobe& lobe, const Directions& d) {
  const vec3 n = facing_normal(lobe, d.wi_ng);
  const float cos_i = dot(d.wi, n);
  if (d.same_side() == (lobe.type == LobeType::Translucent) || !(cos_i > 0.0f)) {
    return {};
  }
  LobeEval out{lobe.weight, cos_i * kInvPi, std::abs(d.wo_ng) * kInvPi};
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
  return out;
}

// Fresnel term of a facet under the cosine `cos`, for lobes that only reflect.
Rgb reflectance(const Lobe& lobe, float cos) {
  switch (lobe.type) {
    case LobeType::Metal:
      return lobe.color + (1.0f - lobe.color) * schlick(cos);
    case LobeType::Specular:
      return Rgb(fresnel_dielectric(cos, lobe.ior));
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
    const float f = fresnel_dielectric(cos, eta);
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

// Cycles' energy scale of Multiscatter GGX, from the camera side.
Rgb energy_scale(const Lobe& lobe, float cos_o, float eta) {
  const float rough = std::sqrt(lobe.alpha);
  float albedo;
  Rgb bounces = lobe.color;
  if (lobe.type == LobeType::Glass) {
    albedo = glass_albedo(rough, cos_o, eta);
    bounces = multiple_bounces(glm::min(lobe.color, Rgb(1.0f)), glass_albedo_average(rough, eta));
  } else {
    albedo = reflection_albedo(rough, cos_o);
    if (lobe.type == LobeType::Metal) {
      // The average of Schlick's term is F0 + (1 - F0) / 21.
      bounces = multiple_bounces(lobe.color + (1.0f - lobe.color) / 21.0f,
                                 reflection_albedo_average(rough));
    }
  }
  return 1.0f + bounces * (1.0f / albedo - 1.0f);
}

LobeEval evaluate_reflection(const Lobe& lobe, const Directions& d, vec3 n) {
  const float cos_o = dot(d.wo, n), cos_i = dot(d.wi, n);
  if (!(cos_o > 0.0f && cos_i > 0.0f) || lobe.type == LobeType::Refraction) {
    return {};
  }
  const vec3 h = normalize(d.wo + d.wi);
  const float alpha2 = sqr(lobe.alpha), cos_h = dot(d.wo, h);
  const float quarter = 0.25f * ggx_distribution(alpha2, n, h);
  const float lambda_o = ggx_lambda(alpha2, cos_o), lambda_i = ggx_lambda(alpha2, cos_i);
  LobeEval out;
  out.f = lobe.weight * (quarter / (cos_o * (1.0f + lambda_o + lambda_i)));
  out.pdf_radiance = quarter / (cos_o * (1.0f + lambda_o));
  out.pdf_importance = quarter / (cos_i * (1.0f + lambda_i));
  const float eta = far_index(lobe, d.wo_ng);
  if (lobe.type == LobeType::Glass) {
    const GlassEvents events(lobe, cos_h, eta);
    out.f *= events.reflected;
    out.pdf_radiance *= events.pmf_reflect;
    out.pdf_importance *= events.pmf_reflect;
  } else {
    out.f *= reflectance(lobe, cos_h);
  }
  if (lobe.multiscatter) {
    out.f *= energy_scale(lobe, cos_o, eta);
  }
  return out;
}

// Walter et al. 2007, eq. 21, without the eta^2 of radiance (Cycles' meaning). The jacobians of the
// half vector differ between the two walks: each measures the direction that it draws (eq. 17).
LobeEval evaluate_refraction(const Lobe& lobe, const Directions& d, vec3 n) {
  const float cos_o = dot(d.wo, n), cos_i = -dot(d.wi, n);
  if (!(cos_o > 0.0f && cos_i > 0.0f)) {
    return {};
  }
  const float eta = far_index(lobe, d.wo_ng);
  vec3 h = d.wo + eta * d.wi;
  const float scale2 = length2(h);
  h *= (dot(h, n) < 0.0f ? -1.0f : 1.0f) / std::sqrt(scale2);
  const float cos_ho = dot(d.wo, h), cos_hi = -dot(d.wi, h);
  if (!(scale2 > 0.0f && cos_ho > 0.0f && cos_hi > 0.0f)) {
    return {};  // no facet refracts one into the other
  }
  const float alpha2 = sqr(lobe.alpha);
  const float lambda_o = ggx_lambda(alpha2, cos_o), lambda_i = ggx_lambda(alpha2, cos_i);
  const float common = ggx_distribution(alpha2, n, h) * cos_ho * cos_hi / scale2;
  const GlassEvents events(lobe, cos_ho, eta);
  LobeEval out;
  out.f = lobe.weight * events.transmitted *
          (sqr(eta) * common / (cos_o * (1.0f + lambda_o + lambda_i)));
  if (lobe.multiscatter) {
    out.f *= energy_scale(lobe, cos_o, eta);
  }
  const float pmf = 1.0f - events.pmf_reflect;
  out.pdf_radiance = pmf * sqr(eta) * common / (cos_o * (1.0f + lambda_o));
  out.pdf_importance = pmf * common / (cos_i * (1.0f + lambda_i));
  return out;
}

}  // namespace

LobeEval evaluate_lobe(const Lobe& lobe, const Directions& d) {
  if (!is_ggx(lobe.type)) {
    return evaluate_diffuse(lobe, d);
  }
  if (d.same_side()) {
    return evaluate_reflection(lobe, d, facing_normal(lobe, d.wo_ng));
  }
  return transmits(lobe) ? evaluate_refraction(lobe, d, facing_normal(lobe, d.wo_ng)) : LobeEval{};
}

std::optional<vec3> sample_lobe(const Lobe& lobe, vec3 ng, vec3 from, float u_event, vec2 u,
                                TransportMode mode) {
  const float from_ng = dot(from, ng);
  const vec3 n = facing_normal(lobe, from_ng);
  const float cos_from = dot(from, n);
  // A direction on the wrong side is refused here: for other lobes it may be a good one, but then
  // it would be drawn more often than their densities say.
  const auto on_side = [&](vec3 to, vec3 normal, bool transmitted) {
    const float cos = dot(to, normal);
    return transmitted ? cos < 0.0f : cos > 0.0f;
  };
  const vec3 ng_from = from_ng < 0.0f ? -ng : ng;
  if (!is_ggx(lobe.type)) {
    vec3 axis = n;
    if (mode == TransportMode::Importance) {
      if (cos_from <= 0.0f) {
        return std::nullopt;  // this lobe is lit from behind its normal: its density is zero
      }
      axis = ng_from;
    }
    const bool transmitted = lobe.type == LobeType::Translucent;
    const vec3 to = Frame(transmitted ? -axis : axis).to_world(square_to_cosine_hemisphere(u));
    return on_side(to, ng_from, transmitted) ? std::optional(to) : std::nullopt;
  }
  if (cos_from <= 0.0f) {
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

std::optional<DeltaEvent> sample_delta(const Lobe& lobe, vec3 from, float from_ng, float u) {
  DeltaEvent event;
  event.normal = facing_normal(lobe, from_ng);
  const float cos = dot(from, event.normal);
  if (cos <= 0.0f) {
    return std::nullopt;
  }
  if (!transmits(lobe)) {
    event.direction = reflect_about(from, event.normal);
    event.color = lobe.weight * reflectance(lobe, cos);
    event.probability = 1.0f;
    return event;
  }
  const float eta = far_index(lobe, from_ng);
  const GlassEvents events(lobe, cos, eta);
  if (u < events.pmf_reflect) {
    event.direction = reflect_about(from, event.normal);
    event.probability = events.pmf_reflect;
    event.color = lobe.weight * events.reflected / event.probability;
    return event;
  }
  const auto refracted = refract_through(from, event.normal, eta);
  if (!refracted) {
    return std::nullopt;
  }
  event.direction = *refracted;
  event.probability = 1.0f - events.pmf_reflect;
  event.color = lobe.weight * events.transmitted / event.probability;
  event.eta = eta;
  event.transmitted = true;
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

float specular_bounces(float eta, float rough) {
  const float fss = std::clamp(fresnel_dielectric_average(eta), fresnel_normal(eta), 1.0f);
  return multiple_bounces(Rgb(fss), reflection_albedo_average(rough)).x;
}

}  // namespace janus
