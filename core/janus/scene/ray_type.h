// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bit>
#include <cstdint>

namespace janus {

// What a segment of a path is to the things that it may meet, in Cycles' words, read from the
// camera: the first one is a camera ray, and the one after a vertex has the vertex's label (how it
// scatters the light that arrives there). But the segment z_0 z_1 is a shadow ray wherever one
// could have made it: z_1 is no delta, and next event estimation knows the light. For a light that
// casts no shadows nothing is in the way then: Unblocked. Lights with shadow linking have shadow
// rays of a type of their own, which follows these.
enum class RayType : uint8_t { Diffuse, Glossy, Transmission, Camera, Shadow, Unblocked };
inline constexpr int kMostShadowSets = 24;
inline constexpr int kRayTypes = 6 + kMostShadowSets;

// The shadow rays of lights that only some objects stand in the way of.
constexpr RayType shadow_ray_of(int shadow_set) {
  return static_cast<RayType>(static_cast<int>(RayType::Unblocked) + 1 + shadow_set);
}

// A set of ray types.
using RayMask = uint32_t;

constexpr RayMask ray_bit(RayType type) {
  return static_cast<RayMask>(1U << static_cast<unsigned>(type));
}
constexpr bool contains(RayMask mask, RayType type) { return (mask & ray_bit(type)) != 0; }

// Some type of a set that is not empty.
constexpr RayType first_type(RayMask mask) { return static_cast<RayType>(std::countr_zero(mask)); }

// What objects may be visible to.
inline constexpr RayMask kAllRays = 0b11111;
inline constexpr RayMask kLabels = 0b00111;  // Diffuse, Glossy, Transmission
// Shadow rays of all lights.
inline constexpr RayMask kShadowRays = ~(kLabels | ray_bit(RayType::Camera));

}  // namespace janus
