// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/geometry/mesh.h"

#include <algorithm>

#include "janus/geometry/derived.h"
#include "janus/util/error.h"

namespace janus {

namespace {

// The number of elements of a domain.
size_t domain_size(const MeshDesc& desc, AttributeDomain domain, size_t corners) {
  switch (domain) {
    case AttributeDomain::Mesh:
      return 1;
    case AttributeDomain::Point:
      return desc.positions.size();
    case AttributeDomain::Corner:
      return corners;
    case AttributeDomain::Face:
      break;
  }
  uint32_t last = 0;
  for (const uint32_t face : desc.faces) {
    last = std::max(last, face);
  }
  return desc.faces.empty() ? desc.triangles.size() : size_t{last} + 1;
}

void check_attributes(const std::string& key, const MeshDesc& desc, size_t corners) {
  if (!desc.faces.empty() && desc.faces.size() != desc.triangles.size()) {
    throw SceneError(key, "faces",
                     "has " + std::to_string(desc.faces.size()) + " entries for " +
                         std::to_string(desc.triangles.size()) + " triangles");
  }
  for (const AttributeDesc& attribute : desc.attributes) {
    if (is_derived(attribute)) {
      continue;
    }
    // Faces may be without triangles.
    check_attribute(key, attribute, domain_size(desc, attribute.domain, corners),
                    attribute.domain == AttributeDomain::Face);
  }
}

}  // namespace

Mesh::Mesh(const std::string& key, MeshDesc&& desc) {
  name_ = desc.name.empty() ? key : desc.name;
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

  check_attributes(key, desc, corners);
  for (size_t i = 0; i < desc.triangles.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      if (desc.triangles[i][k] >= corners) {
        throw SceneError(key, "triangles[" + std::to_string(i) + "]",
                         "is out of range: the mesh has " + std::to_string(corners) + " corners");
      }
    }
  }
  std::vector<AttributeDesc> attributes = desc.attributes;
  derive_attributes(key, desc, attributes);
  auto topology = std::make_shared<Topology>();
  topology->attributes = std::move(attributes);
  const auto kept_by = [&](AttributeDomain domain) {
    return std::any_of(topology->attributes.begin(), topology->attributes.end(),
                       [&](const AttributeDesc& a) { return a.domain == domain; });
  };
  const bool by_corner = kept_by(AttributeDomain::Corner), by_face = kept_by(AttributeDomain::Face);

  topology->triangles.reserve(desc.triangles.size());
  size_t dropped = 0;
  for (size_t i = 0; i < desc.triangles.size(); ++i) {
    Triangle triangle{};
    bool finite = true;
    for (int k = 0; k < 3; ++k) {
      const uint32_t corner = desc.triangles[i][k];
      triangle.v[k] = desc.corner_vertices.empty() ? corner : desc.corner_vertices[corner];
      triangle.normal[k] = desc.vertex_normals.empty() ? corner : triangle.v[k];
      finite = finite && is_finite(desc.positions[triangle.v[k]]);
    }
    triangle.material = desc.material_indices.empty() ? 0 : desc.material_indices[i];
    if (finite) {
      topology->triangles.push_back(triangle);
      for (const uint32_t v : triangle.v) {
        bounds_.extend(desc.positions[v]);
      }
      if (by_corner) {
        topology->corners.push_back(desc.triangles[i]);
      }
      if (by_face) {
        topology->faces.push_back(desc.faces.empty() ? static_cast<uint32_t>(i) : desc.faces[i]);
      }
    } else {
      ++dropped;
    }
  }
  if (dropped > 0) {
    warn(std::to_string(dropped) + " triangles with non-finite vertices are left out");
  }
  normals_ = std::move(desc.vertex_normals.empty() ? desc.corner_normals : desc.vertex_normals);
  positions_ = std::move(desc.positions);
  take_motion(key, std::move(desc.motion));
  positions_.emplace_back(0.0f);
  topology_ = std::move(topology);
  desc = {};
}

void Mesh::take_motion(const std::string& key, std::vector<MeshKey> motion) {
  if (motion.size() == 1) {
    throw SceneError(key, "motion", "one time is no motion");
  }
  for (size_t i = 0; i < motion.size(); ++i) {
    const std::string path = "motion[" + std::to_string(i) + "]";
    if (motion[i].positions.size() != positions_.size() ||
        motion[i].normals.size() != normals_.size()) {
      throw SceneError(key, path,
                       "has " + std::to_string(motion[i].positions.size()) + " positions and " +
                           std::to_string(motion[i].normals.size()) + " normals, not " +
                           std::to_string(positions_.size()) + " and " +
                           std::to_string(normals_.size()));
    }
    if (!std::ranges::all_of(motion[i].positions, [](vec3 p) { return is_finite(p); })) {
      warn(
          "it has vertices that are not finite at some time of the shutter: it is rendered without "
          "deformation");
      return;
    }
    for (const vec3 p : motion[i].positions) {
      bounds_.extend(p);
    }
  }
  motion_ = std::move(motion);
}

std::shared_ptr<const Shape> Mesh::at(float time) const {
  const KeyTime key(time, motion_.size());
  const MeshKey &a = motion_[key.first], &b = motion_[key.first + 1];
  const float t = key.share;
  const std::shared_ptr<Mesh> mesh(new Mesh);
  mesh->name_ = name_;
  mesh->bounds_ = bounds_;
  mesh->topology_ = topology_;
  mesh->positions_.resize(positions_.size());
  for (size_t i = 0; i < a.positions.size(); ++i) {
    mesh->positions_[i] = (1.0f - t) * a.positions[i] + t * b.positions[i];
  }
  mesh->normals_.resize(normals_.size());
  for (size_t i = 0; i < a.normals.size(); ++i) {
    const vec3 n = (1.0f - t) * a.normals[i] + t * b.normals[i];
    const float length = glm::length(n);
    mesh->normals_[i] = length > 0.0f ? n / length : n;
  }
  return mesh;
}

vec3 Mesh::interpolated_normal(uint32_t primitive, vec2 b) const {
  const Triangle& t = triangles()[primitive];
  if (!smooth()) {
    const vec3 n =
        cross(positions_[t.v[1]] - positions_[t.v[0]], positions_[t.v[2]] - positions_[t.v[0]]);
    const float length = glm::length(n);
    return length > 0.0f ? n / length : n;
  }
  return (1.0f - b.x - b.y) * normals_[t.normal[0]] + b.x * normals_[t.normal[1]] +
         b.y * normals_[t.normal[2]];
}

void Mesh::corner_normals(uint32_t primitive, vec3 (&normals)[3]) const {
  for (int k = 0; k < 3; ++k) {
    normals[k] = smooth() ? normals_[triangles()[primitive].normal[k]] : vec3(0.0f);
  }
}

TriangleIndices Mesh::indices(uint32_t primitive) const {
  TriangleIndices result{};
  for (int k = 0; k < 3; ++k) {
    result.vertices[k] = triangles()[primitive].v[k];
    result.corners[k] = topology_->corners.empty() ? 0 : topology_->corners[primitive][k];
  }
  result.face = topology_->faces.empty() ? primitive : topology_->faces[primitive];
  return result;
}

}  // namespace janus
