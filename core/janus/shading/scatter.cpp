// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/shading/scatter.h"

#include "janus/shading/diffuse_lobes.h"
#include "janus/shading/facet_lobes.h"
#include "janus/shading/fresnel.h"
#include "janus/shading/hair.h"
#include "janus/shading/layers.h"
#include "janus/shading/sheen.h"
#include "janus/shading/sides.h"

namespace janus {

vec3 turned_normal(vec3 n, vec3 ng, vec3 wo, float least) {
  const float cos_g = dot(wo, ng);
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
  return has_facets(lobe.type) ? evaluate_facets(lobe, ng, d) : evaluate_glossy_toon(lobe, d);
}

std::optional<vec3> sample_lobe(const Lobe& lobe, vec3 ng, vec3 from, float u_event, vec2 u,
                                TransportMode mode) {
  if (is_diffuse(lobe.type)) {
    return sample_diffuse(lobe, ng, from, u, mode);
  }
  if (is_fiber(lobe.type)) {
    return sample_fiber(lobe, ng, from, u_event, u);
  }
  return has_facets(lobe.type) ? sample_facets(lobe, ng, from, u_event, u, mode)
                               : sample_glossy_toon(lobe, ng, from, u);
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
    event.reverse = event.probability;
    Rgb kept = event.transmitted ? events.transmitted : events.reflected;
    if (event.transmitted && film(lobe).exists()) {
      const GlassEvents opposite(lobe, std::abs(dot(event.direction, event.normal)), 1.0f / eta);
      event.reverse = 1.0f - opposite.pmf_reflect;
      kept = radiance ? kept : opposite.transmitted;
    }
    event.color = lobe.weight * kept / event.probability;
  } else {
    event.probability = event.reverse = 1.0f;
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

EstimatedAlbedo estimated_albedo(const Lobe& lobe) {
  const float weight = average(lobe.weight);
  const auto covered = [&](float normal, float grazing) {
    const CoveredShare share = covered_share(lobe);
    return EstimatedAlbedo{share.normal * normal, share.grazing * grazing};
  };
  switch (lobe.type) {
    case LobeType::Metal:
    case LobeType::Conductor:
    case LobeType::Specular:
    case LobeType::Coat:  // at the horizon all are mirrors
      return covered(average(lobe.weight * straight_reflectance(lobe)), weight);
    case LobeType::Glass: {
      const GlassEvents events(lobe, 1.0f, std::max(lobe.ior, 1.0f / lobe.ior));
      return covered(average(lobe.weight * (events.reflected + events.transmitted)),
                     lobe.tinted_reflection ? average(lobe.weight * lobe.color) : weight);
    }
    case LobeType::Sheen:
      return {weight * SheenLobe(lobe.alpha, 1.0f).albedo,
              weight * SheenLobe(lobe.alpha, 0.0f).albedo};
    case LobeType::ChiangReflection:
      return {weight * fresnel_normal(lobe.ior), weight};
    case LobeType::ChiangRest:  // most of it goes through once, and none at the horizon
      return {average(lobe.weight * glm::exp(-2.0f * lobe.color)) *
                  sqr(1.0f - fresnel_normal(lobe.ior)),
              0.0f};
    default:
      return covered(weight, weight);
  }
}

}  // namespace janus
