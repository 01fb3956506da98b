// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/render/scene.h"

namespace janus {

Rgb Scene::transmittance_through(vec3 a, vec3 b, RayType type, int max_crossings,
                                 End camera) const {
  if (accel->occluded_opaque(a, b, type)) {
    return Rgb(0.0f);
  }
  const float length = glm::length(b - a);
  const vec3 d = (b - a) / length;
  // What `b` lies on is no crossing: the ray ends before it, as in Accel::occluded().
  const float rest = (1.0f - Accel::kShadowReach) * length;
  Rgb result(1.0f);
  Ray ray{a, d, length - rest};
  SurfaceInteraction hit;
  for (int crossings = 0;; ++crossings) {
    if (!accel->intersect_transparent(ray, type, hit)) {
      return result;
    }
    result *= shade(hit, camera == End::A ? -d : d).transparency;
    if (is_black(result) || crossings >= max_crossings) {
      return Rgb(0.0f);
    }
    ray.origin = offset_origin(hit.p, hit.ng, hit.offset, d);
    ray.t_max = dot(b - ray.origin, d) - rest;
    if (!(ray.t_max > 0.0f)) {
      return result;
    }
  }
}

}  // namespace janus
