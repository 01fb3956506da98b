// SPDX-License-Identifier: GPL-3.0-or-later
//
// What many nodes, and inputs without a link, read of the point.
#pragma once

#include "janus/shading/operation.h"

namespace janus {

inline vec3 read_position(const Context& c) { return c.point.p; }
inline vec3 read_normal(const Context& c) { return c.point.facing(c.point.ns); }
inline vec3 read_attribute(const Context& c) { return vec3(c.point.attribute(c.data)); }

inline constexpr Operation kPosition = at_point<&read_position>;
inline constexpr Operation kFacingNormal = by_side<&read_normal>;
inline constexpr Operation kAttribute = at_point<&read_attribute>;  // `data`: its slot

}  // namespace janus
