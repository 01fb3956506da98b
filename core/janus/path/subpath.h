// SPDX-License-Identifier: GPL-3.0-or-later
//
// Random walks from the lights and from the camera. They keep what the weights need and hand each
// vertex to a visitor; what is done there (connect, splat, gather) is the integrator's business.
#pragma once

#include <algorithm>

#include "janus/camera/camera.h"
#include "janus/path/counters.h"
#include "janus/path/mis.h"
#include "janus/render/scene.h"
#include "janus/sampling/sampler.h"

namespace janus {

struct WalkSettings {
  int max_edges = 14;  // edges of a whole path; Cycles' max_bounces + 2
};

// The light's end of a path: J and pN of path/mis.h.
struct LightEnd {
  float joint = 0.0f, pdf_nee = 0.0f;
  bool hittable = false;
  vec3 wi = vec3(0.0f);  // unit, from z_1 to z_0
};

// How a walk left a vertex (see BsdfSample).
struct Departure {
  bool delta = false;
  float pdf_solid = 0.0f, pdf_reverse = 0.0f;
};

// A scattering vertex of a subpath.
struct PathVertex {
  SurfaceInteraction hit;
  ShadingResult shading;
  vec3 back;  // unit direction to the previous vertex: wi on light, wo on camera subpaths
  Rgb beta;   // light: flux that arrives; camera: throughput
  MisState mis;
  int edges;           // from the start of the subpath
  Departure previous;  // how the walk left the vertex before (edges > 1)
  LightEnd light_end;  // light subpaths: their start

  BsdfView bsdf() const { return shading.bsdf.view(hit.ng); }
};

// Light found on the segment after a camera vertex: a path of technique s=0 with `edges` edges.
struct LightFound {
  size_t light;  // index in Scene::lights
  LightHit hit;
  Rgb beta;
  int edges;
  float weight;        // MIS weight; 1 for edges == 1
  LightEnd end;        // for edges > 1
  Departure previous;  // how z_1 was left
};

// The vertex as the choice of a light sees it; `side`: a direction on its camera side (or, for a
// surface that does not transmit, on its light side).
inline Receiver receiver(const SurfaceInteraction& hit, const BsdfView& bsdf, vec3 side) {
  return {hit.p, dot(side, hit.ng) < 0.0f ? -hit.ng : hit.ng, bsdf.transmits()};
}

// Survival probability of a walk. It divides the throughput and appears in no density.
inline float survival(Rgb throughput, float eta_scale, int bounces) {
  constexpr int kStart = 3;
  if (bounces < kStart) {
    return 1.0f;
  }
  return std::clamp(max_component(throughput) / eta_scale, 0.05f, 1.0f);
}

// State of a walk between two vertices.
struct WalkStep {
  Ray ray;
  BsdfSample sample;
  ClassSums behind;
  Rgb beta;
  float cos_previous;
};

// Scatters at `v` and applies roulette. `start`: throughput 1 of this walk; `eta_scale`: product
// of the refractions so far. nullopt when the walk ends.
inline std::optional<WalkStep> scatter(const PathVertex& v, const Mis& mis, Sampler& sampler,
                                       TransportMode mode, float start, float& eta_scale) {
  const float u_lobe = sampler.next_1d();
  const vec2 u = sampler.next_2d();
  const float u_survive = sampler.next_1d();
  const auto sample = v.bsdf().sample(v.back, u_lobe, u, mode);
  if (!sample) {
    return std::nullopt;
  }
  Rgb beta = v.beta * sample->weight;
  eta_scale *= sample->eta_scale;
  const float q = survival(beta / start, eta_scale, v.edges);
  if (is_black(beta) || !is_finite(beta) || u_survive >= q) {
    return std::nullopt;
  }
  beta /= q;
  const vec3 d = sample->direction;
  return WalkStep{Ray{offset_origin(v.hit.p, v.hit.ng, v.hit.offset, d), d}, *sample,
                  mis.behind(v.mis, sample->delta, sample->pdf_reverse), beta,
                  std::abs(dot(d, v.hit.ng))};
}

// Traces one light subpath and calls on_vertex(const PathVertex&, Sampler&) at z_1, z_2, ...
template <class OnVertex>
void trace_light_subpath(const Scene& scene, const Mis& mis, const WalkSettings& settings,
                         Sampler& sampler, Counters& counters, OnVertex&& on_vertex) {
  ++counters.light_paths;
  sampler.start_block(0);
  float u_light = sampler.next_1d();
  const vec2 u_position = sampler.next_2d(), u_direction = sampler.next_2d();
  const size_t index = scene.light_sampler.sample_emission(u_light);
  const Light& light = *scene.lights[index];
  const auto emission = light.sample_emission(u_position, u_direction);
  if (!emission) {
    return;
  }
  const float pmf = scene.light_sampler.pmf_emission(index);
  const Ray ray{emission->origin, emission->direction};
  ++counters.light_rays;
  auto hit = scene.intersect(ray);
  if (!hit) {
    return;
  }
  const auto endpoint = light.endpoint(*emission, hit->p);
  if (!endpoint || (*endpoint != emission->origin && scene.occluded(*endpoint, emission->origin))) {
    return;
  }

  PathVertex v;
  v.hit = *hit;
  v.beta = emission->weight / pmf;
  v.edges = 1;
  const float cos_1 = std::abs(dot(ray.direction, hit->ng));
  const float joint = pmf * emission_density(emission->density, cos_1, length2(hit->p - *endpoint));
  if (!(joint > 0.0f)) {
    return;
  }
  v.back = -ray.direction;
  v.shading = scene.shade(v.hit);
  const float pdf_nee = scene.light_sampler.pmf_illumination(receiver(v.hit, v.bsdf(), v.back),
                                                             index, emission->primitive) *
                        light.pdf_illumination(*emission, *endpoint, hit->p);
  v.light_end = {joint, pdf_nee, light.hittable(), -ray.direction};
  v.mis = mis.begin_light(joint, pdf_nee, light.hittable());
  const float start = max_component(v.beta);
  float eta_scale = 1.0f;
  for (;;) {
    on_vertex(v, sampler);
    if (v.edges + 2 > settings.max_edges) {
      return;
    }
    sampler.start_block(v.edges);
    const auto step = scatter(v, mis, sampler, TransportMode::Importance, start, eta_scale);
    if (!step) {
      return;
    }
    ++counters.light_rays;
    hit = scene.intersect(step->ray);
    if (!hit) {
      return;
    }
    const float d2 = length2(hit->p - v.hit.p);
    const float pdf_area =
        step->sample.pdf_solid * std::abs(dot(step->ray.direction, hit->ng)) / d2;
    if (!(pdf_area > 0.0f) || !std::isfinite(pdf_area)) {
      return;
    }
    v.mis = mis.advance(step->behind, step->sample.delta, step->cos_previous / d2, pdf_area);
    v.hit = *hit;
    v.back = -step->ray.direction;
    v.shading = scene.shade(v.hit);
    v.beta = step->beta;
    v.previous = {step->sample.delta, step->sample.pdf_solid, step->sample.pdf_reverse};
    ++v.edges;
  }
}

// Traces one camera subpath through `raster`. Calls on_light(const LightFound&) for all light on
// its segments and on_vertex(const PathVertex&, Sampler&) at z_{k-1}, z_{k-2}, ...; returns whether
// the first segment ended on a surface. The sampler's block 0 belongs to the caller (film).
template <class OnLight, class OnVertex>
bool trace_camera_subpath(const Scene& scene, const Camera& camera, vec2 raster, const Mis& mis,
                          const WalkSettings& settings, Sampler& sampler, Counters& counters,
                          OnLight&& on_light, OnVertex&& on_vertex) {
  ++counters.camera_paths;
  const CameraRay start = camera.sample_ray(raster, sampler.next_2d());
  Ray ray = start.ray;
  Receiver previous{start.lens, ray.direction, true};
  Departure left{false, start.density.value, 0.0f};
  float cos_previous = 0.0f, eta_scale = 1.0f;
  bool seen = false;
  ClassSums behind;
  PathVertex v;
  v.beta = Rgb(1.0f);
  for (v.edges = 1;; ++v.edges) {
    ++counters.camera_rays;
    const auto hit = scene.intersect(ray);

    const auto found = [&](size_t index, const LightHit& light_hit) {
      const Light& light = *scene.lights[index];
      if (v.edges == 1) {
        if (light.visible_camera) {
          on_light(LightFound{index, light_hit, v.beta, 1, 1.0f, {}, {}});
        }
        return;
      }
      const float joint = scene.light_sampler.pmf_emission(index) *
                          emission_density(light_hit.emission, cos_previous, light_hit.distance2);
      const float pdf_nee =
          scene.light_sampler.pmf_illumination(previous, index, light_hit.primitive) *
          light_hit.pdf_illumination;
      on_light(LightFound{index,
                          light_hit,
                          v.beta,
                          v.edges,
                          mis.weight_hit(left.pdf_solid, left.delta, pdf_nee, joint, behind),
                          {joint, pdf_nee, true, ray.direction},
                          left});
    };
    const float distance = hit ? glm::length(hit->p - ray.origin) : ray.t_max;
    scene.lamp_index.for_each_on_ray(Ray{ray.origin, ray.direction, distance}, [&](size_t lamp) {
      const Light& light = *scene.lights[lamp];
      const float t_max = light.infinite() && !hit ? kInfinity : distance;
      if (const auto light_hit = light.intersect(Ray{ray.origin, ray.direction, t_max})) {
        found(lamp, *light_hit);
      }
    });
    if (!hit) {
      return seen;
    }
    seen = true;
    v.hit = *hit;
    v.back = -ray.direction;
    v.shading = scene.shade(v.hit);
    if (!is_black(v.shading.emission)) {
      size_t index;
      if (const MeshLight* light = scene.mesh_light(v.hit, index)) {
        found(index, light->at(v.hit, previous.p, ray.direction, v.shading.emission));
      }
    }
    const float d2 = length2(v.hit.p - previous.p);
    const float cos_1 = std::abs(dot(ray.direction, v.hit.ng));
    const float pdf_area =
        v.edges == 1 ? camera_density(start.density, cos_1, d2) : left.pdf_solid * cos_1 / d2;
    if (v.edges + 1 > settings.max_edges || !(pdf_area > 0.0f) || !std::isfinite(pdf_area)) {
      return seen;
    }
    v.mis = v.edges == 1 ? mis.begin_camera(pdf_area)
                         : mis.advance(behind, left.delta, cos_previous / d2, pdf_area);
    v.previous = left;
    sampler.start_block(v.edges);
    on_vertex(v, sampler);

    const auto step = scatter(v, mis, sampler, TransportMode::Radiance, 1.0f, eta_scale);
    if (!step) {
      return seen;
    }
    previous = receiver(v.hit, v.bsdf(), v.back);
    v.beta = step->beta;
    ray = step->ray;
    left = {step->sample.delta, step->sample.pdf_solid, step->sample.pdf_reverse};
    behind = step->behind;
    cos_previous = step->cos_previous;
  }
}

}  // namespace janus
