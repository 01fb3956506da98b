// SPDX-License-Identifier: GPL-3.0-or-later
//
// How single lobes scatter; BsdfView puts them together.
#pragma once

#include <optional>

#include "janus/shading/bsdf.h"
#include "janus/shading/fresnel.h"

namespace janus {

// A pair of directions at a point, with their cosines to Ng, which decide the sides.
struct Directions {
  vec3 wo, wi;
  float wo_ng, wi_ng;
  vec3 ns;  // the surface's own shading normal

  bool same_side() const { return wo_ng * wi_ng > 0.0f; }
};

// Of one lobe, without its probability of being chosen: f |wi . N| as the camera sees it, and the
// densities per solid angle of drawing wi from wo and wo from wi.
struct LobeEval {
  Rgb f = Rgb(0.0f);
  float pdf_radiance = 0.0f, pdf_importance = 0.0f;
};

// The normal that Cycles gives to GGX and Translucent lobes: where a mirror at shading normal `n`
// would send the view `wo` below the surface, `n` is turned towards `ng` until the reflection just
// leaves it. Both normals on the side of wo.
vec3 turned_normal(vec3 n, vec3 ng, vec3 wo, float least);
inline vec3 valid_normal(vec3 n, vec3 ng, vec3 wo) {
  const float cos_g = dot(wo, ng);
  const float least = std::min(0.9f * cos_g, 0.01f);  // cosine that a reflection must keep to ng
  return 2.0f * dot(n, wo) * dot(n, ng) - cos_g >= least ? n : turned_normal(n, ng, wo, least);
}

// Probability of choosing a lobe for a walk that arrives with the Schlick factor `grazing` of its
// cosine to Ng.
inline float pmf(const Lobe& lobe, float grazing) {
  return lobe.pmf_normal + grazing * (lobe.pmf_grazing - lobe.pmf_normal);
}
inline float grazing(float w_ng) { return schlick(std::abs(w_ng)); }

// For lobes that are not deltas.
LobeEval evaluate_lobe(const Lobe& lobe, vec3 ng, const Directions& d);

// Draws the direction opposite to `from` of a lobe that is no delta, with the densities above;
// nullopt: absorbed.
std::optional<vec3> sample_lobe(const Lobe& lobe, vec3 ng, vec3 from, float u_event, vec2 u,
                                TransportMode mode);

// One event of a delta lobe: the value is `color` times a delta in solid angle of the camera walk.
struct DeltaEvent {
  vec3 direction;
  Rgb color;          // value / probability, without pmf and without adjoint factors
  float probability;  // of this event of the lobe,
  float reverse;      // and of the opposite one
  float eta = 1.0f;   // refraction: index of the far side / index of the side of `from`
  bool transmitted = false;
  bool one_way = false;  // the other walk never makes this event
  vec3 normal;           // on the side of `from`
};
std::optional<DeltaEvent> sample_delta(const Lobe& lobe, vec3 ng, vec3 from, float u,
                                       TransportMode mode);

// Albedo estimates for directions straight on and at the horizon: what lobes are chosen by.
struct EstimatedAlbedo {
  float normal, grazing;
};
EstimatedAlbedo estimated_albedo(const Lobe& lobe);

// Colour of the light that leaves after several bounces between facets, for single bounces of
// average reflectance `fss` and facets of average albedo `average` (Kulla & Conty 2017). The series
// has no sum for colours that gain more than is lost: it is limited there.
inline Rgb multiple_bounces(Rgb fss, float average) {
  return fss * average / glm::max(1.0f - fss * (1.0f - average), Rgb(0.1f));
}

}  // namespace janus
