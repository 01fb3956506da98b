// SPDX-License-Identifier: GPL-3.0-or-later
//
// Unidirectional path tracing with next event estimation. Written without path/ on purpose (only
// roulette is shared): a second opinion on what bdpt computes.
#include "janus/integrator/camera_walk.h"
#include "janus/integrator/pass.h"
#include "janus/render/subsurface_walk.h"

namespace janus {

namespace {

class PathTracer final : public PassIntegrator {
 public:
  using PassIntegrator::PassIntegrator;

  void render_wave(const Wave& wave) override {
    for_each_pixel(wave, [&](size_t i, size_t, Counters& counters) {
      Sampler sampler = camera_sampler(i, wave.pass);
      sampler.start_block(0);
      const vec2 raster = context_.film.sample_position(i, sampler.next_2d());
      ViewCoverage seen;
      const Rgb value = radiance(raster, sampler, counters, seen, context_.film.layers_at(i));
      add_sample(i, usable(value, counters) ? value : Rgb(0.0f), seen);
    });
  }

 private:
  using Walk = CameraWalk;

  float weight(float own, float other) const {
    if (settings_.heuristic == Heuristic::Power) {
      own *= own;
      other *= other;
    }
    return own / (own + other);
  }

  // Light of source `index` found on the way.
  Rgb found(const Walk& walk, size_t index, const LightHit& hit) const {
    const Light& light = *context_.scene().lights[index];
    if ((walk.edges == 1 && !contains(light.visibility, RayType::Camera)) ||
        (walk.clear && left_out(light))) {
      return Rgb(0.0f);
    }
    if (walk.edges > light.max_edges && !walk.delta) {
      return Rgb(0.0f);
    }
    if (walk.edges > 1 && !walk.previous.lit_by(light)) {
      return Rgb(0.0f);
    }
    Rgb lit(1.0f), beta = walk.beta;
    if (walk.shadows) {  // as shadow rays see it
      beta *= walk.shadows->through(light.shadow_ray);
    }
    if (settings_.walk.ray_types && walk.edges > 1) {
      lit = seen(light, walk.diffuse, walk.rest, walk.transmitted);
    }
    const LightSampler& lights = context_.scene().light_sampler;
    const float pdf_nee =
        walk.delta || !settings_.next_event
            ? 0.0f
            : lights.pmf_illumination(walk.previous, index, hit.primitive) * hit.pdf_illumination;
    const float w = pdf_nee > 0.0f ? weight(walk.pdf_solid, pdf_nee) : 1.0f;
    const Rgb value = settings_.clamp(beta * lit * hit.radiance * w, walk.edges);
    if (walk.trace && !walk.caught) {
      walk.trace->found(index, value, walk.edges);
    }
    sort(walk, value);
    return value;
  }

  // Shadow catchers have their light apart.
  void sort(const Walk& walk, Rgb value) const {
    const Layers& layers = settings_.layers;
    if (layers.caught && (walk.caught || layers.matte) && is_finite(value)) {
      walk.layers[layers.catching(walk.caught)] += value;
    }
  }

  // Not in what the camera sees clearly?
  bool left_out(const Light& light) const {
    return light.holdout || (light.background && settings_.walk.film_transparent);
  }

  // How much of a refraction at `bsdf` is clear.
  float clear_part(const BsdfView& bsdf, vec3 wo, vec3 wi) const {
    const bool refracted = dot(wo, bsdf.ng()) * dot(wi, bsdf.ng()) < 0.0f;
    const float most = settings_.walk.clear_glass;
    return refracted && most >= 0.0f ? bsdf.refracted_share(wo, wi, most) : 0.0f;
  }

  // The surface `hit` where it is seen clearly: the hole that it leaves in `beta`, and what it
  // still does. Empty: the path may go on.
  void hold_out(const SurfaceInteraction& hit, const Walk& walk, ShadingResult& shading,
                ViewCoverage& seen) const {
    if (context_.scene().instances[hit.instance].holdout) {
      leave_out(average(walk.beta * (Rgb(1.0f) - shading.transparency)), walk, seen);
      shading.emission = Rgb(0.0f);
      shading.bsdf.clear();
      return;
    }
    leave_out(shading.holdout * average(walk.beta), walk, seen);
    if (shading.holdout >= 1.0f) {
      shading.transparency = Rgb(0.0f);
      shading.bsdf.clear();
      if (walk.edges == 1) {
        shading.emission = Rgb(0.0f);
      }
    }
  }

  static void leave_out(float share, const Walk& walk, ViewCoverage& seen) {
    seen.alpha -= share;
    seen.matte -= walk.caught ? 0.0f : share;
  }

  // A light is looked for with the rules of shadow rays, unless only this walk can find it. Where
  // the walk sees other things than they do, it takes a ray of its own for that.
  bool looks_apart(const Walk& walk) const {
    const bool asked = settings_.walk.by_path;
    return (asked || settings_.walk.ray_types) && walk.edges > 1 && !walk.delta &&
           (asked || context_.scene().has_own_shadows ||
            !context_.scene().accel->alike(walk.type, RayType::Shadow));
  }

  Rgb lights_ahead(Walk walk, Counters& counters) const {
    const Scene& scene = context_.scene();
    const vec3 d = walk.ray.direction;
    Rgb sum(0.0f);
    ShadowsAhead shadows(scene.shadow_types, walk.crossings, settings_.walk.max_crossings);
    walk.shadows = &shadows;
    walk.looks = settings_.walk.by_path;
    const int crossed = walk.crossings;
    for (;;) {
      ++counters.camera_rays;
      SurfaceInteraction hit;
      if (!scene.accel->intersect_any(Ray{walk.origin, d, walk.ray.t_max - walk.t_begin}, hit)) {
        return sum + lamps(walk, std::nullopt);
      }
      const float t_end = glm::length(hit.p - walk.ray.origin);
      sum += lamps(walk, t_end);
      walk.crossings = crossed + shadows.crossings();
      const PathSoFar here = walk.path(t_end);
      const Instance& met = scene.instances[hit.instance];
      for (uint32_t copy = met.first_copy; copy < met.first_copy + met.copies; ++copy) {
        scene.turn_to_copy(hit, copy);
        const ShadingResult shading = scene.shade(hit, -d, here);
        if (size_t index; const MeshLight* light = scene.mesh_light(hit, index)) {
          const LightHit shine = light->at(hit, walk.previous.p, d, shading.emission);
          sum += shine.by_chance() ? Rgb(0.0f) : found(walk, index, shine);
        }
        shadows.meet(scene.instances[copy].visibility, shading.transparency);
      }
      if (shadows.ended()) {
        return sum;
      }
      walk.origin = offset_origin(hit.p, hit.ng, hit.offset, d);
      walk.t_begin = t_end;
    }
  }

  // The lamps on the present segment, which ends at `t_end`, or nowhere.
  Rgb lamps(const Walk& walk, std::optional<float> t_end) const {
    Rgb sum(0.0f);
    const Ray up_to{walk.ray.origin, walk.ray.direction, t_end.value_or(walk.ray.t_max)};
    context_.scene().lamp_index.for_each_on_ray(up_to, [&](size_t lamp) {
      const Light& light = *context_.scene().lights[lamp];
      const float t_max = t_end.value_or(light.infinite() ? kInfinity : walk.ray.t_max);
      const auto hit =
          light.look_along(Ray{walk.ray.origin, walk.ray.direction, t_max}, walk.path());
      if (hit && hit->t > walk.t_begin) {
        sum += found(walk, lamp, *hit);
      }
    });
    return sum;
  }

  Rgb radiance(vec2 raster, Sampler& sampler, Counters& counters, ViewCoverage& coverage,
               std::span<Rgb> layers) const {
    const Scene& scene = context_.scene();
    ++counters.camera_paths;
    const CameraRay seen = context_.camera().sample_ray(raster, sampler.next_2d());
    if (seen.blind()) {
      return Rgb(0.0f);
    }
    const Ray& start = seen.ray;
    Walk walk{start, {start.origin, start.direction, true}, start.origin};
    walk.layers = layers;
    std::optional<CameraTrace> trace;
    if (settings_.walk.expressions) {
      walk.trace = &trace.emplace(scene, settings_.walk, layers);
    }
    Rgb sum(0.0f);
    for (;;) {
      ++counters.camera_rays;
      vec3 wo = -walk.ray.direction;
      const bool apart = looks_apart(walk);
      if (apart && walk.origin == walk.ray.origin) {  // once for the whole ray
        sum += lights_ahead(walk, counters);
      }
      auto hit = scene.intersect(
          Ray{walk.origin, walk.ray.direction, walk.ray.t_max - walk.t_begin}, walk.type);
      if (!hit) {
        if (walk.clear && settings_.walk.film_transparent) {
          leave_out(average(walk.beta), walk, coverage);
        }
        return apart ? sum : sum + lamps(walk, std::nullopt);
      }
      const float t_end = glm::length(hit->p - walk.ray.origin);
      if (!apart) {
        sum += lamps(walk, t_end);
      }
      ShadingResult shading = scene.shade(*hit, wo, walk.path(t_end));
      if (settings_.walk.catchers && walk.edges == 1 && !walk.caught) {
        walk.caught = catch_view(scene, *hit, walk.ray, settings_.walk, walk.beta, coverage);
        if (is_black(walk.beta)) {
          return sum;
        }
      }
      if (settings_.walk.holdouts && walk.clear) {
        hold_out(*hit, walk, shading, coverage);
      }
      size_t index;
      if (const MeshLight* light = scene.mesh_light(*hit, index)) {
        const LightHit shine =
            light->at(*hit, walk.previous.p, walk.ray.direction, shading.emission);
        if (!apart || shine.by_chance()) {
          sum += found(walk, index, shine);
        }
      }

      if (!is_black(shading.transparency)) {
        const float through = average(shading.transparency);
        const float pass = through / (through + shading.bsdf.albedo());
        if (sampler.next_1d() < pass) {
          if (++walk.crossings > settings_.walk.max_crossings) {
            return sum;
          }
          walk.beta *= shading.transparency / pass;
          walk.origin = offset_origin(hit->p, hit->ng, hit->offset, walk.ray.direction);
          walk.t_begin = t_end;
          continue;
        }
        walk.beta /= 1.0f - pass;
      }

      if (walk.edges + 1 > settings_.walk.max_edges || walk.beyond(settings_.walk.caps)) {
        return sum;
      }
      BsdfView bsdf = shading.bsdf.view(hit->ng, shading.ns);
      if (settings_.layers.colors && walk.edges == 1) {
        settings_.layers.add_color(bsdf, wo, walk.beta, layers);
      }
      sampler.start_block(walk.edges);
      auto sample = look_and_scatter(*hit, bsdf, wo, walk, sampler, counters, sum);
      if (sample && sample->below >= 0) {
        if (!come_up(*sample, walk, sampler, counters, *hit, shading, wo)) {
          return sum;
        }
        bsdf = shading.bsdf.view(hit->ng, shading.ns);
        sample = look_and_scatter(*hit, bsdf, wo, walk, sampler, counters, sum);
      }
      if (!sample) {
        return sum;
      }
      Rgb beta = walk.beta * sample->weight;
      const float q = settings_.walk.roulette ? survival(beta, 1.0f, walk.edges) : 1.0f;
      if (is_black(beta) || (q < 1.0f && sampler.next_1d() >= q)) {
        return sum;
      }
      std::array<int, 3> bounces = walk.bounces;
      RayType type = RayType::Diffuse;
      if (settings_.walk.labels()) {
        type = label(sample->weight, sample->diffuse, sample->transmitted, sampler);
        ++bounces[static_cast<int>(type)];
      }
      const Rgb diffuse =
          settings_.walk.ray_types ? share(sample->diffuse, sample->weight) : Rgb(0.0f);
      bool clear = walk.clear && settings_.walk.clear_glass >= 0.0f && sample->transmitted;
      if (clear && !sample->delta) {
        const float part = clear_part(bsdf, wo, sample->direction);
        clear = part > 0.0f && sampler.next_1d() < part;
      }
      const Ray next{offset_origin(hit->p, hit->ng, hit->offset, sample->direction),
                     sample->direction};
      walk = Walk{.ray = next,
                  .previous = scene.receiver(*hit, bsdf.transmits(), wo),
                  .origin = next.origin,
                  .pdf_solid = sample->pdf_solid,
                  .delta = sample->delta,
                  .edges = walk.edges + 1,
                  .crossings = walk.crossings,
                  .beta = beta / q,
                  .bounces = bounces,
                  .type = type,
                  .diffuse = diffuse,
                  .rest = Rgb(1.0f) - diffuse,
                  .transmitted = sample->transmitted,
                  .clear = clear,
                  .trace = walk.trace,
                  .layers = walk.layers,
                  .caught = walk.caught};
      if (walk.trace) {
        walk.trace->read({hit->instance, ScatterShares::sampled(*sample)}, walk.type, walk.edges,
                         sampler);
      }
    }
  }

  // Light that falls on a vertex is added to `sum`; then it scatters.
  std::optional<BsdfSample> look_and_scatter(const SurfaceInteraction& hit, const BsdfView& bsdf,
                                             vec3 wo, const Walk& walk, Sampler& sampler,
                                             Counters& counters, Rgb& sum) const {
    if (settings_.next_event && bsdf.connectible() &&
        context_.scene().light_sampler.illuminates()) {
      sum += direct(hit, bsdf, wo, walk, sampler, counters);
    }
    const float u_lobe = sampler.next_1d();
    const vec2 u = sampler.next_2d();
    return bsdf.sample(wo, u_lobe, u, TransportMode::Radiance);
  }

  // From where the walk goes below the surface to where light falls that comes from there.
  bool come_up(const BsdfSample& sample, Walk& walk, const Sampler& sampler, Counters& counters,
               SurfaceInteraction& hit, ShadingResult& shading, vec3& wo) const {
    const Scene& scene = context_.scene();
    const Lobe lobe = shading.bsdf.lobes()[static_cast<size_t>(sample.below)];
    SubsurfaceWalk below;
    const auto end = below.trace(scene, hit, sample.direction, lobe, settings_.walk.roulette,
                                 subsurface_sampler(sampler, walk.edges), counters.camera_rays);
    if (!end) {
      return false;
    }
    hit = *end;
    walk.beta *= sample.weight * below.weight();
    wo = below.arrival();  // on the upper side
    scene.shade(hit, wo, shading);
    shading.bsdf.set_kind(VertexKind::SubsurfaceExit);
    return true;
  }

  Rgb direct(const SurfaceInteraction& hit, const BsdfView& bsdf, vec3 wo, const Walk& walk,
             Sampler& sampler, Counters& counters) const {
    const Scene& scene = context_.scene();
    const float u_light = sampler.next_1d();
    const vec2 u = sampler.next_2d();
    const Receiver receiver = scene.receiver(hit, bsdf.transmits(), wo);
    const LightChoice choice = scene.light_sampler.sample_illumination(receiver, u_light);
    const Light& light = *scene.lights[choice.light];
    auto sample = light.sample_illumination(hit.p, choice.primitive, u);
    if (!sample || walk.edges + 1 > light.max_edges || !receiver.lit_by(light)) {
      return Rgb(0.0f);
    }
    const BsdfEval e = bsdf.evaluate(wo, sample->wi, TransportMode::Radiance);
    if (is_black(e.f)) {
      return Rgb(0.0f);
    }
    ++counters.nee_samples;
    ++counters.nee_rays;
    const vec3 origin = offset_origin(hit.p, hit.ng, hit.offset, sample->wi);
    const int crossings = settings_.walk.max_crossings - walk.crossings;
    const bool transmitted = dot(wo, hit.ng) * dot(sample->wi, hit.ng) < 0.0f;
    Rgb visible;
    if (settings_.walk.by_path) {
      PathSoFar path = walk.path();
      ++path.depth;
      path.looks = true;
      path.last = label(e.f, e.diffuse, transmitted, sampler);
      const Scene::Passed passed =
          scene.pass(origin, sample->target, light.shadow_ray, crossings, path);
      visible = passed.through;
      if (light.by_path) {
        light.shine_on(path.after(passed.crossings, std::sqrt(sample->distance2)), choice.primitive,
                       *sample);
      }
    } else {
      visible = scene.transmittance(origin, sample->target, light.shadow_ray, crossings);
    }
    if (is_black(visible)) {
      return visible;
    }
    const float pdf_nee = choice.pmf * sample->pdf_solid;
    const float pdf_hit = light.hittable() ? e.pdf_radiance : 0.0f;
    Rgb f = e.f;
    if (settings_.walk.ray_types) {
      f = seen(light, e.diffuse, e.f - e.diffuse, transmitted);
    }
    if (walk.clear && left_out(light)) {
      f *= 1.0f - clear_part(bsdf, wo, sample->wi);
    }
    const Rgb value = settings_.clamp(
        walk.beta * f * visible * sample->radiance * (weight(pdf_nee, pdf_hit) / pdf_nee),
        walk.edges + 1);
    if (walk.trace && !walk.caught) {
      walk.trace->joined(choice.light, value,
                         {hit.instance, ScatterShares::joined(e, transmitted)});
    }
    sort(walk, value);
    return value;
  }
};

}  // namespace

std::unique_ptr<Integrator> make_path_tracer(const RenderContext& context,
                                             const IntegratorSettings& settings) {
  return std::make_unique<PathTracer>(context, settings);
}

}  // namespace janus
