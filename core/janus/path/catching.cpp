// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/path/catching.h"

namespace janus {

namespace {

Rgb background_behind(const Scene& scene, const Ray& ray) {
  Rgb sum(0.0f);
  for (const size_t lamp : scene.lamps) {
    const Light& light = *scene.lights[lamp];
    if (!light.background || !contains(light.visibility, RayType::Camera)) {
      continue;
    }
    if (const auto hit = light.intersect(Ray{ray.origin, ray.direction, kInfinity})) {
      sum += hit->radiance;
    }
  }
  return sum;
}

}  // namespace

bool catch_view(const Scene& scene, const SurfaceInteraction& hit, const Ray& ray, Rgb beta,
                const PathRules& rules, ViewCoverage& coverage) {
  if (!catches(scene, hit)) {
    return false;
  }
  coverage.matte -= average(beta);
  if (!rules.film_transparent) {
    coverage.behind = beta * background_behind(scene, ray);
  }
  return true;
}

}  // namespace janus
