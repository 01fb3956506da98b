// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far from the origin rays may be. Embree takes no coordinates from 1.8e18 on, nor what is no
// number: some builds of it end the process.
#pragma once

#include <algorithm>
#include <cmath>

#include "janus/geometry/interaction.h"

namespace janus {

inline constexpr float kFarthest = 1e18f;

// Is it within `farthest`, with all that it holds a number?
inline bool traceable(const Ray& ray, float farthest) {
  const vec3 sums = glm::abs(ray.origin) + glm::abs(ray.direction);
  return sums.x + sums.y + sums.z <= farthest && !std::isnan(ray.t_max);
}

// How much farther apart points are in an instance than in the world, at most (at least 1); it is
// too small to be met beyond kMostLarger.
inline float enlargement(const mat4& to_world) {
  const mat3 inverse = glm::inverse(mat3(to_world));
  const vec3 sums = glm::abs(inverse[0]) + glm::abs(inverse[1]) + glm::abs(inverse[2]);
  return std::max(sums.x + sums.y + sums.z, 1.0f);
}
inline constexpr float kMostLarger = 1e9f;

// How far rays may be in the world so that they are within kFarthest in an instance; 0: it is too
// small or too far away for any.
inline float reach_beside(const mat4& to_world) {
  const float larger = enlargement(to_world);
  const float far = max_abs_component(vec3(to_world[3]));
  const bool met = larger <= kMostLarger && larger * far <= 0.5f * kFarthest;
  return met ? 0.5f * kFarthest / larger : 0.0f;
}

}  // namespace janus
