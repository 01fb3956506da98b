// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "janus/math/vec.h"

namespace janus {

// A right-handed orthonormal basis around a unit normal (Duff et al. 2017).
struct Frame {
  vec3 s, t, n;

  explicit Frame(vec3 normal) : n(normal) {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1.0f / (sign + n.z);
    const float b = n.x * n.y * a;
    s = vec3(1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x);
    t = vec3(b, sign + n.y * n.y * a, -n.y);
  }
  vec3 to_world(vec3 v) const { return v.x * s + v.y * t + v.z * n; }
};

}  // namespace janus
