// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/geometry/mesh.h"

#include "janus/util/error.h"

namespace janus {

Mesh::Mesh(const std::string& key, const MeshDesc& desc, Diagnostics& diagnostics)
    : name_(desc.name.empty() ? key : desc.name) {
  const size_t corners =
      desc.corner_vertices.empty() ? desc.positions.size() : desc.corner_vertices.size();
  if (!desc.corner_normals.empty() && desc.corner_normals.size() != corners) {
    throw SceneError(key, "corner_normals",
                     "has " + std::to_string(desc.corner_normals.size()) + " normals for " +
                         std::to_string(corners) + " corners");
  }
  if (!desc.vertex_normals.empty() && desc.vertex_normals.size() != desc.positions.size()) {
    throw SceneError(key, "vertex_normals",
                     "has " + std::to_string(desc.vertex_normals.size()) + " normals for " +
                         std::to_string(desc.positions.size()) + " positions");
  }
  if (!desc.vertex_normals.empty() && !desc.corner_normals.empty()) {
    throw SceneError(key, "vertex_normals", "and corner_normals exclude each other");
  }
  if (!desc.material_indices.empty() && desc.material_indices.size() != desc.triangles.size()) {
    throw SceneError(key, "material_indices",
                     "has " + std::to_string(desc.material_indices.size()) + " entries for " +
                         std::to_string(desc.triangles.size()) + " triangles");
  }
  for (size_t i = 0; i < desc.corner_vertices.size(); ++i) {
    if (desc.corner_vertices[i] >= desc.positions.size()) {
      throw SceneError(
          key, "corner_vertices[" + std::to_string(i) + "]",
          "is out of range: the mesh has " + std::to_string(desc.positions.size()) + " positions");
    }
  }

  positions_ = desc.positions;
  positions_.emplace_back(0.0f);
  triangles_.reserve(desc.triangles.size());
  size_t dropped = 0;
  for (size_t i = 0; i < desc.triangles.size(); ++i) {
    Triangle triangle{};
    bool finite = true;
    for (int k = 0; k < 3; ++k) {
      const uint32_t corner = desc.triangles[i][k];
      if (corner >= corners) {
        throw SceneError(key, "triangles[" + std::to_string(i) + "]",
                         "is out of range: the mesh has " + std::to_string(corners) + " corners");
      }
      triangle.v[k] = desc.corner_vertices.empty() ? corner : desc.corner_vertices[corner];
      triangle.normal[k] = desc.vertex_normals.empty() ? corner : triangle.v[k];
      finite = finite && is_finite(desc.positions[triangle.v[k]]);
    }
    triangle.material = desc.material_indices.empty() ? 0 : desc.material_indices[i];
    if (finite) {
      triangles_.push_back(triangle);
    } else {
      ++dropped;
    }
  }
  if (dropped > 0) {
    diagnostics.push_back(
        {Severity::Warning, name_, "", "",
         std::to_string(dropped) + " triangles with non-finite vertices are left out"});
  }
  normals_ = desc.vertex_normals.empty() ? desc.corner_normals : desc.vertex_normals;
}

}  // namespace janus
