// SPDX-License-Identifier: GPL-3.0-or-later
//
// The GGX distribution of microfacets with Smith's height-correlated masking and shadowing (Walter
// et al. 2007, Heitz 2014). Isotropic, width `alpha`; `alpha2` is its square.
#pragma once

#include "janus/math/frame.h"
#include "janus/math/warp.h"

namespace janus {

// Density of facet normals per projected area, for unit `h` near unit `n`. The sine comes from the
// cross product: 1 - cos^2 would have no digits left where narrow lobes live.
inline float ggx_distribution(float alpha2, vec3 n, vec3 h) {
  const float sin2 = length2(cross(n, h)), cos2 = sqr(dot(n, h));
  return alpha2 * kInvPi / sqr(sin2 + alpha2 * cos2);
}

// Smith's Lambda: a direction at cosine `cos` is masked by 1 / (1 + Lambda), a pair of directions
// by 1 / (1 + Lambda_1 + Lambda_2).
inline float ggx_lambda(float alpha2, float cos) {
  const float tan2 = std::max(0.0f, 1.0f / (cos * cos) - 1.0f);
  return 0.5f * (std::sqrt(1.0f + alpha2 * tan2) - 1.0f);
}

// A facet normal that is visible from `w` (unit, dot(w, n) > 0), with density
// D(h) dot(w, h) / (dot(w, n) (1 + Lambda(w))) per solid angle of h (Heitz 2018), by spherical caps
// (Dupuy & Benyoub 2023).
inline vec3 sample_visible_normal(vec3 w, vec3 n, float alpha, vec2 u) {
  const Frame frame(n);
  const vec3 local(dot(w, frame.s), dot(w, frame.t), dot(w, n));
  const vec3 standard = normalize(vec3(alpha * local.x, alpha * local.y, local.z));
  const float z = (1.0f - u.y) * (1.0f + standard.z) - standard.z;
  const float r = std::sqrt(std::max(0.0f, 1.0f - z * z));
  const vec3 h = vec3(r * cos_sin(2.0f * kPi * u.x), z) + standard;
  return frame.to_world(normalize(vec3(alpha * h.x, alpha * h.y, std::max(1e-9f, h.z))));
}

}  // namespace janus
