// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "janus/geometry/motion.h"
#include "janus/math/vec.h"
#include "janus/scene/description.h"
#include "janus/scene/diagnostics.h"
#include "janus/shading/shading_point.h"

namespace janus {

// A validated triangle mesh in object space.
class Mesh {
 public:
  struct Triangle {
    uint32_t v[3];       // positions
    uint32_t normal[3];  // normals
    uint32_t material;   // slot
  };

  // Checks the description, and empties it if it is right. Throws SceneError for indices out of
  // range or arrays of wrong length; drops triangles with non-finite vertices and says so.
  Mesh(const std::string& key, MeshDesc&& desc);

  // Does it change its form while the shutter is open?
  bool moves() const { return !motion_.empty(); }
  // As it is at a time: a mesh that stands still, with the same triangles. Only if moves().
  std::shared_ptr<const Mesh> at(float time) const;

  const std::string& name() const { return name_; }
  // What was not as asked.
  const Diagnostics& diagnostics() const { return diagnostics_; }
  const Bounds& bounds() const { return bounds_; }  // of the triangles, at all times
  const std::vector<vec3>& positions() const { return positions_; }
  const std::vector<Triangle>& triangles() const { return topology_->triangles; }
  bool smooth() const { return !normals_.empty(); }
  const std::vector<vec3>& normals() const { return normals_; }  // of triangles; empty: flat
  // Of the corners' normals, or of the triangle; not of unit length.
  vec3 interpolated_normal(uint32_t primitive, vec2 barycentric) const;
  // The normals of the corners, as long as they are given; nothing where it is flat.
  void corner_normals(uint32_t primitive, vec3 (&normals)[3]) const;
  const AttributeDesc* attribute(const std::string& key) const;  // nullptr: it has none
  // Where the attributes of a triangle stand.
  TriangleIndices indices(uint32_t primitive) const;

 private:
  // What does not change with time.
  struct Topology {
    std::vector<Triangle> triangles;
    std::vector<AttributeDesc> attributes;
    std::vector<glm::uvec3> corners;  // by triangle; empty: nothing is kept by corner
    std::vector<uint32_t> faces;      // by triangle; empty: nothing is kept by face
  };

  Mesh() = default;
  void take_motion(const std::string& key, std::vector<MeshKey> motion);

  std::string name_;
  Diagnostics diagnostics_;
  Bounds bounds_;
  std::vector<vec3> positions_;  // one more than used: Embree reads 16 bytes at the last vertex
  std::vector<vec3> normals_;
  std::shared_ptr<const Topology> topology_;
  std::vector<MeshKey> motion_;
};

// Scenes of one builder share the meshes that have not changed.
using MeshList = std::vector<std::shared_ptr<const Mesh>>;

// Object-to-world placement of a mesh.
struct Instance {
  uint32_t mesh = 0;
  mat4 to_world = mat4(1.0f);
  mat3 normal_to_world = mat3(1.0f);     // inverse transpose
  std::shared_ptr<const Motion> motion;  // null: it stands still
  std::vector<uint32_t> materials;       // index in Surfaces by slot; never empty
  int light = -1;                        // index of the mesh light, or -1
  bool opaque = true;                    // false: rays may pass through parts of it (see Accel)
  RayMask visibility = kAllRays;         // the rays that meet it
  // The copies of it, with itself, that other rays meet in its place: a range of instances.
  uint32_t first_copy = 0, copies = 1;
  bool holdout = false;                      // InstanceDesc::holdout
  bool catcher = false;                      // a shadow catcher that does not hold out
  EmitterLinks emitter{};                    // of what it emits
  LinkMask unlit_by = 0;                     // ReceiverLinks::unlit_by
  vec4 color = vec4(1.0f);                   // what Object Info says: the object's colour,
  float object_index = 0.0f, random = 0.0f;  // its pass index, a number of its own in [0, 1]
  std::string name, light_group, asset;      // of the object (InstanceDesc)

  uint32_t material(uint32_t slot) const {
    // Cycles uses the last slot for an index beyond the list.
    return materials[slot < materials.size() ? slot : materials.size() - 1];
  }
};

}  // namespace janus
