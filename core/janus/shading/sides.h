// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which normal of a lobe a direction sees, and which index of refraction lies behind it.
#pragma once

#include "janus/shading/scatter.h"

namespace janus {

// The lobe's normal on the side of the surface where a direction with cosine `w_ng` to Ng is. The
// side is decided by Ng alone, so that both walks agree on it.
inline vec3 facing_normal(const Lobe& lobe, float w_ng) {
  return w_ng < 0.0f ? -lobe.normal : lobe.normal;
}

// The normal of a lobe of facets, or of a Translucent one, as seen from `w`. Values take it from
// the camera side; each density from the side that draws.
inline vec3 seen_normal(const Lobe& lobe, vec3 ng, vec3 w, float w_ng) {
  return valid_normal(facing_normal(lobe, w_ng), w_ng < 0.0f ? -ng : ng, w);
}

// The direction on the other side of the plane across unit `n`.
inline vec3 mirrored(vec3 w, vec3 n) { return w - 2.0f * dot(w, n) * n; }

// Index of the far side relative to the side of a direction with cosine `w_ng` to Ng.
inline float far_index(const Lobe& lobe, float w_ng) {
  return w_ng < 0.0f ? 1.0f / lobe.ior : lobe.ior;
}

}  // namespace janus
