// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "janus/light/lamps.h"
#include "janus/math/frame.h"
#include "janus/math/warp.h"

namespace janus {

// What lights beyond all surfaces have in common: their rays come through a disk that covers the
// scene, so the density of a ray is that of its direction over the disk's area.
class InfiniteLight : public Light {
 public:
  explicit InfiniteLight(const Sphere& scene) : scene_(scene) {}

  bool infinite() const override { return true; }

 protected:
  RayDensity density(float pdf_direction) const { return {pdf_direction / scene_.area(), false}; }

  EmissionSample emit(vec3 direction, vec2 u, Rgb radiance, float pdf_direction) const {
    const vec2 disk = scene_.radius * square_to_disk(u);
    const Frame frame(direction);
    const vec3 origin =
        scene_.center + disk.x * frame.s + disk.y * frame.t - 1.01f * scene_.radius * direction;
    const RayDensity ray = density(pdf_direction);
    return EmissionSample{origin, direction, radiance / ray.value, ray};
  }

  IlluminationSample illuminate(vec3 receiver, vec3 wi, Rgb radiance, float pdf,
                                RayDensity emission) const {
    const float beyond = glm::length(receiver - scene_.center) + 1.01f * scene_.radius;
    return IlluminationSample{wi, receiver + beyond * wi, kInfinity, radiance, pdf, emission};
  }

  Sphere scene_;
};

}  // namespace janus
