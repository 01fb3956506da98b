// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/path/catching.h"

namespace janus {

namespace {

constexpr PathSoFar kFromCamera{};

Rgb background_behind(const Scene& scene, const Ray& ray) {
  Rgb sum(0.0f);
  for (const size_t lamp : scene.lamps) {
    const Light& light = *scene.lights[lamp];
    if (!light.background || !contains(light.visibility, RayType::Camera)) {
      continue;
    }
    if (const auto hit = light.look_along(Ray{ray.origin, ray.direction, kInfinity}, {})) {
      sum += hit->radiance;
    }
  }
  return sum;
}

}  // namespace

bool catch_view(const Scene& scene, const SurfaceInteraction& hit, const Ray& ray,
                const PathRules& rules, Rgb& beta, ViewCoverage& coverage) {
  if (!catches(scene, hit)) {
    return false;
  }
  if (scene.whole) {
    const vec3 before = offset_origin(hit.p, hit.ng, hit.offset, -ray.direction);
    beta *= scene.whole->transmittance(before, ray.origin, RayType::Camera, rules.max_crossings,
                                       Scene::End::B, &kFromCamera);
    return true;
  }
  coverage.caught = average(beta);
  coverage.matte -= coverage.caught;
  if (!rules.film_transparent) {
    coverage.behind = beta * background_behind(scene, ray);
  }
  return true;
}

bool catch_segment(const Scene& scene, vec3 from, vec3 to, bool caught, const PathRules& rules,
                   Rgb& value) {
  if (caught && !scene.whole) {
    return true;
  }
  const auto passed = scene.passed_catcher(to, from);
  if (!caught && !passed) {
    return false;
  }
  if (scene.whole) {
    value *= scene.whole->transmittance(passed.value_or(from), to, RayType::Camera,
                                        rules.max_crossings, Scene::End::B, &kFromCamera);
  }
  return true;
}

}  // namespace janus
