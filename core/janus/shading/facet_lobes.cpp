// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/shading/facet_lobes.h"

#include "janus/shading/albedo.h"
#include "janus/shading/ashikhmin_shirley.h"
#include "janus/shading/fresnel.h"
#include "janus/shading/microfacet.h"
#include "janus/shading/sides.h"

namespace janus {

namespace {

// --- Fresnel terms -------------------------------------------------------------------------------

// A dielectric's reflectance, which is `f`, moved to another one straight on. Cycles' term for
// specular tints and levels.
Rgb moved_reflectance(float f, float eta, Rgb f0) {
  const float straight = fresnel_normal(eta);
  const float position =
      straight < 1.0f ? std::clamp((f - straight) / (1.0f - straight), 0.0f, 1.0f) : 1.0f;
  return f0 + (1.0f - f0) * position;
}

// The same for a film, whose reflectance `f` may be below the dielectric's: scaled, the less the
// nearer it is to 1.
Rgb scaled_reflectance(Rgb f, float eta, Rgb f0) {
  const float straight = fresnel_normal(eta);
  if (straight <= 1e-5f || f == Rgb(1.0f)) {
    return f;
  }
  const Rgb s = glm::clamp((f - 1.0f) / (straight - 1.0f), 0.0f, 1.0f);
  return f * (1.0f + s * (f0 / straight - 1.0f));
}

// Of a metal's term of Schlick with the tint of its edge: the mean over the hemisphere.
Rgb mean_tinted_schlick(Rgb f0, Rgb edge) { return f0 + (1.0f - f0) / 21.0f - edge / 126.0f; }

// The mean reflectance of a metal, by the term above through its values straight on and at the
// edge.
Rgb mean_conductor(Rgb n, Rgb k) {
  const Rgb f0 = fresnel_conductor(1.0f, n, k), at_edge = fresnel_conductor(kEdgeCosine, n, k);
  return glm::clamp(mean_tinted_schlick(f0, edge_factor(f0, at_edge)), 0.0f, 1.0f);
}

// --- Multiple bounces ----------------------------------------------------------------------------

// Cycles' Multiscatter GGX, from the camera side: the share of light that facets scatter at once,
// and the colour of what bounces on.
struct Multiscatter {
  float albedo;
  Rgb bounces;
};
Multiscatter multiscatter(const Lobe& lobe, float cos_o, float eta) {
  const float rough = roughness(lobe);
  if (lobe.type == LobeType::Glass) {
    return {glass_albedo(rough, cos_o, eta),
            multiple_bounces(lobe.color, glass_albedo_average(rough, eta))};
  }
  const float albedo = reflection_albedo(rough, cos_o);
  const auto bounces = [&](Rgb mean) {
    return multiple_bounces(mean, reflection_albedo_average(rough));
  };
  switch (lobe.type) {
    case LobeType::Metal:
      return {albedo, bounces(mean_tinted_schlick(lobe.color, lobe.edge))};
    case LobeType::Conductor:
      return {albedo, bounces(mean_conductor(lobe.color, lobe.edge))};
    case LobeType::Specular:
    case LobeType::Coat:
      return {albedo, lobe.edge};
    default:
      return {albedo, lobe.color};
  }
}

Rgb energy_scale(const Lobe& lobe, float cos_o, float eta) {
  const auto [albedo, bounces] = multiscatter(lobe, cos_o, eta);
  return 1.0f + bounces * (1.0f / albedo - 1.0f);
}

// --- Values and densities ------------------------------------------------------------------------

// Where the shading normal is not Ng, the normal that the camera side sees may be another one than
// the light side's, and light walks would miss pairs that have a value. A small share of their
// directions is therefore drawn by the cosine to Ng.
constexpr float kDefensive = 0.05f;
bool needs_defence(const Lobe& lobe, vec3 ng) { return lobe.normal != ng; }
float defensive_share(const Lobe& lobe, bool transmitted) {
  if (lobe.type == LobeType::Glass) {
    return 0.5f;
  }
  return transmitted == (lobe.type > LobeType::Glass) ? 1.0f : 0.0f;
}

float seen_lambda(const Facets& facets, vec3 w, float cos) {
  return facets.sampled_lambda(facets.lambda(w, cos), w, cos);
}

// With which light walks draw `wo` as a reflection at the normal that they see.
float light_density(const Lobe& lobe, vec3 wo, vec3 wi, vec3 n_light) {
  const float cos = dot(wi, n_light);
  if (!(cos > 0.0f && dot(wo, n_light) > 0.0f)) {
    return 0.0f;
  }
  const Facets facets(lobe, n_light);
  return 0.25f * facets.distribution(normalize(wo + wi)) /
         (cos * (1.0f + seen_lambda(facets, wi, cos)));
}

LobeEval evaluate_reflection(const Lobe& lobe, const Directions& d, vec3 n, vec3 n_light) {
  const vec3 h = normalize(d.wo + d.wi);
  const float cos_h = dot(d.wo, h);
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
    const Facets facets(lobe, n);
    const float quarter = 0.25f * facets.distribution(h), common = quarter / cos_o;
    const float lambda_o = facets.lambda(d.wo, cos_o), lambda_i = facets.lambda(d.wi, cos_i);
    out.f = lobe.weight * fresnel * (common / (1.0f + lambda_o + lambda_i));
    if (lobe.multiscatter) {
      out.f *= energy_scale(lobe, cos_o, eta);
    }
    out.pdf_radiance = pmf * common / (1.0f + facets.sampled_lambda(lambda_o, d.wo, cos_o));
    out.pdf_importance =
        pmf * quarter / (cos_i * (1.0f + facets.sampled_lambda(lambda_i, d.wi, cos_i)));
  }
  if (n != n_light) {
    out.pdf_importance = pmf * light_density(lobe, d.wo, d.wi, n_light);
  }
  return out;
}

// A reflection whose far direction is mirrored. `n` on the side of wo, `n_light` on that of wi.
LobeEval evaluate_mirrored(const Lobe& lobe, Directions d, vec3 n, vec3 n_light) {
  const vec3 wi = d.wi;
  d.wi = mirrored(wi, n);
  LobeEval out = evaluate_reflection(lobe, d, n, n);
  if (n_light != -n) {
    out.pdf_importance = light_density(lobe, mirrored(d.wo, n_light), wi, n_light);
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
  const GlassEvents events(lobe, cos_ho, eta);
  const float pmf = 1.0f - events.pmf_reflect, common = cos_ho * cos_hi / scale2;
  const float pmf_light =
      film(lobe).exists() ? 1.0f - GlassEvents(lobe, cos_hi, 1.0f / eta).pmf_reflect : pmf;
  LobeEval out;
  const float cos_o = dot(d.wo, n), cos_i = -dot(d.wi, n);
  if (cos_o > 0.0f && cos_i > 0.0f && dot(h, n) > 0.0f) {
    const Facets facets(lobe, n);
    const float lambda_o = facets.lambda(d.wo, cos_o), lambda_i = facets.lambda(d.wi, cos_i);
    const float density = sqr(eta) * common * facets.distribution(h) / cos_o;
    out.f = lobe.weight * events.transmitted * (density / (1.0f + lambda_o + lambda_i));
    if (lobe.multiscatter) {
      out.f *= energy_scale(lobe, cos_o, eta);
    }
    out.pdf_radiance = pmf * density / (1.0f + facets.sampled_lambda(lambda_o, d.wo, cos_o));
  }
  const float cos = dot(d.wi, n_light);
  if (cos > 0.0f && dot(d.wo, n_light) < 0.0f && dot(h, n_light) < 0.0f) {
    const Facets facets(lobe, n_light);
    out.pdf_importance = pmf_light * common * facets.distribution(h) /
                         (cos * (1.0f + seen_lambda(facets, d.wi, cos)));
  }
  return out;
}

LobeEval evaluate_event(const Lobe& lobe, const Directions& d, vec3 n, vec3 n_light) {
  switch (lobe.type) {
    case LobeType::AshikhminShirley:
      return evaluate_ashikhmin_shirley(lobe, d, n, n_light);
    case LobeType::Refraction:
      return d.same_side() ? LobeEval{} : evaluate_refraction(lobe, d, n, n_light);
    case LobeType::MirroredGlossy:
      return d.same_side() ? LobeEval{} : evaluate_mirrored(lobe, d, n, n_light);
    default:
      return d.same_side() ? evaluate_reflection(lobe, d, n, n_light)
                           : evaluate_refraction(lobe, d, n, n_light);
  }
}

}  // namespace

Rgb reflectance(const Lobe& lobe, float cos) {
  switch (lobe.type) {
    case LobeType::Metal:
      return film(lobe).exists() ? film_on_metal(film(lobe), cos, lobe.color,
                                                 tinted_schlick(kEdgeCosine, lobe.color, lobe.edge))
                                 : tinted_schlick(cos, lobe.color, lobe.edge);
    case LobeType::Conductor:
      return film(lobe).exists() ? film_on_conductor(film(lobe), cos, lobe.color, lobe.edge)
                                 : fresnel_conductor(cos, lobe.color, lobe.edge);
    case LobeType::Specular:
      if (film(lobe).exists()) {
        return scaled_reflectance(film_on_dielectric(film(lobe), cos, lobe.ior), lobe.ior,
                                  lobe.color);
      }
      return moved_reflectance(fresnel_dielectric(cos, lobe.ior), lobe.ior, lobe.color);
    case LobeType::Coat:
      return Rgb(fresnel_dielectric(cos, lobe.ior));
    default:
      return Rgb(1.0f);
  }
}

Rgb straight_reflectance(const Lobe& lobe) {
  switch (lobe.type) {
    case LobeType::Metal:
    case LobeType::Specular:
      return film(lobe).exists() ? reflectance(lobe, 1.0f) : lobe.color;
    case LobeType::Coat:
      return Rgb(fresnel_normal(lobe.ior));
    default:
      return reflectance(lobe, 1.0f);
  }
}

GlassEvents::GlassEvents(const Lobe& lobe, float cos, float eta) {
  const float f = fresnel_closure(cos, eta);
  if (lobe.type == LobeType::Refraction) {
    reflected = Rgb(0.0f);
    transmitted = Rgb(f < 1.0f ? 1.0f : 0.0f);  // total reflection is lost
    pmf_reflect = 0.0f;
    return;
  }
  const Rgb f0 = glm::min(fresnel_normal(eta) * lobe.edge, 1.0f);
  Rgb moved(f);
  if (film(lobe).exists()) {
    // `eta` is 1 / ior from behind.
    const ThinFilm seen{lobe.sigma, lobe.tilt * (eta == lobe.ior ? 1.0f : eta)};
    moved = scaled_reflectance(film_on_dielectric(seen, cos, eta), eta, f0);
  } else if (lobe.edge != Rgb(1.0f)) {
    moved = moved_reflectance(f, eta, f0);
  }
  reflected = lobe.tinted_reflection ? moved * lobe.color : moved;
  transmitted = (1.0f - moved) * lobe.color;
  const float r = average(reflected), t = average(transmitted);
  pmf_reflect = r + t > 0.0f ? r / (r + t) : 1.0f;
}

LobeEval evaluate_facets(const Lobe& lobe, vec3 ng, const Directions& d) {
  if (!d.same_side() && !transmits(lobe)) {
    return {};
  }
  const vec3 n = seen_normal(lobe, ng, d.wo, d.wo_ng);
  const vec3 n_light = seen_normal(lobe, ng, d.wi, d.wi_ng);
  LobeEval out = evaluate_event(lobe, d, n, n_light);
  if (needs_defence(lobe, ng)) {
    const float share = defensive_share(lobe, !d.same_side());
    out.pdf_importance += kDefensive * (share * std::abs(d.wo_ng) * kInvPi - out.pdf_importance);
  }
  return out;
}

std::optional<vec3> sample_facets(const Lobe& lobe, vec3 ng, vec3 from, float u_event, vec2 u,
                                  TransportMode mode) {
  const float from_ng = dot(from, ng);
  const vec3 ng_from = from_ng < 0.0f ? -ng : ng;
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
  const vec3 h = lobe.type == LobeType::AshikhminShirley ? sample_half_vector(lobe, n, u)
                                                         : Facets(lobe, n).sample_visible(from, u);
  std::optional<vec3> to = reflect_about(from, h);
  bool transmitted = false;
  if (lobe.type == LobeType::MirroredGlossy) {
    to = mirrored(*to, n);
    transmitted = true;
  } else if (transmits(lobe)) {
    const float eta = far_index(lobe, from_ng);
    const GlassEvents events(lobe, std::max(0.0f, dot(from, h)), eta);
    if (u_event >= events.pmf_reflect) {
      to = refract_through(from, h, eta);
      transmitted = true;
    }
  }
  // A direction on the wrong side is refused here: for other lobes it may be a good one, but then
  // it would be drawn more often than their densities say.
  const auto on_side = [&](vec3 normal) {
    const float cos = dot(*to, normal);
    return transmitted ? cos < 0.0f : cos > 0.0f;
  };
  return to && on_side(ng_from) && on_side(n) ? to : std::nullopt;
}

Rgb multiscatter_color(const Lobe& lobe, float cos_o, float eta) {
  if (!lobe.multiscatter) {
    return Rgb(1.0f);
  }
  const auto [albedo, bounces] = multiscatter(lobe, cos_o, eta);
  return albedo + bounces * (1.0f - albedo);
}

}  // namespace janus
