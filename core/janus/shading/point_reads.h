// SPDX-License-Identifier: GPL-3.0-or-later
//
// What many nodes, and inputs without a link, read of the point.
#pragma once

#include "janus/math/hash.h"
#include "janus/shading/operation.h"
#include "janus/shading/rotation.h"

namespace janus {

inline vec3 read_position(const Context& c) { return c.point.p; }
inline vec3 read_object_point(const Context& c) {
  return vec3(c.point.object->to_object * vec4(c.point.p, 1.0f));
}
inline vec3 read_normal(const Context& c) { return c.point.facing(c.point.ns); }
// As Cycles turns normals: the space may be stretched.
inline vec3 read_beam(const Context& c) {
  return safe_normalize(glm::transpose(mat3(c.point.object->to_world)) * c.point.view);
}
inline vec3 read_attribute(const Context& c) { return vec3(c.point.attribute(c.data)); }

// Of the triangle, or of the lamp.
inline vec3 read_parametric(const Context& c) {
  const vec2 b = c.point.barycentric;
  return vec3(1.0f - b.x - b.y, b.x, 0.0f);
}

// Not of unit length. `data`: 1, the second edge of a triangle.
inline vec3 read_along(const Context& c) {
  return c.point.on_curve || c.data == 0 ? c.point.edge_u : c.point.edge_v;
}
inline float read_on_curve(const Context& c) { return c.point.on_curve ? 1.0f : 0.0f; }

// Cycles' hash of the curve.
inline float read_strand(const Context& c, float elsewhere) {
  return c.point.on_curve ? jenkins_number(std::array{c.point.triangle.face, 0U}) : elsewhere;
}

// From a direction of the object to one on its surface.
inline vec3 read_on_surface(const Context& c, vec3 direction) {
  const vec3 n = c.point.facing(c.point.ns);
  const vec3 t = c.point.object->normal_to_world * direction;
  return cross(n, safe_normalize(cross(safe_normalize(t), n)));
}
// Around an axis of the object's box; the operand is the place in it ("generated").
inline constexpr Operation kRadialTangent[] = {
    by_side<[](const Context& c, vec3 generated) {
      return read_on_surface(c, vec3(0.0f, 0.5f - generated.z, generated.y - 0.5f));
    }>,
    by_side<[](const Context& c, vec3 generated) {
      return read_on_surface(c, vec3(0.5f - generated.z, 0.0f, generated.x - 0.5f));
    }>,
    by_side<[](const Context& c, vec3 generated) {
      return read_on_surface(c, vec3(0.5f - generated.y, generated.x - 0.5f, 0.0f));
    }>};

inline constexpr Operation kAlong = at_point<&read_along>;
inline constexpr Operation kOnCurve = at_point<&read_on_curve>;
inline constexpr Operation kStrand = at_point<&read_strand>;
inline constexpr Operation kPosition = at_point<&read_position>;
inline constexpr Operation kObjectPoint = at_point<&read_object_point>;
inline constexpr Operation kFacingNormal = by_side<&read_normal>;
inline constexpr Operation kBeam = by_view<&read_beam>;
inline constexpr Operation kAttribute = at_point<&read_attribute>;  // `data`: its slot
inline constexpr Operation kParametric = at_point<&read_parametric>;

}  // namespace janus
