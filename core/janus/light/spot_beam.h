// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>

#include "janus/math/vec.h"
#include "janus/math/warp.h"
#include "janus/scene/description.h"

namespace janus {

// The beam of a spot light: how much of its light leaves in which direction. As in Cycles the beam
// is a round cone in the space of the light object, so an uneven scale makes it elliptic.
class SpotBeam {
 public:
  // The transform's linear part must be invertible, the size positive.
  explicit SpotBeam(const LightDesc& desc)
      : to_world_(desc.transform),
        to_local_(glm::inverse(to_world_)),
        volume_(std::abs(glm::determinant(to_world_))),
        half_angle_(0.5f * std::min(desc.spot_size, kPi)),
        one_minus_cos_(2.0f * sqr(cos_sin(0.5f * half_angle_).y)),
        blend_(std::clamp(desc.spot_blend, 0.0f, 1.0f)) {}

  // In [0, 1], 0 outside of the cone.
  float attenuation(vec3 direction) const {
    const vec3 l = to_local_ * direction;
    const float inside = one_minus_cos_ - one_minus_cos(l);
    if (!(inside > 0.0f)) {
      return 0.0f;
    }
    const float t = inside < one_minus_cos_ * blend_ ? inside / (one_minus_cos_ * blend_) : 1.0f;
    return t * t * (3.0f - 2.0f * t);
  }

  // Directions in the cone, drawn uniformly in the object's space.
  vec3 sample(vec2 u) const {
    const vec3 l = square_to_cone(u, one_minus_cos_);
    return normalize(to_world_ * vec3(l.x, l.y, -l.z));
  }

  // 0 outside. A linear map M takes the solid angle around d to |det M| / |M d|^3 of itself.
  float pdf_solid(vec3 direction) const {
    const vec3 l = to_local_ * direction;
    const float length = glm::length(l);
    return one_minus_cos(l) < one_minus_cos_
               ? 0.5f * kInvPi / (one_minus_cos_ * volume_ * length * length * length)
               : 0.0f;
  }

  vec3 axis() const { return normalize(-to_world_[2]); }

  // The largest angle to the axis within the cone.
  float theta_max() const {
    const vec2 edge = cos_sin(half_angle_);
    float lowest = 1.0f;
    for (int i = 0; i < kSteps; ++i) {
      const vec2 phi = cos_sin(2.0f * kPi * static_cast<float>(i) / kSteps);
      const vec3 d = normalize(to_world_ * vec3(edge.y * phi, -edge.x));
      lowest = std::min(lowest, dot(d, axis()));
    }
    return static_cast<float>(std::acos(static_cast<double>(std::clamp(lowest, -1.0f, 1.0f))));
  }

  // The integral of attenuation() over all directions, by midpoints.
  float solid_angle() const {
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i) {
      for (int j = 0; j < kSteps; ++j) {
        const vec3 d = sample((vec2(i, j) + 0.5f) / static_cast<float>(kSteps));
        const float pdf = pdf_solid(d);
        sum += pdf > 0.0f ? attenuation(d) / pdf : 0.0f;
      }
    }
    return static_cast<float>(sum / (kSteps * kSteps));
  }

 private:
  static constexpr int kSteps = 64;

  // 1 - cos of the angle to the local axis, without cancellation for narrow beams.
  static float one_minus_cos(vec3 l) {
    const float length2 = dot(l, l), cosine = -l.z / std::sqrt(length2);
    return cosine > 0.0f ? (l.x * l.x + l.y * l.y) / (length2 * (1.0f + cosine)) : 1.0f - cosine;
  }

  mat3 to_world_, to_local_;
  float volume_, half_angle_, one_minus_cos_, blend_;
};

}  // namespace janus
