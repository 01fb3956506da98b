// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a program may ask about the point where it runs. Plain data: shading knows no meshes, only
// the numbers of the triangle that it runs on.
#pragma once

#include <cstdint>
#include <vector>

#include "janus/math/vec.h"
#include "janus/scene/description.h"

namespace janus {

// Of an instance.
struct ObjectData {
  mat4 to_world = mat4(1.0f), to_object = mat4(1.0f);
  mat3 normal_to_world = mat3(1.0f);                      // inverse transpose
  mat4 to_camera = mat4(1.0f), from_camera = mat4(1.0f);  // world; looks along +z
  vec3 location = vec3(0.0f);
  vec4 color = vec4(1.0f);
  float object_index = 0.0f, random = 0.0f;
};

// The place of a triangle in the arrays of its mesh.
struct TriangleIndices {
  uint32_t vertices[3], corners[3], face;
};

struct ShadingPoint {
  vec3 p = vec3(0.0f);                          // world
  vec3 ng = vec3(0, 0, 1), ns = vec3(0, 0, 1);  // unit, front side
  vec3 view = vec3(0, 0, 1);  // unit, to the side from which the surface is looked at
  vec2 barycentric = vec2(0.0f);
  TriangleIndices triangle{};
  const ObjectData* object = nullptr;
  // By the program's slot; null where the mesh has none of that name.
  const AttributeDesc* const* attributes = nullptr;
  float material_index = 0.0f;
  // Edges of the triangle in the world, and how far the points lie that bump compares with: see
  // shifted().
  vec3 edge_u = vec3(0.0f), edge_v = vec3(0.0f);
  float footprint = 0.0f;  // metres
  // The interpolated normal in object space, as long as it comes out: what tangents go with.
  vec3 object_normal = vec3(0, 0, 1);

  bool backfacing() const { return dot(view, ng) < 0.0f; }
  // Cycles' normals look at the viewer.
  vec3 facing(vec3 n) const { return backfacing() ? -n : n; }
  // Where bump looks to the side, a footprint away: the tangents of Cycles' ray differentials, so
  // that heights are compared at the same places. axis: 0 or 1.
  vec3 step(int axis) const;
  // The point there, on the plane of the triangle; attributes go on linearly.
  ShadingPoint shifted(int axis) const;
  // A value of the attribute in `slot`. Missing channels are 0, a missing alpha 1; so is all of it
  // where the mesh has no such attribute.
  vec4 attribute(uint32_t slot) const;
};

}  // namespace janus
