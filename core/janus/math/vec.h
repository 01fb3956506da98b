// SPDX-License-Identifier: GPL-3.0-or-later
//
// Vectors, colours and rays. Lengths are metres, colours scene-linear Rec.709.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>

namespace janus {

using glm::mat3;
using glm::mat4;
using glm::vec2;
using glm::vec3;
using glm::vec4;

using glm::cross;
using glm::dot;
using glm::normalize;

using Rgb = glm::vec3;

inline constexpr float kPi = 3.14159265358979323846f;
inline constexpr float kInvPi = 1.0f / kPi;
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

inline float sqr(float x) { return x * x; }
// As x86 processors round to integers, towards 0: what does not fit in is the smallest.
inline int32_t to_integer(float x) {
  return x >= -2147483648.0f && x < 2147483648.0f ? static_cast<int32_t>(x) : INT32_MIN;
}
inline float length2(vec3 v) { return dot(v, v); }
// Between unit vectors, in radians. Not by the cosine, which says little of small angles.
inline float angle_between(vec3 a, vec3 b) {
  return 2.0f * std::atan2(glm::length(a - b), glm::length(a + b));
}
inline float max_component(vec3 v) { return std::max(v.x, std::max(v.y, v.z)); }
inline float max_abs_component(vec3 v) { return max_component(glm::abs(v)); }
inline float average(Rgb c) { return (c.x + c.y + c.z) * (1.0f / 3.0f); }
inline float luminance(Rgb c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; }
inline bool is_black(Rgb c) { return c.x == 0.0f && c.y == 0.0f && c.z == 0.0f; }
inline bool is_finite(vec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
inline bool is_finite(const mat4& m) {
  return is_finite(vec3(m[0])) && is_finite(vec3(m[1])) && is_finite(vec3(m[2])) &&
         is_finite(vec3(m[3]));
}

struct Ray {
  vec3 origin;
  vec3 direction;  // unit
  float t_max = kInfinity;
};

// Axis-aligned bounds; empty until the first extend().
struct Bounds {
  vec3 lower = vec3(kInfinity);
  vec3 upper = vec3(-kInfinity);

  void extend(vec3 p) {
    lower = glm::min(lower, p);
    upper = glm::max(upper, p);
  }
  void extend(const Bounds& b) {
    lower = glm::min(lower, b.lower);
    upper = glm::max(upper, b.upper);
  }
  bool empty() const { return !(lower.x <= upper.x); }
  vec3 center() const { return empty() ? vec3(0.0f) : 0.5f * (lower + upper); }
  float radius() const { return empty() ? 0.0f : 0.5f * glm::length(upper - lower); }
};

// Around the box `b`, which is not empty, where `m` takes it.
inline Bounds transformed(const Bounds& b, const mat4& m) {
  Bounds result;
  for (int corner = 0; corner < 8; ++corner) {
    const vec3 p((corner & 1 ? b.upper : b.lower).x, (corner & 2 ? b.upper : b.lower).y,
                 (corner & 4 ? b.upper : b.lower).z);
    result.extend(vec3(m * vec4(p, 1.0f)));
  }
  return result;
}

}  // namespace janus
