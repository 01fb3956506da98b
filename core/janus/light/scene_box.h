// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>

#include "janus/math/vec.h"

namespace janus {

// Where the surfaces of a scene are, as infinite lights see it: a box along the axes. A ray that
// meets the box enters it through one of the three faces that look against its direction, so
// parallel rays are spread over what the box shows of these. A sphere around a wide and flat scene
// would catch several times as many rays that meet nothing.
class SceneBox {
 public:
  // Nothing at all becomes a box of a millimetre, and a plane gets a thickness: the faces that a
  // ray along it meets must have an area.
  explicit SceneBox(const Bounds& bounds)
      : center_(bounds.center()), radius_(std::max(bounds.radius(), 1e-3f)) {
    const vec3 half = bounds.empty() ? vec3(0.0f) : 0.5f * (bounds.upper - bounds.lower);
    half_ = glm::max(half, vec3(1e-3f * radius_));
  }

  // Of the box's outline along `direction` (either way), square metres.
  float area(vec3 direction) const { return sum(faces(direction)); }
  // The mean of area() over all directions: a quarter of the surface (Cauchy).
  float mean_area() const { return 0.5f * sum(vec3(face(0), face(1), face(2))); }

  // A point before all surfaces, from which a ray along `direction` enters the box: uniform over
  // its outline, with density 1 / area(direction).
  vec3 sample_entry(vec3 direction, vec2 u) const {
    const vec3 faces = this->faces(direction);
    const float total = sum(faces);
    int axis = 0;
    float rest = u.x * total;
    while (axis < 2 && rest >= faces[axis]) {
      rest -= faces[axis++];
    }
    const float along = faces[axis] > 0.0f ? std::min(rest / faces[axis], 1.0f) : 0.5f;
    vec3 p = center_;
    p[axis] += std::copysign(half_[axis], -direction[axis]);
    p[(axis + 1) % 3] += half_[(axis + 1) % 3] * (2.0f * along - 1.0f);
    p[(axis + 2) % 3] += half_[(axis + 2) % 3] * (2.0f * u.y - 1.0f);
    return p - 0.01f * radius_ * direction;
  }

  // A distance that leads from `p` along any direction to the outside of everything.
  float beyond(vec3 p) const { return glm::length(p - center_) + 1.02f * radius_; }

 private:
  static float sum(vec3 v) { return v.x + v.y + v.z; }
  float face(int axis) const { return 4.0f * half_[(axis + 1) % 3] * half_[(axis + 2) % 3]; }
  // What each axis's face shows to `direction`.
  vec3 faces(vec3 direction) const { return glm::abs(direction) * vec3(face(0), face(1), face(2)); }

  vec3 center_, half_;
  float radius_;  // of a sphere around it
};

}  // namespace janus
