// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/geometry/round_shape.h"

#include <algorithm>

#include "janus/util/error.h"

namespace janus {

namespace {

void check_length(const std::string& key, const char* path, size_t length, size_t expected) {
  if (length != expected) {
    throw SceneError(key, path,
                     "has " + std::to_string(length) + " entries, not " + std::to_string(expected));
  }
}

// Where curves begin, and where the last one ends; balls are curves of one key each.
std::vector<uint32_t> starts_of(const std::string& key, const RoundDesc& desc) {
  if (desc.curves.empty()) {
    std::vector<uint32_t> starts(desc.positions.size() + 1);
    for (size_t i = 0; i < starts.size(); ++i) {
      starts[i] = static_cast<uint32_t>(i);
    }
    return starts;
  }
  if (desc.curves.front() != 0 || desc.curves.back() != desc.positions.size() ||
      !std::ranges::is_sorted(desc.curves)) {
    throw SceneError(key, "curves", "must rise from 0 to the number of positions");
  }
  return desc.curves;
}

void check(const std::string& key, const RoundDesc& desc, size_t curves) {
  check_length(key, "radii", desc.radii.size(), desc.positions.size());
  if (!desc.material_indices.empty()) {
    check_length(key, "material_indices", desc.material_indices.size(), curves);
  }
  for (const AttributeDesc& attribute : desc.attributes) {
    if (attribute.domain == AttributeDomain::Corner) {
      throw SceneError(key, "attributes[" + attribute.key + "]", "there are no corners");
    }
    check_attribute(key, attribute,
                    attribute.domain == AttributeDomain::Mesh    ? 1
                    : attribute.domain == AttributeDomain::Point ? desc.positions.size()
                                                                 : curves);
  }
}

}  // namespace

RoundShape::RoundShape(const std::string& key, RoundDesc&& desc) {
  name_ = desc.name.empty() ? key : desc.name;
  const std::vector<uint32_t> starts = starts_of(key, desc);
  const size_t curves = starts.size() - 1;
  check(key, desc, curves);
  auto topology = std::make_shared<Topology>();
  topology->kind = desc.curves.empty() ? Kind::Balls
                   : desc.straight     ? Kind::Straight
                                       : Kind::Smooth;
  const bool smooth = topology->kind == Kind::Smooth;
  size_t dropped = 0;
  for (uint32_t curve = 0; curve < curves; ++curve) {
    const uint32_t begin = starts[curve], end = starts[curve + 1];
    bool finite = true, thick = false;
    for (uint32_t i = begin; i < end; ++i) {
      finite = finite && is_finite(desc.positions[i]) && std::isfinite(desc.radii[i]);
      thick = thick || desc.radii[i] > 0.0f;
    }
    dropped += !finite;
    if (!finite || !thick || (!desc.curves.empty() && end - begin < 2)) {
      continue;
    }
    const auto add_control = [&](uint32_t i) {
      topology->keys.push_back(i);
      topology->radii.push_back(std::max(desc.radii[i], 0.0f));
    };
    const auto first = static_cast<uint32_t>(topology->keys.size());
    if (desc.curves.empty()) {
      topology->pieces.push_back({first, begin, curve});
      add_control(begin);
      continue;
    }
    if (smooth) {
      add_control(begin);
    }
    for (uint32_t i = begin; i < end; ++i) {
      add_control(i);
      if (i + 1 < end) {
        topology->pieces.push_back({first + (i - begin), i, curve});
      }
    }
    if (smooth) {
      add_control(end - 1);
      for (const uint32_t key : {begin, end - 1}) {
        if (desc.radii[key] > 0.0f) {
          topology->disks.push_back({first + 1 + (key - begin), key, curve});
        }
      }
    }
  }
  if (dropped > 0) {
    warn(std::to_string(dropped) + (desc.curves.empty() ? " points" : " curves") +
         " that are not finite are left out");
  }
  topology->materials = std::move(desc.material_indices);
  topology->attributes = std::move(desc.attributes);
  topology_ = std::move(topology);
  place_controls(desc.positions);
  take_motion(key, desc.positions.size(), std::move(desc.motion));
  desc = {};
}

void RoundShape::place_controls(const std::vector<vec3>& positions) {
  controls_.clear();
  controls_.reserve(topology_->keys.size());
  for (size_t i = 0; i < topology_->keys.size(); ++i) {
    controls_.emplace_back(positions[topology_->keys[i]], topology_->radii[i]);
  }
  disk_places_.clear();
  disk_normals_.clear();
  for (const Piece& disk : disks()) {
    // Away from the neighbour: the other one is the key itself.
    const vec4* c = &controls_[disk.control];
    const vec3 out = 2.0f * vec3(c[0]) - vec3(c[-1]) - vec3(c[1]);
    const float length = glm::length(out);
    disk_places_.push_back(c[0]);
    disk_normals_.push_back(length > 0.0f ? out / length : vec3(0, 0, 1));
  }
  disk_places_.emplace_back(0.0f);
  disk_normals_.emplace_back(0.0f);
  extend_bounds();
}

// By the control points of the pieces as Bezier curves, which enclose them.
void RoundShape::extend_bounds() {
  const auto extend = [&](vec4 c) {
    bounds_.extend(vec3(c) - std::abs(c.w));
    bounds_.extend(vec3(c) + std::abs(c.w));
  };
  for (const Piece& piece : pieces()) {
    const vec4* c = &controls_[piece.control];
    if (kind() != Kind::Smooth) {
      extend(c[0]);
      extend(c[kind() == Kind::Straight ? 1 : 0]);
      continue;
    }
    extend(c[1]);
    extend(c[1] + (c[2] - c[0]) / 6.0f);
    extend(c[2] - (c[3] - c[1]) / 6.0f);
    extend(c[2]);
  }
}

void RoundShape::take_motion(const std::string& key, size_t positions,
                             std::vector<MeshKey> motion) {
  if (motion.empty()) {
    return;
  }
  if (motion.size() == 1) {
    throw SceneError(key, "motion", "one time is no motion");
  }
  for (const MeshKey& time : motion) {
    check_length(key, "motion", time.positions.size(), positions);
    if (!time.normals.empty()) {
      throw SceneError(key, "motion", "curves and points have no normals");
    }
    for (const uint32_t i : topology_->keys) {
      if (!is_finite(time.positions[i])) {
        warn(
            "it has points that are not finite at some time of the shutter: it is rendered "
            "without deformation");
        return;
      }
    }
  }
  const std::vector<vec4> now = controls_;
  for (const MeshKey& time : motion) {
    place_controls(time.positions);
  }
  controls_ = now;
  motion_ = std::move(motion);
}

std::shared_ptr<const Shape> RoundShape::at(float time) const {
  const KeyTime key(time, motion_.size());
  const std::vector<vec3>&a = motion_[key.first].positions, &b = motion_[key.first + 1].positions;
  std::vector<vec3> positions(a.size());
  for (size_t i = 0; i < a.size(); ++i) {
    positions[i] = (1.0f - key.share) * a[i] + key.share * b[i];
  }
  const std::shared_ptr<RoundShape> shape(new RoundShape);
  shape->name_ = name_;
  shape->topology_ = topology_;
  shape->place_controls(positions);
  shape->bounds_ = bounds_;
  return shape;
}

uint32_t RoundShape::material(uint32_t primitive) const {
  return topology_->materials.empty() ? 0 : topology_->materials[piece(primitive).curve];
}

// As a triangle with two of its corners in one: attributes are interpolated along the first edge.
TriangleIndices RoundShape::indices(uint32_t primitive) const {
  const Piece& piece = this->piece(primitive);
  const uint32_t next = piece.key + (curves() && primitive < pieces().size() ? 1 : 0);
  return {{piece.key, next, next}, {}, piece.curve};
}

RoundShape::Place RoundShape::place(uint32_t primitive, float u) const {
  const vec4* c = &controls_[piece(primitive).control];
  if (kind() == Kind::Balls || primitive >= pieces().size()) {
    return {vec3(c[0]), c[0].w, vec3(0.0f)};
  }
  if (kind() == Kind::Straight) {
    const vec4 at = (1.0f - u) * c[0] + u * c[1];
    return {vec3(at), at.w, vec3(c[1] - c[0])};
  }
  const float u2 = u * u, u3 = u2 * u;
  const vec4 at = 0.5f * ((-u3 + 2.0f * u2 - u) * c[0] + (3.0f * u3 - 5.0f * u2 + 2.0f) * c[1] +
                          (-3.0f * u3 + 4.0f * u2 + u) * c[2] + (u3 - u2) * c[3]);
  const vec4 along =
      0.5f * ((-3.0f * u2 + 4.0f * u - 1.0f) * c[0] + (9.0f * u2 - 10.0f * u) * c[1] +
              (-9.0f * u2 + 8.0f * u + 1.0f) * c[2] + (3.0f * u2 - 2.0f * u) * c[3]);
  return {vec3(at), std::abs(at.w), vec3(along)};
}

}  // namespace janus
