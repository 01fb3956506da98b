// SPDX-License-Identifier: GPL-3.0-or-later
//
// Free flight through transparent surfaces. Alpha and Transparent BSDFs are crossings, not vertices
// of the path: a walk passes them by chance, a connection multiplies their transparencies, and they
// appear in no density (the same factor in both walks, as a null collision). Their number is
// limited over the whole path, so that it is a property of the path and not of the technique.
#pragma once

#include "janus/path/counters.h"
#include "janus/path/vertex.h"
#include "janus/sampling/sampler.h"

namespace janus {

// Follows `ray` to the next vertex, which is written to `v.hit` and `v.shading`. Multiplies
// `v.beta` by what the crossings let through, counts them in `v.crossings` up to `max_crossings`,
// and calls on_segment(t_begin, t_end, surface) for each piece of the way, before `v.beta` changes;
// `surface` is whether v.hit and v.shading are its end, or the flight leaves the scene; t counts
// from the ray's origin. False: the flight left the scene or was absorbed.
template <class OnSegment>
bool fly(const Scene& scene, const Ray& ray, int max_crossings, Sampler& sampler, uint64_t& rays,
         PathVertex& v, OnSegment&& on_segment) {
  Ray segment = ray;
  float t_begin = 0.0f;
  for (;;) {
    ++rays;
    if (!scene.intersect(segment, v.hit)) {
      on_segment(t_begin, ray.t_max, false);
      return false;
    }
    const float t_end = glm::length(v.hit.p - ray.origin);
    scene.shade(v.hit, v.shading);
    on_segment(t_begin, t_end, true);
    const Rgb transparency = v.shading.transparency;
    if (is_black(transparency)) {
      return true;
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
    v.beta *= transparency / pmf_pass;
    segment.origin = offset_origin(v.hit.p, v.hit.ng, v.hit.offset, ray.direction);
    segment.t_max = ray.t_max - t_end;
    t_begin = t_end;
  }
}

}  // namespace janus
