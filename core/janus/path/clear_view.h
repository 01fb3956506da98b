// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the camera sees clearly: its view along a path is clear as far as it leads through nothing
// but transparent surfaces and, on a transparent film, refractions of clear glass. What holds out
// leaves a hole in a clear view, where it ends the path, and is like anything else in all others;
// the background of a transparent film is left out of clear views alone. Whether a view is clear is
// a property of the path: where lobes that are clear and others share a refraction, it is so by
// their share of f, as with the labels of path/label.h. Walks draw it, joins take a share, and no
// density knows.
#pragma once

#include "janus/path/vertex.h"

namespace janus {

// Is the light left out where the view to it is clear?
inline bool hidden_in_clear_view(const Light& light, const PathRules& rules) {
  return light.holdout || (light.background && rules.film_transparent);
}

// Does the surface of a vertex end every path that comes to it in a clear view?
inline bool holds_out(const Scene& scene, const PathVertex& v) {
  return scene.instances[v.hit.instance].holdout || v.shading.holdout >= 1.0f;
}

// For a surface that is met in a clear view: what holds out no longer scatters or emits. Returns
// the share of light that is missing behind `beta`, a mean over the channels.
inline float hole(const Scene& scene, const SurfaceInteraction& hit, Rgb beta, bool& ends,
                  ShadingResult& shading) {
  const bool object = scene.instances[hit.instance].holdout;
  const float share =
      average(beta * (object ? Rgb(1.0f) - shading.transparency : Rgb(shading.holdout)));
  ends = object || shading.holdout >= 1.0f;
  if (ends) {
    shading.bsdf.clear();
    if (!object) {
      shading.transparency = Rgb(0.0f);
    }
  }
  return share;
}

// The share of a vertex's refraction from `wi` to `wo` that keeps a view clear.
inline float clear_share(const PathRules& rules, const BsdfView& bsdf, vec3 wo, vec3 wi) {
  return dot(wo, bsdf.ng()) * dot(wi, bsdf.ng()) < 0.0f
             ? bsdf.refracted_share(wo, wi, rules.clear_glass)
             : 0.0f;
}

// Draws whether a vertex that was left by `sample` keeps a view clear. Takes a number only where
// there is a choice.
bool leaves_clear(const PathRules& rules, const PathVertex& v, const BsdfSample& sample,
                  TransportMode mode, Sampler& sampler);

}  // namespace janus
