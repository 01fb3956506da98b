// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/shading/bsdf.h"

#include "janus/math/frame.h"
#include "janus/math/warp.h"
#include "janus/shading/fresnel.h"

namespace janus {

namespace {

// The lobe's normal on the side of the surface where `w` is. The side is decided by Ng alone, so
// that both walks agree on it.
vec3 facing_normal(const Lobe& lobe, float w_dot_ng) {
  return w_dot_ng < 0.0f ? -lobe.normal : lobe.normal;
}

// Diffuse. f |wi . N| = weight/pi max(0, wi . N) on the side of wo. Camera walks draw wi by the
// cosine to N. Light walks draw wo by the cosine to Ng, because the adjoint of the lobe is
// proportional to |wo . Ng|; this also reaches every wo for which the lobe is not zero.
Rgb diffuse_eval_cos(const Lobe& lobe, float wi_ng, vec3 wi) {
  return lobe.weight * (kInvPi * std::max(0.0f, dot(wi, facing_normal(lobe, wi_ng))));
}

float diffuse_pdf(const Lobe& lobe, float wo_ng, float wi_ng, vec3 wi, TransportMode mode) {
  const float cos_i = dot(wi, facing_normal(lobe, wi_ng));
  if (mode == TransportMode::Radiance) {
    return std::max(0.0f, cos_i) * kInvPi;
  }
  return cos_i > 0.0f ? std::abs(wo_ng) * kInvPi : 0.0f;
}

// d omega_o / d omega_i of a delta event: 1 for a reflection; for a refraction
// (eta_light / eta_camera)^2 |wi . N| / |wo . N|, because n^2 cos(theta) d omega is invariant.
float refraction_jacobian(vec3 wo, vec3 wi, vec3 n, float eta2_light_over_camera) {
  const float cos_o = std::abs(dot(wo, n));
  return cos_o > 0.0f ? eta2_light_over_camera * std::abs(dot(wi, n)) / cos_o : 0.0f;
}

}  // namespace

void Bsdf::finish() {
  float total = 0.0f;
  for (int i = 0; i < count_; ++i) {
    total += average(lobes_[i].weight);
  }
  albedo_ = total;
  for (int i = 0; i < count_; ++i) {
    lobes_[i].pmf = total > 0.0f ? average(lobes_[i].weight) / total : 0.0f;
  }
}

bool BsdfView::connectible() const {
  for (const Lobe& lobe : lobes_) {
    if (!is_delta(lobe)) {
      return true;
    }
  }
  return false;
}

bool BsdfView::transmits() const {
  for (const Lobe& lobe : lobes_) {
    if (lobe.type == LobeType::Dielectric) {
      return true;
    }
  }
  return false;
}

Rgb BsdfView::eval_cos(vec3 wo, vec3 wi) const {
  const float wo_ng = dot(wo, ng_), wi_ng = dot(wi, ng_);
  Rgb sum(0.0f);
  if (wo_ng * wi_ng > 0.0f) {
    for (const Lobe& lobe : lobes_) {
      if (lobe.type == LobeType::Diffuse) {
        sum += diffuse_eval_cos(lobe, wi_ng, wi);
      }
    }
  }
  return sum;
}

Rgb BsdfView::eval(vec3 wo, vec3 wi, TransportMode mode) const {
  const Rgb value = eval_cos(wo, wi);
  if (mode == TransportMode::Radiance || is_black(value)) {
    return value;
  }
  return value * (std::abs(dot(wo, ng_)) / std::abs(dot(wi, ng_)));
}

float BsdfView::pdf_solid(vec3 wo, vec3 wi, TransportMode mode) const {
  const float wo_ng = dot(wo, ng_), wi_ng = dot(wi, ng_);
  float sum = 0.0f;
  if (wo_ng * wi_ng > 0.0f) {
    for (const Lobe& lobe : lobes_) {
      if (lobe.type == LobeType::Diffuse) {
        sum += lobe.pmf * diffuse_pdf(lobe, wo_ng, wi_ng, wi, mode);
      }
    }
  }
  return sum;
}

std::optional<BsdfSample> BsdfView::sample(vec3 from, float u_lobe, vec2 u,
                                           TransportMode mode) const {
  const Lobe* lobe = nullptr;
  for (const Lobe& candidate : lobes_) {
    if (candidate.pmf <= 0.0f) {
      continue;
    }
    lobe = &candidate;  // the last one also serves when rounding leaves u_lobe above every sum
    if (u_lobe < candidate.pmf) {
      break;
    }
    u_lobe -= candidate.pmf;
  }
  const float from_ng = dot(from, ng_);
  if (!lobe || from_ng == 0.0f) {
    return std::nullopt;
  }
  const bool radiance = mode == TransportMode::Radiance;
  const vec3 n = facing_normal(*lobe, from_ng);

  if (lobe->type == LobeType::Diffuse) {
    if (!radiance && dot(from, n) <= 0.0f) {
      return std::nullopt;  // this lobe is lit from behind its normal: its density is zero
    }
    const Frame frame(radiance ? n : (from_ng < 0.0f ? -ng_ : ng_));
    const vec3 to = frame.to_world(square_to_cosine_hemisphere(u));
    const vec3 wo = radiance ? from : to, wi = radiance ? to : from;
    const float pdf = pdf_solid(wo, wi, mode);
    if (!(pdf > 0.0f)) {
      return std::nullopt;  // below the surface, or lit from behind the shading normal
    }
    const TransportMode reverse = radiance ? TransportMode::Importance : TransportMode::Radiance;
    return BsdfSample{to, eval(wo, wi, mode) / pdf, pdf, pdf_solid(wo, wi, reverse), false};
  }

  const float cos_from = dot(from, n);
  if (cos_from <= 0.0f) {
    return std::nullopt;
  }
  vec3 to;
  float probability = lobe->pmf;
  float eta2 = 1.0f;  // (index on the light side / index on the camera side)^2
  bool transmitted = false;
  if (lobe->type == LobeType::Mirror) {
    to = reflect_about(from, n);
  } else {
    const float eta = from_ng < 0.0f ? 1.0f / lobe->ior : lobe->ior;
    const float reflectance = fresnel_dielectric(cos_from, eta);
    if (u.x < reflectance) {
      to = reflect_about(from, n);
      probability *= reflectance;
    } else {
      const auto refracted = refract_through(from, n, eta);
      if (!refracted) {
        return std::nullopt;
      }
      to = *refracted;
      probability *= 1.0f - reflectance;
      transmitted = true;
      eta2 = radiance ? eta * eta : 1.0f / (eta * eta);
    }
  }
  const float to_ng = dot(to, ng_);
  // A shading normal can send a reflection below the surface, or a refraction above it.
  if ((to_ng * from_ng < 0.0f) != transmitted || to_ng == 0.0f) {
    return std::nullopt;
  }
  const vec3 wo = radiance ? from : to, wi = radiance ? to : from;
  const float jacobian = transmitted ? refraction_jacobian(wo, wi, n, eta2) : 1.0f;
  // The Fresnel probability divides the value exactly, so only colour and selection remain. A
  // light walk gains the jacobian of the delta and the cosines of the adjoint (Veach 1997, 5.3).
  Rgb weight = lobe->weight / lobe->pmf;
  if (!radiance) {
    weight *= jacobian * std::abs(to_ng / from_ng);
  }
  // Fresnel terms are symmetric and so is the choice of the lobe, but the two walks measure their
  // discrete event against different solid angles: the ratio of the densities is the jacobian.
  const float pdf_radiance = probability * jacobian, pdf_importance = probability;
  return BsdfSample{to,
                    weight,
                    radiance ? pdf_radiance : pdf_importance,
                    radiance ? pdf_importance : pdf_radiance,
                    true,
                    radiance ? 1.0f : eta2};
}

}  // namespace janus
