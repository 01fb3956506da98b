// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "janus/geometry/motion.h"
#include "janus/geometry/shape.h"

namespace janus {

// A validated triangle mesh in object space.
class Mesh final : public Shape {
 public:
  struct Triangle {
    uint32_t v[3];       // positions
    uint32_t normal[3];  // normals
    uint32_t material;   // slot
  };

  // Checks the description, and empties it if it is right. Throws SceneError for indices out of
  // range or arrays of wrong length; drops triangles with non-finite vertices and says so.
  Mesh(const std::string& key, MeshDesc&& desc);

  const Mesh* mesh() const override { return this; }
  bool moves() const override { return !motion_.empty(); }
  std::shared_ptr<const Shape> at(float time) const override;
  size_t primitives() const override { return triangles().size(); }
  uint32_t material(uint32_t primitive) const override { return triangles()[primitive].material; }
  TriangleIndices indices(uint32_t primitive) const override;

  const std::vector<vec3>& positions() const { return positions_; }
  const std::vector<Triangle>& triangles() const { return topology_->triangles; }
  bool smooth() const { return !normals_.empty(); }
  const std::vector<vec3>& normals() const { return normals_; }  // of triangles; empty: flat
  // Of the corners' normals, or of the triangle; not of unit length.
  vec3 interpolated_normal(uint32_t primitive, vec2 barycentric) const;
  // The normals of the corners, as long as they are given; nothing where it is flat.
  void corner_normals(uint32_t primitive, vec3 (&normals)[3]) const;

 private:
  // What does not change with time.
  struct Topology {
    std::vector<Triangle> triangles;
    std::vector<AttributeDesc> attributes;
    std::vector<glm::uvec3> corners;  // by triangle; empty: nothing is kept by corner
    std::vector<uint32_t> faces;      // by triangle; empty: nothing is kept by face
  };

  Mesh() = default;
  const std::vector<AttributeDesc>& attributes() const override { return topology_->attributes; }
  void take_motion(const std::string& key, std::vector<MeshKey> motion);

  std::vector<vec3> positions_;  // one more than used: Embree reads 16 bytes at the last vertex
  std::vector<vec3> normals_;
  std::shared_ptr<const Topology> topology_;
  std::vector<MeshKey> motion_;
};

}  // namespace janus
