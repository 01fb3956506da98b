// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace janus {

// What a ray is to the things that it may meet, in Cycles' words. Read from the camera: the type of
// the segment after a vertex is the vertex's label, how it scatters the light that arrives there.
enum class RayType : uint8_t { Diffuse, Glossy, Transmission, Camera, Shadow };

// A set of ray types.
using RayMask = uint8_t;

constexpr RayMask ray_bit(RayType type) {
  return static_cast<RayMask>(1U << static_cast<unsigned>(type));
}
constexpr bool contains(RayMask mask, RayType type) { return (mask & ray_bit(type)) != 0; }

inline constexpr RayMask kAllRays = 0b11111;
inline constexpr RayMask kLabels = 0b00111;  // Diffuse, Glossy, Transmission

}  // namespace janus
