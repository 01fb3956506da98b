// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "janus/geometry/instance.h"
#include "janus/geometry/interaction.h"
#include "janus/geometry/mesh.h"
#include "janus/geometry/round_shape.h"

namespace janus {

// An instance as the ray queries see it: what a surface point needs, computed once and kept close
// together.
class Placement {
 public:
  // Shape and instance must outlive this.
  Placement(const Shape& shape, const Instance& instance);

  // The point at barycentric coordinates (b1, b2) of a triangle. From these and not along a ray:
  // the error does not grow with distance.
  vec3 position(uint32_t primitive, vec2 b) const {
    const Mesh::Triangle& triangle = triangles_[primitive];
    return linear_ * ((1.0f - b.x - b.y) * positions_[triangle.v[0]] +
                      b.x * positions_[triangle.v[1]] + b.y * positions_[triangle.v[2]]) +
           translation_;
  }

  // Writes the surface there to `hit`, but for its `instance`.
  void surface_point(uint32_t primitive, vec2 b, SurfaceInteraction& hit) const;

  // --- Of what is round instead.

  bool round() const { return round_ != nullptr; }
  // The number of a piece, or of a disk, which are geometries of their own.
  uint32_t round_primitive(uint32_t geometry, uint32_t primitive) const {
    return geometry == 0 ? primitive : static_cast<uint32_t>(round_->pieces().size()) + primitive;
  }
  // Amid it, at `u` of a piece.
  vec3 center(uint32_t primitive, float u) const {
    return linear_ * round_->place(primitive, u).center + translation_;
  }
  // Likewise the surface where it has this normal, of object space and any length; `near`: a point
  // of the world that is hardly off it.
  void round_point(uint32_t primitive, float u, vec3 object_normal, vec3 near,
                   SurfaceInteraction& hit) const;

 private:
  void bound_rounding();

  mat3 linear_;
  vec3 translation_;
  mat3 normal_;  // inverse transpose
  const Mesh::Triangle* triangles_ = nullptr;
  const vec3* positions_ = nullptr;
  const vec3* normals_ = nullptr;  // null: flat
  const RoundShape* round_ = nullptr;
  const Instance* instance_;
  // Bounds of rounding, in units of it, for a point p of object space: forward_ |p| on the way to
  // the world, back_ |p| + back_translation_ on the way back; determinant_error_: relative.
  mat3 forward_, back_;
  vec3 back_translation_;
  float determinant_error_;
};

}  // namespace janus
