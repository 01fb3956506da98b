// SPDX-License-Identifier: GPL-3.0-or-later
//
// Random walks from the lights and from the camera. They keep what the weights need and hand each
// vertex to a visitor; what is done there (connect, splat, gather) is the integrator's business.
#pragma once

#include "janus/camera/camera.h"
#include "janus/path/flight.h"
#include "janus/path/step.h"

namespace janus {

// Light found on the segment after a camera vertex: a path of technique s=0 with `edges` edges.
struct LightFound {
  size_t light;  // index in Scene::lights
  LightHit hit;
  Rgb beta;
  int edges;
  bool specular;           // over deltas alone, at least one
  MisWeight weight;        // 1 for edges == 1
  LightEnd end;            // for edges > 1
  Departure previous;      // how z_1 was left
  const PathTrace* trace;  // of the camera's side; see PathVertex
  bool caught;             // likewise
};

// For walks of which nobody watches the segments.
struct NoSegments {
  void operator()(const Ray&, float, float, const PathVertex&) const {}
};

// The next segment of a light subpath, of one of the `possible` types, to `v`. Calls
// on_segment(ray, t_begin, t_end, v) for each piece of it that a camera ray could see.
template <class OnSegment = NoSegments>
bool fly_from_light(const Scene& scene, const Ray& ray, RayMask possible,
                    const WalkSettings& settings, Sampler& sampler, uint64_t& rays, PathVertex& v,
                    OnSegment&& on_segment = {}) {
  if (!settings.ray_types) {
    return fly(scene, ray, RayType::Shadow, TransportMode::Importance, settings.max_crossings,
               sampler, rays, v,
               [&](float begin, float end, bool) { on_segment(ray, begin, end, v); });
  }
  if (possible == 0) {
    return false;
  }
  const DrawnTypes drawn = draw_types(*scene.accel, possible, sampler);
  v.segment = drawn.types;
  v.beta /= drawn.pmf;
  std::function<void(float, float)> on_piece;
  if constexpr (!std::is_same_v<std::remove_cvref_t<OnSegment>, NoSegments>) {
    if (contains(drawn.types, RayType::Camera)) {
      on_piece = [&](float begin, float end) { on_segment(ray, begin, end, v); };
    }
  }
  return fly_past(scene, ray, first_type(drawn.types), settings.max_crossings, sampler, rays, v,
                  on_piece);
}

inline bool usable_density(float pdf) { return pdf > 0.0f && std::isfinite(pdf); }

// Traces one light subpath and calls on_vertex(const PathVertex&, Sampler&) at z_1, z_2, ... and
// on_segment(const Ray&, float t_begin, float t_end, const PathVertex&) for pieces of its flights
// behind z_1 which could be the last of a path, to the camera: with the vertex `v` as it was left,
// v.beta being the flux on the piece.
template <class OnVertex, class OnSegment = NoSegments>
void trace_light_subpath(const Scene& scene, const Mis& mis, const WalkSettings& settings,
                         Sampler& sampler, Counters& counters, OnVertex&& on_vertex,
                         OnSegment&& on_segment = {}) {
  constexpr bool kWatched = !std::is_same_v<std::remove_cvref_t<OnSegment>, NoSegments>;
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
  PathVertex v;
  v.beta = emission->weight / pmf;
  v.edges = 1;
  v.crossings = 0;
  const float start = max_component(v.beta);
  v.source = light.visibility;
  v.hidden = hidden_in_clear_view(light, settings);
  std::optional<PathTrace> trace;
  if (settings.expressions) {
    v.trace = &trace.emplace(settings.expressions->from_light(index));
  }
  v.max_edges = std::min(settings.max_edges, light.max_edges);
  // What a mirror shows of the light is no shadow ray.
  constexpr RayMask kDeltas = ray_bit(RayType::Glossy) | ray_bit(RayType::Transmission);
  const RayMask types = ray_bit(light.shadow_ray) | (scene.surfaces.any_delta() ? kDeltas : 0);
  const Ray ray{emission->origin, emission->direction};
  if (!fly_from_light(scene, ray, types, settings, sampler, counters.light_rays, v)) {
    return;
  }
  v.back = -ray.direction;
  const auto endpoint = light.endpoint(*emission, v.hit.p);
  if (!endpoint) {
    return;
  }
  v.beta *= light.tint(*endpoint, emission->direction, glm::length(v.hit.p - *endpoint));
  if (*endpoint != emission->origin) {
    v.beta *= scene.transmittance(*endpoint, emission->origin, first_type(v.segment),
                                  settings.max_crossings - v.crossings, Scene::End::B);
  }
  const float joint = pmf * emission_density(emission->density, std::abs(dot(v.back, v.hit.ng)),
                                             length2(v.hit.p - *endpoint));
  if (!usable_density(joint) || is_black(v.beta)) {
    return;
  }
  const Receiver receiver = scene.receiver(v.hit, v.bsdf().transmits(), v.back);
  if (!receiver.lit_by(light) || v.shading.bsdf.one_way()) {
    return;
  }
  const float pdf_nee = scene.light_sampler.pmf_illumination(receiver, index, emission->primitive) *
                        light.pdf_illumination(*emission, *endpoint, v.hit.p);
  v.light_end = {joint, pdf_nee, light.hittable(), v.back};
  v.pixel = light.pixel(v.hit.p);
  v.mis = mis.begin_light(joint, pdf_nee, light.hittable());
  float eta_scale = 1.0f;
  WalkStep step;
  for (;;) {
    const auto visit = [&] {
      v.held = settings.holdouts && holds_out(scene, v);
      v.caught = settings.catchers && catches(scene, v.hit);
      on_vertex(v, sampler);
    };
    visit();
    if (v.edges + (kWatched ? 1 : 2) > (v.edges == 1 ? settings.max_edges : v.max_edges)) {
      return;
    }
    sampler.start_block(v.edges);
    Turn turn = scatter(scene, v, mis, sampler, TransportMode::Importance, settings, start,
                        eta_scale, counters.light_rays, step);
    if (turn == Turn::ComesUp) {
      visit();
      turn = scatter(scene, v, mis, sampler, TransportMode::Importance, settings, start, eta_scale,
                     counters.light_rays, step);
    }
    if (turn == Turn::Ends) {
      return;
    }
    if (v.edges == 1 && step.left.delta) {
      v.max_edges = settings.max_edges;
    }
    v.hidden = v.held || step.clear;
    // z_1 is next to the light, it is no bounce.
    if (settings.counts() && v.edges > 1) {
      v.bounces = v.bounces.with(step.label);
      if (!settings.caps.allow(v.bounces)) {
        return;
      }
    }
    v.beta = step.beta;
    const vec3 previous = v.hit.p;
    const auto watch = [&](const Ray& ray, float begin, float end, const PathVertex& on_way) {
      if (!v.hidden && v.edges + 1 <= v.max_edges) {
        on_segment(ray, begin, end, on_way);
      }
    };
    bool arrived;
    if constexpr (kWatched) {
      arrived = fly_from_light(scene, step.ray, v.visibility & (kLabels | ray_bit(RayType::Camera)),
                               settings, sampler, counters.light_rays, v, watch);
    } else {
      arrived = fly_from_light(scene, step.ray, v.visibility & kLabels, settings, sampler,
                               counters.light_rays, v);
    }
    if (!arrived) {
      return;
    }
    const float d2 = length2(v.hit.p - previous);
    const float pdf_area = step.left.pdf_solid * std::abs(dot(step.ray.direction, v.hit.ng)) / d2;
    if (!usable_density(pdf_area) || v.shading.bsdf.one_way()) {
      return;
    }
    v.mis = mis.advance(step.behind, step.left.delta, step.cos_previous / d2, pdf_area);
    v.back = -step.ray.direction;
    v.previous = step.left;
    ++v.edges;
  }
}

// Traces one camera subpath through `raster`. Calls on_light(const LightFound&) for all light on
// its segments and on_vertex(const PathVertex&, Sampler&) at z_{k-1}, z_{k-2}, ...; returns what
// of the camera's ray did not end in a hole, or on a transparent film's background. The sampler's
// block 0 belongs to the caller (film) and the lens.
template <class OnLight, class OnVertex>
ViewCoverage trace_camera_subpath(const Scene& scene, const Camera& camera, vec2 raster,
                                  const Mis& mis, const WalkSettings& settings, Sampler& sampler,
                                  Counters& counters, OnLight&& on_light, OnVertex&& on_vertex) {
  ++counters.camera_paths;
  const CameraRay start = camera.sample_ray(raster, sampler.next_2d());
  ViewCoverage coverage;
  if (start.blind()) {
    return coverage;
  }
  PathVertex v;
  v.beta = Rgb(1.0f);
  v.crossings = 0;
  v.camera_end = {start.lens, start.density};
  std::optional<PathTrace> trace;
  if (settings.expressions) {
    v.trace = &trace.emplace(settings.expressions->from_camera());
  }
  WalkStep step{start.ray, {false, start.density.value, 0.0f}, {}, v.beta, 0.0f};
  Receiver previous{start.lens, start.ray.direction, true};
  float eta_scale = 1.0f;
  bool ended = false;  // at something that holds out
  bool specular = true;
  for (v.edges = 1;; ++v.edges) {
    const Ray& ray = step.ray;
    const RayType type = v.edges == 1 ? RayType::Camera : step.label;
    // Is the light ahead seen otherwise than the next vertex?
    const bool shadow_ray =
        (settings.ray_types || settings.by_path) && v.edges > 1 && !step.left.delta &&
        (settings.by_path || scene.has_own_shadows || !scene.accel->alike(type, RayType::Shadow));
    const auto found = [&](size_t index, const LightHit& hit, Rgb beta, bool by_path) {
      const Light& light = *scene.lights[index];
      if (v.clear && hidden_in_clear_view(light, settings)) {
        return;
      }
      if (v.edges == 1) {
        if (contains(light.visibility, RayType::Camera)) {
          on_light(LightFound{index, hit, beta, 1, false, {}, {}, {}, v.trace, v.caught});
        }
        return;
      }
      if ((v.edges > light.max_edges && !step.left.delta) || !previous.lit_by(light)) {
        return;
      }
      if (settings.ray_types) {
        beta *= step.lit_share(light.visibility);
      }
      const float joint =
          by_path ? 0.0f  // no light walk comes over this segment
                  : scene.light_sampler.pmf_emission(index) *
                        emission_density(hit.emission, step.cos_previous, hit.distance2);
      const float pdf_nee = scene.light_sampler.pmf_illumination(previous, index, hit.primitive) *
                            hit.pdf_illumination;
      on_light(LightFound{
          index,
          hit,
          beta,
          v.edges,
          specular,
          mis.weight_hit(step.left.pdf_solid, step.left.delta, pdf_nee, joint, step.behind),
          {joint, pdf_nee, true, ray.direction},
          step.left,
          v.trace,
          v.caught});
    };
    const auto on_segment = [&](float t_begin, float t_end, bool surface) {
      if (!shadow_ray) {
        lamps_between(
            scene, ray, t_begin, t_end, surface, settings.by_path ? v.path(0.0f) : PathSoFar(),
            [&](size_t lamp, const LightHit& hit) { found(lamp, hit, v.beta, v.by_path); });
      }
      if (settings.catchers && surface && v.edges == 1 && !v.caught) {
        v.caught = catch_view(scene, v.hit, ray, settings, v.beta, coverage);
      }
      if (v.clear && (surface ? settings.holdouts : settings.film_transparent)) {
        const float missing =
            surface ? hole(scene, v.hit, v.beta, ended, v.shading) : average(v.beta);
        coverage.alpha -= missing;
        coverage.matte -= v.caught ? 0.0f : missing;
      }
      // What it emits all the same is in the paths through clear glass, in every technique.
      if (surface && !(ended && v.edges == 1) && !is_black(v.shading.emission)) {
        size_t index;
        if (const MeshLight* light = scene.mesh_light(v.hit, index)) {
          const LightHit hit = light->at(v.hit, previous.p, ray.direction, v.shading.emission);
          if (!shadow_ray || hit.by_chance()) {
            found(index, hit, v.beta, v.by_path);
          }
        }
      }
    };
    if (shadow_ray) {
      look_for_lights(scene, previous.p, ray,
                      settings.by_path ? v.path(0.0f).looking(type) : v.path(0.0f),
                      settings.max_crossings, counters.camera_rays,
                      [&](size_t index, const LightHit& hit, LightThrough through) {
                        found(index, hit, v.beta * through.share, through.by_path);
                      });
    }
    if (!fly(scene, ray, type, TransportMode::Radiance, settings.max_crossings, sampler,
             counters.camera_rays, v, on_segment)) {
      return coverage;
    }
    if (ended || (settings.catchers && is_black(v.beta))) {
      return coverage;
    }
    v.back = -ray.direction;
    const float d2 = length2(v.hit.p - previous.p);
    const float cos_1 = std::abs(dot(ray.direction, v.hit.ng));
    const float pdf_area =
        v.edges == 1 ? camera_density(start.density, cos_1, d2) : step.left.pdf_solid * cos_1 / d2;
    // The last bounce is one only if the path goes on from here.
    if (v.edges + 1 > settings.max_edges || !settings.caps.allow(v.bounces) ||
        !usable_density(pdf_area)) {
      return coverage;
    }
    v.mis = v.edges == 1
                ? mis.begin_camera(pdf_area)
                : mis.advance(step.behind, step.left.delta, step.cos_previous / d2, pdf_area);
    if (v.shading.bsdf.one_way()) {
      v.mis.a = {};  // no walk from a light ends here
    }
    if (v.by_path) {
      v.mis.b = {};  // or goes from here to the vertex before
    }
    v.previous = step.left;
    sampler.start_block(v.edges);
    on_vertex(v, sampler);

    Turn turn = scatter(scene, v, mis, sampler, TransportMode::Radiance, settings, 1.0f, eta_scale,
                        counters.camera_rays, step);
    if (turn == Turn::ComesUp) {
      on_vertex(v, sampler);
      turn = scatter(scene, v, mis, sampler, TransportMode::Radiance, settings, 1.0f, eta_scale,
                     counters.camera_rays, step);
    }
    if (turn == Turn::Ends) {
      return coverage;
    }
    specular = specular && step.left.delta;
    if (settings.specular && !specular) {
      return coverage;
    }
    if (settings.counts() || settings.by_path) {
      v.bounces = v.bounces.with(step.label);
    }
    previous = scene.receiver(v.hit, v.bsdf().transmits(), v.back);
    v.beta = step.beta;
    v.clear = step.clear;
  }
}

}  // namespace janus
