// SPDX-License-Identifier: GPL-3.0-or-later
//
// Distributions of microfacets, GGX and Beckmann's, with Smith's height-correlated masking and
// shadowing (Walter et al. 2007, Heitz 2014).
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

// The same for Beckmann's facets: by Walter's approximation (eq. 15, as Cycles has it) and exactly.
float beckmann_lambda(float x);
float exact_beckmann_lambda(float x);
// Slopes of Beckmann's facets of width 1 that are visible from a direction at cosine `cos` in the
// plane of the first (Heitz & d'Eon 2014, by a search for the inverse of the distribution).
vec2 visible_beckmann_slopes(float cos, vec2 u);

// The facets of a lobe around unit `n`.
class Facets {
 public:
  Facets(const Lobe& lobe, vec3 n)
      : n_(n),
        x_(lobe.alpha),
        y_(lobe.alpha_y),
        alpha2_(x_ * y_),
        isotropic_(x_ == y_),
        beckmann_(lobe.beckmann) {
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
    if (isotropic_ && !beckmann_) {
      return alpha2_ * kInvPi / sqr(length2(cross(n_, h)) + alpha2_ * cos2);
    }
    const float slopes = isotropic_ ? length2(cross(n_, h)) / alpha2_
                                    : sqr(dot(along_, h) / x_) + sqr(dot(across_, h) / y_);
    if (beckmann_) {
      return std::exp(-slopes / cos2) * kInvPi / (alpha2_ * sqr(cos2));
    }
    return kInvPi / (alpha2_ * sqr(slopes + cos2));
  }

  // Smith's Lambda of `w`, whose cosine to n is `cos`; and the one in the density of
  // sample_visible(), where that is another.
  float lambda(vec3 w, float cos) const {
    if (isotropic_ && !beckmann_) {
      return ggx_lambda(alpha2_, cos);
    }
    return beckmann_ ? beckmann_lambda(slope2(w, cos)) : smith_lambda(slope2(w, cos));
  }
  float sampled_lambda(float lambda, vec3 w, float cos) const {
    return beckmann_ ? exact_beckmann_lambda(slope2(w, cos)) : lambda;
  }

  // A facet normal that is visible from `w` (unit, dot(w, n) > 0), with density
  // D(h) dot(w, h) / (dot(w, n) (1 + Lambda(w))) per solid angle of h (Heitz 2018); of GGX by
  // spherical caps (Dupuy & Benyoub 2023).
  vec3 sample_visible(vec3 w, vec2 u) const {
    Frame frame(n_);
    if (!isotropic_) {
      frame.s = along_;
      frame.t = across_;
    }
    const vec3 local(dot(w, frame.s), dot(w, frame.t), dot(w, n_));
    const vec3 standard = normalize(vec3(x_ * local.x, y_ * local.y, local.z));
    if (beckmann_) {
      return frame.to_world(beckmann_normal(standard, u));
    }
    const float z = (1.0f - u.y) * (1.0f + standard.z) - standard.z;
    const float r = std::sqrt(std::max(0.0f, 1.0f - z * z));
    const vec3 h = vec3(r * cos_sin(2.0f * kPi * u.x), z) + standard;
    return frame.to_world(normalize(vec3(x_ * h.x, y_ * h.y, std::max(1e-9f, h.z))));
  }

 private:
  // The squared slope of `w` in units of the facets' width.
  float slope2(vec3 w, float cos) const {
    return isotropic_ ? alpha2_ * std::max(0.0f, 1.0f / (cos * cos) - 1.0f)
                      : (sqr(x_ * dot(along_, w)) + sqr(y_ * dot(across_, w))) / sqr(cos);
  }
  vec3 beckmann_normal(vec3 standard, vec2 u) const {
    const vec2 slopes = visible_beckmann_slopes(standard.z, u);
    const float r = std::sqrt(std::max(0.0f, 1.0f - sqr(standard.z)));
    const vec2 axis = r > 1e-6f ? vec2(standard) / r : vec2(1.0f, 0.0f);
    return normalize(vec3(-x_ * (axis.x * slopes.x - axis.y * slopes.y),
                          -y_ * (axis.y * slopes.x + axis.x * slopes.y), 1.0f));
  }

  vec3 n_;
  float x_, y_, alpha2_;
  bool isotropic_, beckmann_;
  vec3 along_, across_;  // of facets of two widths
};

}  // namespace janus
