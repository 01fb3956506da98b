// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/path/flight.h"

#include <algorithm>

#include "janus/render/onlookers.h"
#include "janus/render/shadows_ahead.h"

namespace janus {

namespace {

// What is where a light walk meets a surface: one instance, or copies of it for different rays.
struct Place {
  Rgb transparency = Rgb(1.0f);         // for the segment that leads there
  bool blocks = false;                  // does it count as a crossing?
  float albedo[std::size(kRays)] = {};  // of the copies that the walk may end at
  float sum = 0.0f;
};

bool may_end(const Instance& instance) {
  return (instance.visibility & (kLabels | ray_bit(RayType::Camera))) != 0;
}

void shade_copy(const Scene& scene, vec3 direction, uint32_t copy, PathVertex& v) {
  scene.turn_to_copy(v.hit, copy);
  v.visibility = scene.instances[copy].visibility;
  shade_from_light(scene, direction, v);
}

// Leaves the last copy in `v`.
Place look_at(const Scene& scene, vec3 direction, RayType type, PathVertex& v) {
  const Instance& met = scene.instances[v.hit.instance];
  const uint32_t first = met.first_copy;
  Place place;
  for (uint32_t i = 0; i < met.copies; ++i) {
    const Instance& copy = scene.instances[first + i];
    shade_copy(scene, direction, first + i, v);
    const bool by_path = v.shading.bsdf.by_path();  // light walks do not know
    if (contains(copy.visibility, type)) {
      place.blocks = true;
      place.transparency = by_path ? Rgb(0.0f) : v.shading.transparency;
    }
    place.albedo[i] = may_end(copy) && !by_path ? v.shading.bsdf.albedo() : 0.0f;
    place.sum += place.albedo[i];
  }
  return place;
}

}  // namespace

bool fly_past(const Scene& scene, const Ray& ray, RayType type, int max_crossings, Sampler& sampler,
              uint64_t& rays, PathVertex& v, const std::function<void(float, float)>& on_segment) {
  Ray segment = ray;
  float t_begin = 0.0f;
  for (;;) {
    ++rays;
    const bool surface = scene.accel->intersect_any(segment, v.hit);
    if (on_segment) {
      const float t_end = surface ? glm::length(v.hit.p - ray.origin) : ray.t_max;
      on_segment(t_begin, t_end);
      t_begin = t_end;
    }
    if (!surface) {
      return false;
    }
    const Instance& met = scene.instances[v.hit.instance];
    const Place place = look_at(scene, ray.direction, type, v);
    if (met.copies == 1 && is_black(place.transparency)) {
      return may_end(met);
    }
    const float through = average(place.transparency), sum = through + place.sum;
    if (!(sum > 0.0f)) {
      return false;
    }
    float u = sampler.next_1d() * sum - through;
    if (u >= 0.0f) {
      uint32_t chosen = 0;
      while (chosen + 1 < met.copies && u >= place.albedo[chosen]) {
        u -= place.albedo[chosen++];
      }
      if (!(place.albedo[chosen] > 0.0f)) {
        return false;  // rounding, at the very end
      }
      if (met.copies > 1) {
        shade_copy(scene, ray.direction, met.first_copy + chosen, v);
      }
      v.beta /= place.albedo[chosen] / sum;
      return true;
    }
    if (place.blocks && v.crossings++ == max_crossings) {
      return false;
    }
    v.beta *= place.transparency / (through / sum);
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

void look_for_lights(const Scene& scene, vec3 from, const Ray& ray, const PathSoFar& path,
                     int max_crossings, uint64_t& rays,
                     const std::function<void(size_t, const LightHit&, LightThrough)>& found) {
  ShadowsAhead shadows(scene.shadow_types, path.crossings, max_crossings);
  RayMask by_path = 0;
  const auto report = [&](size_t index, const LightHit& light) {
    const RayType type = scene.lights[index]->shadow_ray;
    const Rgb through = shadows.through(type);
    if (!is_black(through)) {
      found(index, light, {through, contains(by_path, type)});
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
    lamps_between(scene, ray, t_begin, t_end, surface, path.after(shadows.crossings(), t_end),
                  report);
    if (!surface) {
      return;
    }
    const Instance& met = scene.instances[hit.instance];
    const PathSoFar here = path.after(shadows.crossings(), t_end);
    RayMask asked = 0;
    for (uint32_t i = 0; i < met.copies; ++i) {
      scene.turn_to_copy(hit, met.first_copy + i);
      scene.shade(hit, -ray.direction, shading, here);
      if (size_t index; !is_black(shading.emission)) {
        if (const MeshLight* light = scene.mesh_light(hit, index)) {
          const LightHit shine = light->at(hit, from, ray.direction, shading.emission);
          if (!shine.by_chance()) {
            report(index, shine);
          }
        }
      }
      const RayMask seen_by = scene.instances[hit.instance].visibility;
      asked |= shading.bsdf.by_path() ? seen_by : 0;
      shadows.meet(seen_by, shading.transparency);
    }
    by_path |= asked;
    if (shadows.ended()) {
      return;
    }
    segment.origin = offset_origin(hit.p, hit.ng, hit.offset, ray.direction);
    segment.t_max = ray.t_max - t_end;
    t_begin = t_end;
  }
}

}  // namespace janus
