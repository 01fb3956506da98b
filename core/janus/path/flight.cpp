// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/path/flight.h"

#include <algorithm>

namespace janus {

bool fly_past(const Scene& scene, const Ray& ray, RayType type, int max_crossings, Sampler& sampler,
              uint64_t& rays, PathVertex& v) {
  Ray segment = ray;
  for (;;) {
    ++rays;
    if (!scene.accel->intersect_any(segment, v.hit)) {
      return false;
    }
    v.visibility = scene.instances[v.hit.instance].visibility;
    shade_from_light(scene, ray.direction, v);
    const bool blocks = contains(v.visibility, type);
    const bool may_end = (v.visibility & (kLabels | ray_bit(RayType::Camera))) != 0;
    const Rgb transparency = blocks ? v.shading.transparency : Rgb(1.0f);
    if (is_black(transparency)) {
      return may_end;
    }
    const float through = average(transparency);
    const float pmf_pass = through / (through + (may_end ? v.shading.bsdf.albedo() : 0.0f));
    if (sampler.next_1d() >= pmf_pass) {
      v.beta /= 1.0f - pmf_pass;
      return true;
    }
    if (blocks && v.crossings++ == max_crossings) {
      return false;
    }
    v.beta *= transparency / pmf_pass;
    segment.origin = offset_origin(v.hit.p, v.hit.ng, v.hit.offset, ray.direction);
    segment.t_max = ray.t_max - glm::length(segment.origin - ray.origin);
  }
}

DrawnTypes draw_types(const Accel& accel, RayMask possible, Sampler& sampler) {
  RayMask groups[kRayTypes];
  RayType first[kRayTypes];
  int count = 0;
  for (int i = 0; i < kRayTypes; ++i) {
    const auto type = static_cast<RayType>(i);
    if (!contains(possible, type)) {
      continue;
    }
    int group = 0;
    while (group < count && !accel.alike(first[group], type)) {
      ++group;
    }
    if (group == count) {
      groups[count] = 0;
      first[count++] = type;
    }
    groups[group] |= ray_bit(type);
  }
  const int drawn =
      count == 1 ? 0 : std::min(static_cast<int>(sampler.next_1d() * count), count - 1);
  return {groups[drawn], 1.0f / static_cast<float>(count)};
}

void look_for_lights(const Scene& scene, vec3 from, const Ray& ray, int crossings,
                     int max_crossings, uint64_t& rays,
                     const std::function<void(size_t, const LightHit&, Rgb)>& found) {
  Rgb through(1.0f);
  // What casts no shadows is seen through everything.
  const auto report = [&](size_t index, const LightHit& light) {
    if (light.by_chance()) {
      return;
    }
    const bool blocked = scene.lights[index]->shadow_ray == RayType::Shadow;
    if (!blocked || !is_black(through)) {
      found(index, light, blocked ? through : Rgb(1.0f));
    }
  };
  Ray segment = ray;
  float t_begin = 0.0f;
  SurfaceInteraction hit;
  ShadingResult shading;
  for (;;) {
    ++rays;
    const bool surface = scene.accel->intersect_any(segment, hit);
    const float t_end = surface ? glm::length(hit.p - ray.origin) : ray.t_max;
    lamps_between(scene, ray, t_begin, t_end, surface, report);
    if (!surface) {
      return;
    }
    scene.shade(hit, -ray.direction, shading);
    if (size_t index; !is_black(shading.emission)) {
      if (const MeshLight* light = scene.mesh_light(hit, index)) {
        report(index, light->at(hit, from, ray.direction, shading.emission));
      }
    }
    if (contains(scene.instances[hit.instance].visibility, RayType::Shadow)) {
      through *= crossings++ < max_crossings ? shading.transparency : Rgb(0.0f);
      if (is_black(through) && !scene.has_unblocked) {
        return;
      }
    }
    segment.origin = offset_origin(hit.p, hit.ng, hit.offset, ray.direction);
    segment.t_max = ray.t_max - t_end;
    t_begin = t_end;
  }
}

}  // namespace janus
