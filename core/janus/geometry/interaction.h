// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "janus/math/vec.h"

namespace janus {

// A point on a surface, in world space.
struct SurfaceInteraction {
  vec3 p;
  vec3 ng;       // geometric normal, unit, front side
  vec3 ns;       // shading normal, unit, front side
  float offset;  // how far rays must start off the surface along +-ng (see offset_origin)
  uint32_t instance, primitive;
  vec2 barycentric;
  uint32_t material;  // index in Surfaces
};

// The origin for a ray that leaves `p` in direction `d`. Walks and shadow rays use the same rule
// at both of their ends, so that no technique sees light leaks that another does not see.
inline vec3 offset_origin(vec3 p, vec3 ng, float offset, vec3 d) {
  return p + (dot(d, ng) < 0.0f ? -offset : offset) * ng;
}

}  // namespace janus
