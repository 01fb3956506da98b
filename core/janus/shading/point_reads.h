// SPDX-License-Identifier: GPL-3.0-or-later
//
// What many nodes, and inputs without a link, read of the point.
#pragma once

#include "janus/shading/operation.h"

namespace janus {

inline vec3 read_position(const Context& c) { return c.point.p; }
inline vec3 read_normal(const Context& c) { return c.point.facing(c.point.ns); }
inline vec3 read_attribute(const Context& c) { return vec3(c.point.attribute(c.data)); }

// Of the triangle, or of the lamp.
inline vec3 read_parametric(const Context& c) {
  const vec2 b = c.point.barycentric;
  return vec3(1.0f - b.x - b.y, b.x, 0.0f);
}

inline constexpr Operation kPosition = at_point<&read_position>;
inline constexpr Operation kFacingNormal = by_side<&read_normal>;
inline constexpr Operation kAttribute = at_point<&read_attribute>;  // `data`: its slot
inline constexpr Operation kParametric = at_point<&read_parametric>;

}  // namespace janus
