// SPDX-License-Identifier: GPL-3.0-or-later
//
// Unidirectional path tracing with next event estimation. Written without path/ on purpose (only
// roulette is shared): a second opinion on what bdpt computes.
#include "janus/integrator/pass.h"

namespace janus {

namespace {

class PathTracer final : public PassIntegrator {
 public:
  using PassIntegrator::PassIntegrator;

  void render_pass(int pass) override {
    const size_t width = context_.film.rect().width();
    for_each_row([&](size_t row, Counters& counters) {
      for (size_t i = row * width; i < (row + 1) * width; ++i) {
        Sampler sampler = camera_sampler(i, pass);
        sampler.start_block(0);
        const vec2 raster = context_.film.sample_position(i, sampler.next_2d());
        bool seen = false;
        const Rgb value = radiance(raster, sampler, counters, seen);
        const float alpha = seen || !settings_.film_transparent ? 1.0f : 0.0f;
        context_.film.add_sample(i, usable(value, counters) ? value : Rgb(0.0f), alpha);
      }
    });
  }

 private:
  float weight(float own, float other) const {
    if (settings_.heuristic == Heuristic::Power) {
      own *= own;
      other *= other;
    }
    return own / (own + other);
  }

  Rgb radiance(vec2 raster, Sampler& sampler, Counters& counters, bool& seen) const {
    const Scene& scene = context_.scene;
    ++counters.camera_paths;
    Ray ray = context_.camera.sample_ray(raster, sampler.next_2d()).ray;
    Receiver previous{ray.origin, ray.direction, true};
    Rgb beta(1.0f), sum(0.0f);
    float pdf_solid = 0.0f;
    bool delta = true;
    for (int edges = 1;; ++edges) {
      ++counters.camera_rays;
      const auto hit = scene.intersect(ray);

      const auto add_light = [&](size_t index, const LightHit& found) {
        const Light& light = *scene.lights[index];
        if (edges == 1 &&
            (!light.visible_camera || (light.infinite() && settings_.film_transparent))) {
          return;
        }
        const float pdf_nee =
            scene.light_sampler.pmf_illumination(previous, index, found.primitive) *
            found.pdf_illumination;
        sum += beta * found.radiance * (delta ? 1.0f : weight(pdf_solid, pdf_nee));
      };
      const float distance = hit ? glm::length(hit->p - ray.origin) : ray.t_max;
      scene.lamp_index.for_each_on_ray(Ray{ray.origin, ray.direction, distance}, [&](size_t lamp) {
        const Light& light = *scene.lights[lamp];
        const float t_max = light.infinite() && !hit ? kInfinity : distance;
        if (const auto found = light.intersect(Ray{ray.origin, ray.direction, t_max})) {
          add_light(lamp, *found);
        }
      });
      if (!hit) {
        return sum;
      }
      seen = true;
      const ShadingResult shading = scene.shade(*hit);
      if (size_t index; const MeshLight* light = scene.mesh_light(*hit, index)) {
        add_light(index, light->at(*hit, previous.p, ray.direction, shading.emission));
      }
      if (edges + 1 > settings_.walk.max_edges) {
        return sum;
      }

      const BsdfView bsdf = shading.bsdf.view(hit->ng);
      const vec3 wo = -ray.direction;
      sampler.start_block(edges);
      if (bsdf.connectible() && scene.light_sampler.illuminates()) {
        sum += beta * direct(*hit, bsdf, wo, sampler, counters);
      }

      const float u_lobe = sampler.next_1d();
      const vec2 u = sampler.next_2d();
      const float u_survive = sampler.next_1d();
      const auto sample = bsdf.sample(wo, u_lobe, u, TransportMode::Radiance);
      if (!sample) {
        return sum;
      }
      beta *= sample->weight;
      const float q = survival(beta, 1.0f, edges);
      if (is_black(beta) || u_survive >= q) {
        return sum;
      }
      beta /= q;
      pdf_solid = sample->pdf_solid;
      delta = sample->delta;
      previous = receiver(*hit, bsdf, wo);
      ray = Ray{offset_origin(hit->p, hit->ng, hit->offset, sample->direction), sample->direction};
    }
  }

  Rgb direct(const SurfaceInteraction& hit, const BsdfView& bsdf, vec3 wo, Sampler& sampler,
             Counters& counters) const {
    const Scene& scene = context_.scene;
    const float u_light = sampler.next_1d();
    const vec2 u = sampler.next_2d();
    const LightChoice choice =
        scene.light_sampler.sample_illumination(receiver(hit, bsdf, wo), u_light);
    const Light& light = *scene.lights[choice.light];
    const auto sample = light.sample_illumination(hit.p, choice.primitive, u);
    if (!sample) {
      return Rgb(0.0f);
    }
    const Rgb f = bsdf.eval_cos(wo, sample->wi);
    if (is_black(f)) {
      return Rgb(0.0f);
    }
    ++counters.nee_rays;
    if (scene.occluded(offset_origin(hit.p, hit.ng, hit.offset, sample->wi), sample->target)) {
      return Rgb(0.0f);
    }
    const float pdf_nee = choice.pmf * sample->pdf_solid;
    const float pdf_hit =
        light.hittable() ? bsdf.pdf_solid(wo, sample->wi, TransportMode::Radiance) : 0.0f;
    return f * sample->radiance * (weight(pdf_nee, pdf_hit) / pdf_nee);
  }
};

}  // namespace

std::unique_ptr<Integrator> make_path_tracer(const RenderContext& context,
                                             const IntegratorSettings& settings) {
  return std::make_unique<PathTracer>(context, settings);
}

}  // namespace janus
