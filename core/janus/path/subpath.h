// SPDX-License-Identifier: GPL-3.0-or-later
//
// Random walks from the lights and from the camera. They keep what the weights need and hand each
// vertex to a visitor; what is done there (connect, splat, gather) is the integrator's business.
#pragma once

#include "janus/camera/camera.h"
#include "janus/path/flight.h"

namespace janus {

struct WalkSettings : PathRules {
  bool roulette = true;
};

// Light found on the segment after a camera vertex: a path of technique s=0 with `edges` edges.
struct LightFound {
  size_t light;  // index in Scene::lights
  LightHit hit;
  Rgb beta;
  int edges;
  MisWeight weight;    // 1 for edges == 1
  LightEnd end;        // for edges > 1
  Departure previous;  // how z_1 was left
};

// State of a walk between two vertices.
struct WalkStep {
  Ray ray;
  Departure left;
  ClassSums behind;
  Rgb beta;
  float cos_previous;
  RayType label = RayType::Diffuse;  // if the rules count
};

// Scatters at `v`, applies roulette and writes `step`. `start`: throughput 1 of this walk;
// `eta_scale`: product of the refractions so far. False when the walk ends.
inline bool scatter(const PathVertex& v, const Mis& mis, Sampler& sampler, TransportMode mode,
                    const WalkSettings& settings, float start, float& eta_scale, WalkStep& step) {
  const float u_lobe = sampler.next_1d();
  const vec2 u = sampler.next_2d();
  const auto sample = v.bsdf().sample(v.back, u_lobe, u, mode);
  if (!sample) {
    return false;
  }
  Rgb beta = v.beta * sample->weight;
  eta_scale *= sample->eta_scale;
  const float q = settings.roulette ? survival(beta / start, eta_scale, v.edges) : 1.0f;
  if (is_black(beta) || !is_finite(beta) || (q < 1.0f && sampler.next_1d() >= q)) {
    return false;
  }
  const vec3 d = sample->direction;
  step.ray.origin = offset_origin(v.hit.p, v.hit.ng, v.hit.offset, d);
  step.ray.direction = d;
  step.ray.t_max = kInfinity;
  step.left = {sample->delta, sample->pdf_solid, sample->pdf_reverse};
  step.behind = mis.behind(v.mis, sample->delta, sample->pdf_reverse);
  step.beta = beta / q;
  step.cos_previous = std::abs(dot(d, v.hit.ng));
  if (settings.counts()) {
    step.label = LabelShares::sampled(*sample).draw(sampler);
  }
  return true;
}

inline bool usable_density(float pdf) { return pdf > 0.0f && std::isfinite(pdf); }

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
  const auto nothing = [](float, float, bool) {};

  PathVertex v;
  v.beta = emission->weight / pmf;
  v.edges = 1;
  v.crossings = 0;
  const float start = max_component(v.beta);
  const Ray ray{emission->origin, emission->direction};
  if (!fly(scene, ray, settings.max_crossings, sampler, counters.light_rays, v, nothing)) {
    return;
  }
  v.back = -ray.direction;
  const auto endpoint = light.endpoint(*emission, v.hit.p);
  if (!endpoint) {
    return;
  }
  if (*endpoint != emission->origin) {
    v.beta *=
        scene.transmittance(*endpoint, emission->origin, settings.max_crossings - v.crossings);
  }
  const float joint = pmf * emission_density(emission->density, std::abs(dot(v.back, v.hit.ng)),
                                             length2(v.hit.p - *endpoint));
  if (!usable_density(joint) || is_black(v.beta)) {
    return;
  }
  const float pdf_nee = scene.light_sampler.pmf_illumination(receiver(v.hit, v.bsdf(), v.back),
                                                             index, emission->primitive) *
                        light.pdf_illumination(*emission, *endpoint, v.hit.p);
  v.light_end = {joint, pdf_nee, light.hittable(), v.back};
  v.mis = mis.begin_light(joint, pdf_nee, light.hittable());
  float eta_scale = 1.0f;
  WalkStep step;
  for (;;) {
    on_vertex(v, sampler);
    if (v.edges + 2 > settings.max_edges) {
      return;
    }
    sampler.start_block(v.edges);
    if (!scatter(v, mis, sampler, TransportMode::Importance, settings, start, eta_scale, step)) {
      return;
    }
    // z_1 is next to the light, it is no bounce.
    if (settings.counts() && v.edges > 1) {
      v.bounces = v.bounces.with(step.label);
      if (!settings.caps.allow(v.bounces)) {
        return;
      }
    }
    v.beta = step.beta;
    const vec3 previous = v.hit.p;
    if (!fly(scene, step.ray, settings.max_crossings, sampler, counters.light_rays, v, nothing)) {
      return;
    }
    const float d2 = length2(v.hit.p - previous);
    const float pdf_area = step.left.pdf_solid * std::abs(dot(step.ray.direction, v.hit.ng)) / d2;
    if (!usable_density(pdf_area)) {
      return;
    }
    v.mis = mis.advance(step.behind, step.left.delta, step.cos_previous / d2, pdf_area);
    v.back = -step.ray.direction;
    v.previous = step.left;
    ++v.edges;
  }
}

// Traces one camera subpath through `raster`. Calls on_light(const LightFound&) for all light on
// its segments and on_vertex(const PathVertex&, Sampler&) at z_{k-1}, z_{k-2}, ...; returns the
// share of the camera ray that ended on a surface (film alpha). The sampler's block 0 belongs to
// the caller (film) and the lens.
template <class OnLight, class OnVertex>
float trace_camera_subpath(const Scene& scene, const Camera& camera, vec2 raster, const Mis& mis,
                           const WalkSettings& settings, Sampler& sampler, Counters& counters,
                           OnLight&& on_light, OnVertex&& on_vertex) {
  ++counters.camera_paths;
  const CameraRay start = camera.sample_ray(raster, sampler.next_2d());
  PathVertex v;
  v.beta = Rgb(1.0f);
  v.crossings = 0;
  v.camera_end = {start.lens, start.density};
  WalkStep step{start.ray, {false, start.density.value, 0.0f}, {}, v.beta, 0.0f};
  Receiver previous{start.lens, start.ray.direction, true};
  float eta_scale = 1.0f, alpha = 1.0f;
  for (v.edges = 1;; ++v.edges) {
    const Ray& ray = step.ray;
    const auto found = [&](size_t index, const LightHit& hit) {
      if (v.edges == 1) {
        if (scene.lights[index]->visible_camera) {
          on_light(LightFound{index, hit, v.beta, 1, {}, {}, {}});
        }
        return;
      }
      const float joint = scene.light_sampler.pmf_emission(index) *
                          emission_density(hit.emission, step.cos_previous, hit.distance2);
      const float pdf_nee = scene.light_sampler.pmf_illumination(previous, index, hit.primitive) *
                            hit.pdf_illumination;
      on_light(LightFound{
          index,
          hit,
          v.beta,
          v.edges,
          mis.weight_hit(step.left.pdf_solid, step.left.delta, pdf_nee, joint, step.behind),
          {joint, pdf_nee, true, ray.direction},
          step.left});
    };
    const auto on_segment = [&](float t_begin, float t_end, bool surface) {
      const Ray up_to{ray.origin, ray.direction, t_end};
      scene.lamp_index.for_each_on_ray(up_to, [&](size_t lamp) {
        const Light& light = *scene.lights[lamp];
        const float t_max = light.infinite() && !surface ? kInfinity : t_end;
        const auto light_hit = light.intersect(Ray{ray.origin, ray.direction, t_max});
        if (light_hit && light_hit->t > t_begin) {
          found(lamp, *light_hit);
        }
      });
      if (!surface) {
        alpha = v.edges == 1 ? 1.0f - average(v.beta) : alpha;
      } else if (!is_black(v.shading.emission)) {
        size_t index;
        if (const MeshLight* light = scene.mesh_light(v.hit, index)) {
          found(index, light->at(v.hit, previous.p, ray.direction, v.shading.emission));
        }
      }
    };
    if (!fly(scene, ray, settings.max_crossings, sampler, counters.camera_rays, v, on_segment)) {
      return alpha;
    }
    v.back = -ray.direction;
    const float d2 = length2(v.hit.p - previous.p);
    const float cos_1 = std::abs(dot(ray.direction, v.hit.ng));
    const float pdf_area =
        v.edges == 1 ? camera_density(start.density, cos_1, d2) : step.left.pdf_solid * cos_1 / d2;
    // The last bounce is one only if the path goes on from here.
    if (v.edges + 1 > settings.max_edges || !settings.caps.allow(v.bounces) ||
        !usable_density(pdf_area)) {
      return alpha;
    }
    v.mis = v.edges == 1
                ? mis.begin_camera(pdf_area)
                : mis.advance(step.behind, step.left.delta, step.cos_previous / d2, pdf_area);
    v.previous = step.left;
    sampler.start_block(v.edges);
    on_vertex(v, sampler);

    if (!scatter(v, mis, sampler, TransportMode::Radiance, settings, 1.0f, eta_scale, step)) {
      return alpha;
    }
    if (settings.counts()) {
      v.bounces = v.bounces.with(step.label);
    }
    previous = receiver(v.hit, v.bsdf(), v.back);
    v.beta = step.beta;
  }
}

}  // namespace janus
