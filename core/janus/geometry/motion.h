// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where something is while the shutter is open. Times run from 0, when it opens, to 1.
#pragma once

#include <algorithm>
#include <glm/gtc/quaternion.hpp>
#include <vector>

#include "janus/math/vec.h"

namespace janus {

// Where a time falls among keys at even times.
struct KeyTime {
  size_t first;  // between this key and the next
  float share;   // of the next

  KeyTime(float time, size_t keys) {
    const float place = std::clamp(time, 0.0f, 1.0f) * static_cast<float>(keys - 1);
    first = std::min(static_cast<size_t>(place), keys - 2);
    share = place - static_cast<float>(first);
  }
};

// A transform over time. As in Cycles, what turns between two keys goes on an arc: places and
// stretches are blended, and rotations are on the sphere of quaternions.
class Motion {
 public:
  // Two keys or more, at even times; none of them flat.
  explicit Motion(const std::vector<mat4>& keys);

  mat4 at(float time) const;
  // Encloses what `local` covers in all of the time.
  Bounds swept(const Bounds& local) const;

 private:
  struct Pose {
    vec3 place;
    glm::quat rotation;
    mat3 stretch;
  };
  std::vector<Pose> poses_;
};

}  // namespace janus
