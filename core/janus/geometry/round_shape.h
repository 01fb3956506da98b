// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "janus/geometry/motion.h"
#include "janus/geometry/shape.h"

namespace janus {

// Tubes along curves, or balls. As in Cycles they are seen from outside alone: a ray that starts
// within leaves without meeting anything. What light does inside is the material's business. Unlike
// there the ends of tubes are closed: what an open end lets in would be seen from one side alone.
class RoundShape final : public Shape {
 public:
  // What rays meet: a piece of a curve between two of its keys, a ball, or a disk at an end of a
  // smooth curve.
  struct Piece {
    uint32_t control;  // the first of the piece's in controls(); of a disk, its own
    uint32_t key;      // in the description's positions; a curve's piece goes on to the next one
    uint32_t curve;    // in the description; balls: their key
  };

  // Checks the description, and empties it if it is right. Throws SceneError for arrays of wrong
  // length; leaves out curves and balls that are not finite and says so, and those of no size.
  RoundShape(const std::string& key, RoundDesc&& desc);

  const RoundShape* round() const override { return this; }
  bool moves() const override { return !motion_.empty(); }
  std::shared_ptr<const Shape> at(float time) const override;
  size_t primitives() const override { return pieces().size() + disks().size(); }
  uint32_t material(uint32_t primitive) const override;
  TriangleIndices indices(uint32_t primitive) const override;

  enum class Kind : uint8_t { Balls, Smooth, Straight };
  Kind kind() const { return topology_->kind; }
  bool curves() const { return kind() != Kind::Balls; }
  const std::vector<Piece>& pieces() const { return topology_->pieces; }
  // Behind the pieces, in the order of primitives.
  const std::vector<Piece>& disks() const { return topology_->disks; }
  // The same as places and radii, and the directions to which they look, unit; one more than there
  // are, for Embree.
  const std::vector<vec4>& disk_places() const { return disk_places_; }
  const std::vector<vec3>& disk_normals() const { return disk_normals_; }
  // Places and radii. A ball has one, and a straight piece its ends. A smooth one has four, between
  // the second and third of which it goes: Catmull-Rom splines, whose first and last key are there
  // twice.
  const std::vector<vec4>& controls() const { return controls_; }

  // A place along a piece, u from 0 to 1; of a ball or a disk, its centre and no direction.
  struct Place {
    vec3 center;
    float radius;
    vec3 along;  // derivative of `center` by u
  };
  Place place(uint32_t primitive, float u) const;

 private:
  // What does not change with time.
  struct Topology {
    Kind kind = Kind::Balls;
    std::vector<Piece> pieces, disks;
    std::vector<uint32_t> keys;       // by control
    std::vector<float> radii;         // by control
    std::vector<uint32_t> materials;  // by curve or ball of the description; empty: slot 0
    std::vector<AttributeDesc> attributes;
  };

  RoundShape() = default;
  const std::vector<AttributeDesc>& attributes() const override { return topology_->attributes; }
  void place_controls(const std::vector<vec3>& positions);
  void take_motion(const std::string& key, size_t positions, std::vector<MeshKey> motion);
  void extend_bounds();

  const Piece& piece(uint32_t primitive) const {
    const size_t disk = primitive - pieces().size();
    return primitive < pieces().size() ? pieces()[primitive] : disks()[disk];
  }

  std::vector<vec4> controls_, disk_places_;
  std::vector<vec3> disk_normals_;
  std::shared_ptr<const Topology> topology_;
  std::vector<MeshKey> motion_;
};

}  // namespace janus
