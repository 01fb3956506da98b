// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rotations and directions as nodes use them.
#pragma once

#include <cmath>

#include "janus/math/vec.h"
#include "janus/shading/scalar.h"

namespace janus {

// About x, then y, then z.
inline mat3 euler_rotation(vec3 a) {
  const vec3 c(std::cos(a.x), std::cos(a.y), std::cos(a.z)),
      s(std::sin(a.x), std::sin(a.y), std::sin(a.z));
  return mat3(c.y * c.z, c.y * s.z, -s.y,  // first column
              s.x * s.y * c.z - c.x * s.z, s.x * s.y * s.z + c.x * c.z, s.x * c.y,
              c.x * s.y * c.z + s.x * s.z, c.x * s.y * s.z - s.x * c.z, c.x * c.y);
}

// About a unit axis (Rodrigues).
inline mat3 axis_rotation(vec3 n, float angle) {
  const float c = std::cos(angle), s = std::sin(angle), t = 1.0f - c;
  return mat3(t * n.x * n.x + c, t * n.x * n.y + s * n.z, t * n.x * n.z - s * n.y,
              t * n.x * n.y - s * n.z, t * n.y * n.y + c, t * n.y * n.z + s * n.x,
              t * n.x * n.z + s * n.y, t * n.y * n.z - s * n.x, t * n.z * n.z + c);
}

inline vec3 safe_normalize(vec3 v) {
  const float length = glm::length(v);
  return length != 0.0f ? v / length : v;
}

inline vec3 safe_divide(vec3 a, vec3 b) {
  return vec3(safe_divide(a.x, b.x), safe_divide(a.y, b.y), safe_divide(a.z, b.z));
}

}  // namespace janus
