// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "janus/geometry/motion.h"
#include "janus/geometry/shape.h"

namespace janus {

// Object-to-world placement of a shape.
struct Instance {
  // Of the object (InstanceDesc); many instances have the same.
  struct Names {
    std::string name, light_group, asset;

    auto operator<=>(const Names&) const = default;
  };
  static std::shared_ptr<const Names> nameless() {
    static const auto none = std::make_shared<const Names>();
    return none;
  }

  uint32_t shape = 0;
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
  std::shared_ptr<const Names> names = nameless();

  uint32_t material(uint32_t slot) const {
    // Cycles uses the last slot for an index beyond the list.
    return materials[slot < materials.size() ? slot : materials.size() - 1];
  }
};

// By ray type: the first type that meets the same instances; kRayTypes: it meets all of them.
std::array<int, kRayTypes> first_alike(const std::vector<Instance>& instances);

}  // namespace janus
