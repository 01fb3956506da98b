// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>

#include "janus/math/vec.h"

namespace janus {

// A unit vector in 32 bits, to 5e-5: on an octahedron that is unfolded to a square (Cigolle et al.,
// "A Survey of Efficient Representations for Independent Unit Vectors", 2014). Of a vector without
// a direction: one.
inline uint32_t pack_direction(vec3 v) {
  const float sum = std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
  vec2 p = sum > 0.0f && std::isfinite(sum) ? vec2(v.x, v.y) / sum : vec2(0.0f);
  if (v.z < 0.0f) {
    p = vec2(std::copysign(1.0f - std::abs(p.y), p.x), std::copysign(1.0f - std::abs(p.x), p.y));
  }
  const auto part = [](float x) {
    return static_cast<uint32_t>(static_cast<int>(std::lround(x * 32767.0f)) + 32768);
  };
  return part(p.x) << 16 | part(p.y);
}

inline vec3 unpack_direction(uint32_t packed) {
  const auto part = [](uint32_t x) {
    return static_cast<float>(static_cast<int>(x) - 32768) / 32767.0f;
  };
  vec2 p(part(packed >> 16), part(packed & 0xffffu));
  const float z = 1.0f - std::abs(p.x) - std::abs(p.y);
  if (z < 0.0f) {
    p = vec2(std::copysign(1.0f - std::abs(p.y), p.x), std::copysign(1.0f - std::abs(p.x), p.y));
  }
  return normalize(vec3(p, z));
}

}  // namespace janus
