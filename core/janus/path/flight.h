// SPDX-License-Identifier: GPL-3.0-or-later
//
// Free flight through transparent surfaces. Alpha and Transparent BSDFs are crossings, not vertices
// of the path: a walk passes them by chance, a connection multiplies their transparencies, and they
// appear in no density (the same factor in both walks, as a null collision). Their number is
// limited over the whole path, so that it is a property of the path and not of the technique.
//
// Where what lets light through depends on the path (PathSoFar), only walks and joins from the
// camera's side know it. Light walks end there, so that the density of all that they would do
// behind it is nought: weights are told by PathVertex::by_path, and joins by Connection.
#pragma once

#include <functional>

#include "janus/path/counters.h"
#include "janus/path/vertex.h"
#include "janus/sampling/sampler.h"

namespace janus {

// Calls f(light, LightHit) for the lamps on `ray` between two distances; `surface`: there is one at
// t_end, else the ray may leave the scene there; `path`: that leads there, but for its length.
template <class F>
void lamps_between(const Scene& scene, const Ray& ray, float t_begin, float t_end, bool surface,
                   const PathSoFar& path, F&& f) {
  const Ray up_to{ray.origin, ray.direction, t_end};
  scene.lamp_index.for_each_on_ray(up_to, [&](size_t lamp) {
    const Light& light = *scene.lights[lamp];
    const float t_max = light.infinite() && !surface ? kInfinity : t_end;
    const auto hit = light.look_along(Ray{ray.origin, ray.direction, t_max}, path);
    if (hit && hit->t > t_begin) {
      f(lamp, *hit);
    }
  });
}

// Shades the vertex where a light walk has arrived, flying in `direction`.
inline void shade_from_light(const Scene& scene, vec3 direction, PathVertex& v) {
  scene.shade(v.hit, -direction, v.shading, v.reshading);
  if (v.reshading.program && scene.has_transparency) {
    // What is let through is seen from the camera's side, which is ahead.
    v.shading.transparency = scene.shade(v.hit, direction).transparency;
  }
}

// Follows `ray`, which is of `type`, to the next vertex, which is written to `v.hit` and
// `v.shading`. Multiplies `v.beta` by what the crossings let through, counts them in `v.crossings`
// up to `max_crossings`, and calls on_segment(t_begin, t_end, surface) for each piece of the way,
// before `v.beta` changes; `surface` is whether v.hit and v.shading are its end, or the flight
// leaves the scene; t counts from the ray's origin. False: the flight left the scene or was
// absorbed.
template <class OnSegment>
bool fly(const Scene& scene, const Ray& ray, RayType type, TransportMode mode, int max_crossings,
         Sampler& sampler, uint64_t& rays, PathVertex& v, OnSegment&& on_segment) {
  Ray segment = ray;
  float t_begin = 0.0f;
  v.by_path = false;
  for (;;) {
    ++rays;
    if (!scene.intersect(segment, type, v.hit)) {
      on_segment(t_begin, ray.t_max, false);
      return false;
    }
    const float t_end = glm::length(v.hit.p - ray.origin);
    if (mode == TransportMode::Radiance) {
      scene.shade(v.hit, -ray.direction, v.shading, v.reshading,
                  scene.has_by_path ? v.path(t_end) : PathSoFar());
    } else {
      shade_from_light(scene, ray.direction, v);
    }
    on_segment(t_begin, t_end, true);
    const Rgb transparency = v.shading.transparency;
    if (is_black(transparency)) {
      return true;
    }
    const bool by_path = v.shading.bsdf.by_path();
    if (by_path && mode == TransportMode::Importance) [[unlikely]] {
      return false;
    }
    // The choice depends on the surface alone, so that both walks take it in the same way.
    const float through = average(transparency);
    const float pmf_pass = through / (through + v.shading.bsdf.albedo());
    if (sampler.next_1d() >= pmf_pass) {
      v.beta /= 1.0f - pmf_pass;
      return true;
    }
    if (v.crossings == max_crossings) {
      return false;
    }
    ++v.crossings;
    v.by_path |= by_path;
    v.beta *= transparency / pmf_pass;
    segment.origin = offset_origin(v.hit.p, v.hit.ng, v.hit.offset, ray.direction);
    segment.t_max = ray.t_max - t_end;
    t_begin = t_end;
  }
}

// --- Where some objects are not visible to all rays ---
//
// Seldom needed: kept out of the walks' way in flight.cpp.

// fly() from the side of the light. The segment is of `type`, but whether its end is there depends
// on the segment after it: surfaces that rays of `type` do not meet are passed by chance too.
// Writes `v.visibility`. `on_segment`, if any, as in fly().
bool fly_past(const Scene& scene, const Ray& ray, RayType type, int max_crossings, Sampler& sampler,
              uint64_t& rays, PathVertex& v, const std::function<void(float, float)>& on_segment);

// Types of one and the same effect for a segment of a light subpath, drawn from `possible` ones
// (not empty) before its end is known.
struct DrawnTypes {
  RayMask types;
  float pmf;
};
DrawnTypes draw_types(const Accel& accel, RayMask possible, Sampler& sampler);

// What lies before a light: what lets it through, and whether that depends on the path.
struct LightThrough {
  Rgb share;
  bool by_path;
};

// Calls found(light, LightHit, LightThrough) for each light on `ray` from a vertex at `from`, the
// way as a shadow ray sees it: surfaces that shadow rays do not meet emit, but do not block.
// `path`: that leads to the ray. Lights that cast no shadows are found behind everything;
// surfaces that no shadow ray looks for, not at all. (A world of one colour needs no shadow rays,
// but it is seen as they would.)
void look_for_lights(const Scene& scene, vec3 from, const Ray& ray, const PathSoFar& path,
                     int max_crossings, uint64_t& rays,
                     const std::function<void(size_t, const LightHit&, LightThrough)>& found);

}  // namespace janus
