// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "janus/light/lamps.h"

namespace janus {

// What lights beyond all surfaces have in common: their rays enter the box that holds the scene, so
// the density of a ray is that of its direction over the area that the box shows to it.
class InfiniteLight : public Light {
 public:
  explicit InfiniteLight(const SceneBox& scene) : scene_(scene) {}

  bool infinite() const override { return true; }

 protected:
  RayDensity density(vec3 direction, float pdf_direction) const {
    return {pdf_direction / scene_.area(direction), false};
  }

  EmissionSample emit(vec3 direction, vec2 u, Rgb radiance, float pdf_direction) const {
    const RayDensity ray = density(direction, pdf_direction);
    return EmissionSample{scene_.sample_entry(direction, u), direction, radiance / ray.value, ray};
  }

  IlluminationSample illuminate(vec3 receiver, vec3 wi, Rgb radiance, float pdf) const {
    return IlluminationSample{
        wi, receiver + scene_.beyond(receiver) * wi, kInfinity, radiance, pdf, density(wi, pdf)};
  }

  SceneBox scene_;
};

}  // namespace janus
