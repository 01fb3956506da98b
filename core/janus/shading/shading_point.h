// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a program may ask about the point where it runs. Plain data: shading knows no meshes, only
// the numbers of the triangle that it runs on.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "janus/math/vec.h"
#include "janus/scene/description.h"
#include "janus/shading/path_so_far.h"

namespace janus {

// How the camera looks at the world.
struct CameraView {
  CameraType type = CameraType::Perspective;
  mat4 from_world = mat4(1.0f), to_world = mat4(1.0f);           // see view_of()
  float left = -0.5f, right = 0.5f, bottom = -0.5f, top = 0.5f;  // CameraDesc's, before its shift
  FisheyeDesc fisheye;

  // Where a point of the world, or for `direction` one as far as infinity, stands in the frame:
  // (0, 0) to (1, 1) from its lower left corner.
  vec3 window(vec3 p, bool direction) const;
};

// Of an instance.
struct ObjectData {
  mat4 to_world = mat4(1.0f), to_object = mat4(1.0f);
  mat3 normal_to_world = mat3(1.0f);         // inverse transpose
  std::shared_ptr<const CameraView> camera;  // one for all
  vec3 location = vec3(0.0f);
  vec4 color = vec4(1.0f);
  float object_index = 0.0f, random = 0.0f;
};

// The place of a triangle in the arrays of its mesh.
struct TriangleIndices {
  uint32_t vertices[3], corners[3], face;
};

// Hardly initialized: a walk carries room for one, and seldom needs it.
struct ShadingPoint {
  vec3 p;       // world
  vec3 ng, ns;  // unit, front side
  vec3 view;    // unit, to the side from which the surface is looked at
  vec2 barycentric;
  TriangleIndices triangle;
  const ObjectData* object;
  // By the program's slot; null where the mesh has none of that name.
  const AttributeDesc* const* attributes;
  float material_index;
  // Edges of the triangle in the world (of a curve: its derivative, and nothing; of a ball:
  // nothing, and its centre), and the size of a pixel there: see shifted().
  vec3 edge_u, edge_v;
  float footprint;  // metres
  // The interpolated normal in object space, as long as it comes out: what tangents go with.
  vec3 object_normal;
  // For shifted(): the normals of the corners in object space, or nothing.
  vec3 corner_normals[3];
  // Of the light of lamps, its length alone: to what it lights.
  PathSoFar path;
  bool moved;              // by shifted()
  bool on_curve, on_ball;  // else on a triangle, or nowhere

  bool backfacing() const { return dot(view, ng) < 0.0f; }
  // Of a ball, in the world; else the origin.
  vec3 centre() const { return on_ball ? edge_v : vec3(0.0f); }
  // Cycles' normals look at the viewer.
  vec3 facing(vec3 n) const { return backfacing() ? -n : n; }
  // A pixel to the side: the tangents of Cycles' ray differentials, so that bump compares heights
  // at the same places. axis: 0 or 1.
  vec3 step(int axis) const;
  // The point `width` steps away, on the plane of the triangle; attributes go on linearly.
  ShadingPoint shifted(int axis, float width) const;
  // A value of the attribute in `slot`. Missing channels are 0, a missing alpha 1; so is all of it
  // where the mesh has no such attribute.
  vec4 attribute(uint32_t slot) const;
  // The same as a number, as Cycles makes it: the first of two, the mean of three or four.
  float attribute_factor(uint32_t slot) const;
};

}  // namespace janus
