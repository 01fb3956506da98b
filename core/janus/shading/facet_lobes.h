// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lobes of facets: reflection at a metal, a dielectric, or a coat; and glass.
#pragma once

#include "janus/shading/scatter.h"
#include "janus/shading/thin_film.h"

namespace janus {

// As evaluate_lobe(), sample_lobe() and sample_delta().
LobeEval evaluate_facets(const Lobe& lobe, vec3 ng, const Directions& d);
std::optional<vec3> sample_facets(const Lobe& lobe, vec3 ng, vec3 from, float u_event, vec2 u,
                                  TransportMode mode);

// What lies on the facets of a lobe, none of Coat and Refraction.
inline ThinFilm film(const Lobe& lobe) { return {lobe.sigma, lobe.tilt}; }

// Fresnel term of a facet under the cosine `cos`, for lobes that only reflect.
Rgb reflectance(const Lobe& lobe, float cos);
// The same straight on.
Rgb straight_reflectance(const Lobe& lobe);

// Reflection and refraction at a facet of a Glass or Refraction lobe: what they keep, and the
// probability of choosing reflection. `eta`: index of the far side. Both are the same from both
// ends of a refraction, but where there is a film: Cycles takes the way within it, seen from the
// glass, relative to the glass. Values are those of the camera side.
struct GlassEvents {
  Rgb reflected, transmitted;
  float pmf_reflect;

  GlassEvents(const Lobe& lobe, float cos, float eta);
};

// What light keeps of its colour that a lobe of facets scatters, over all its bounces between
// facets, as seen from a camera direction at cosine `cos_o`; `eta`: index of the far side.
Rgb multiscatter_color(const Lobe& lobe, float cos_o, float eta);

}  // namespace janus
