// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "janus/math/vec.h"
#include "janus/scene/description.h"
#include "janus/scene/diagnostics.h"
#include "janus/shading/shading_point.h"

namespace janus {

class Mesh;
class RoundShape;

// What instances place, in object space: a Mesh or a RoundShape.
class Shape {
 public:
  virtual ~Shape() = default;

  // Which of the two it is; the other is null.
  virtual const Mesh* mesh() const { return nullptr; }
  virtual const RoundShape* round() const { return nullptr; }

  // Does it change its form while the shutter is open?
  virtual bool moves() const = 0;
  // As it is at a time: one that stands still, made of the same primitives. Only if moves().
  virtual std::shared_ptr<const Shape> at(float time) const = 0;

  // What rays meet: triangles, pieces of curves, or balls.
  virtual size_t primitives() const = 0;
  // The slot of its material.
  virtual uint32_t material(uint32_t primitive) const = 0;
  // Where the attributes of a primitive stand.
  virtual TriangleIndices indices(uint32_t primitive) const = 0;
  const AttributeDesc* attribute(const std::string& key) const {  // nullptr: it has none
    const auto found = std::ranges::find(attributes(), key, &AttributeDesc::key);
    return found == attributes().end() ? nullptr : &*found;
  }

  const std::string& name() const { return name_; }
  // What was not as asked.
  const Diagnostics& diagnostics() const { return diagnostics_; }
  const Bounds& bounds() const { return bounds_; }  // of the primitives, at all times

 protected:
  virtual const std::vector<AttributeDesc>& attributes() const = 0;
  void warn(const std::string& message) {
    diagnostics_.push_back({Severity::Warning, name_, "", "", message});
  }

  std::string name_;
  Diagnostics diagnostics_;
  Bounds bounds_;
};

// Scenes of one builder share the shapes that have not changed.
using ShapeList = std::vector<std::shared_ptr<const Shape>>;

// Throws SceneError for an attribute with a wrong number of channels or elements. `elements`: how
// many its domain has; `at_least`: more of them do no harm.
void check_attribute(const std::string& key, const AttributeDesc& attribute, size_t elements,
                     bool at_least = false);

}  // namespace janus
