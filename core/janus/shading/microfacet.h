// SPDX-License-Identifier: GPL-3.0-or-later
//
// The GGX distribution of microfacets with Smith's height-correlated masking and shadowing (Walter
// et al. 2007, Heitz 2014).
#pragma once

#include "janus/math/frame.h"
#include "janus/math/pack.h"
#include "janus/math/warp.h"
#include "janus/shading/lobe.h"

namespace janus {

// Smith's Lambda for `x`, the squared slope of a direction in units of the facets' width: it is
// masked by 1 / (1 + Lambda), a pair of directions by 1 / (1 + Lambda_1 + Lambda_2).
inline float smith_lambda(float x) { return 0.5f * (std::sqrt(1.0f + x) - 1.0f); }
// Of a direction at cosine `cos` to facets of one width, whose square is `alpha2`.
inline float ggx_lambda(float alpha2, float cos) {
  return smith_lambda(alpha2 * std::max(0.0f, 1.0f / (cos * cos) - 1.0f));
}

// The facets of a lobe around unit `n`.
class Facets {
 public:
  Facets(const Lobe& lobe, vec3 n)
      : n_(n), x_(lobe.alpha), y_(lobe.alpha_y), alpha2_(x_ * y_), isotropic_(x_ == y_) {
    if (!isotropic_) {
      const vec3 side = cross(n, unpack_direction(lobe.tangent));
      const float length = glm::length(side);
      across_ = length > 1e-6f ? side / length : Frame(n).t;
      along_ = cross(across_, n);
    }
  }

  // Density of facet normals per projected area, for unit `h` near `n`. The sine comes from the
  // cross product: 1 - cos^2 would have no digits left where narrow lobes live.
  float distribution(vec3 h) const {
    const float cos2 = sqr(dot(n_, h));
    if (isotropic_) {
      return alpha2_ * kInvPi / sqr(length2(cross(n_, h)) + alpha2_ * cos2);
    }
    const float slopes = sqr(dot(along_, h) / x_) + sqr(dot(across_, h) / y_);
    return kInvPi / (alpha2_ * sqr(slopes + cos2));
  }

  // Smith's Lambda of `w`, whose cosine to n is `cos`.
  float lambda(vec3 w, float cos) const {
    if (isotropic_) {
      return ggx_lambda(alpha2_, cos);
    }
    return smith_lambda((sqr(x_ * dot(along_, w)) + sqr(y_ * dot(across_, w))) / sqr(cos));
  }

  // A facet normal that is visible from `w` (unit, dot(w, n) > 0), with density
  // D(h) dot(w, h) / (dot(w, n) (1 + Lambda(w))) per solid angle of h (Heitz 2018), by spherical
  // caps (Dupuy & Benyoub 2023).
  vec3 sample_visible(vec3 w, vec2 u) const {
    Frame frame(n_);
    if (!isotropic_) {
      frame.s = along_;
      frame.t = across_;
    }
    const vec3 local(dot(w, frame.s), dot(w, frame.t), dot(w, n_));
    const vec3 standard = normalize(vec3(x_ * local.x, y_ * local.y, local.z));
    const float z = (1.0f - u.y) * (1.0f + standard.z) - standard.z;
    const float r = std::sqrt(std::max(0.0f, 1.0f - z * z));
    const vec3 h = vec3(r * cos_sin(2.0f * kPi * u.x), z) + standard;
    return frame.to_world(normalize(vec3(x_ * h.x, y_ * h.y, std::max(1e-9f, h.z))));
  }

 private:
  vec3 n_;
  float x_, y_, alpha2_;
  bool isotropic_;
  vec3 along_, across_;  // of facets of two widths
};

}  // namespace janus
