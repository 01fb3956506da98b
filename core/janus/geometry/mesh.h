// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "janus/math/vec.h"
#include "janus/scene/description.h"
#include "janus/scene/diagnostics.h"

namespace janus {

// A validated triangle mesh in object space.
class Mesh {
 public:
  struct Triangle {
    uint32_t v[3];       // positions
    uint32_t normal[3];  // normals
    uint32_t material;   // slot
  };

  // Checks the description. Throws SceneError for indices out of range or arrays of wrong length;
  // drops triangles with non-finite vertices and says so.
  Mesh(const std::string& key, const MeshDesc& desc, Diagnostics& diagnostics);

  const std::string& name() const { return name_; }
  const std::vector<vec3>& positions() const { return positions_; }
  const std::vector<Triangle>& triangles() const { return triangles_; }
  bool smooth() const { return !normals_.empty(); }
  const std::vector<vec3>& normals() const { return normals_; }  // of triangles; empty: flat

 private:
  std::string name_;
  std::vector<vec3> positions_;  // one more than used: Embree reads 16 bytes at the last vertex
  std::vector<Triangle> triangles_;
  std::vector<vec3> normals_;
};

// Object-to-world placement of a mesh.
struct Instance {
  uint32_t mesh = 0;
  mat4 to_world = mat4(1.0f);
  mat3 normal_to_world = mat3(1.0f);  // inverse transpose
  std::vector<uint32_t> materials;    // program index by slot; never empty
  int light = -1;                     // index of the mesh light, or -1
  bool opaque = true;                 // false: rays may pass through parts of it (see Accel)
  RayMask visibility = kAllRays;      // the rays that meet it
  std::string name;

  uint32_t material(uint32_t slot) const {
    // Cycles uses the last slot for an index beyond the list.
    return materials[slot < materials.size() ? slot : materials.size() - 1];
  }
};

}  // namespace janus
