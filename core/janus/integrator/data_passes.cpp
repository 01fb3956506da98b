// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/integrator/data_passes.h"

#include <functional>

#include "janus/integrator/aovs.h"
#include "janus/integrator/pass.h"
#include "janus/integrator/picture_motion.h"
#include "janus/light/program_sky.h"
#include "janus/math/frame.h"
#include "janus/math/warp.h"
#include "janus/render/time_slice.h"
#include "janus/scene/panorama.h"
#include "janus/shading/features.h"

namespace janus {

float Mist::at(float distance) const {
  const float share = depth > 0.0f ? (distance - start) / depth : (distance < start ? 0.0f : 1.0f);
  return std::pow(std::clamp(share, 0.0f, 1.0f), falloff);
}

namespace {

class DataPasses final : public PassIntegrator {
 public:
  DataPasses(const RenderContext& context, const IntegratorSettings& settings,
             const DataSettings& data, DataFilm& film)
      : PassIntegrator(context, settings),
        data_(data),
        film_(film),
        choice_(film.choice()),
        surfaces_(choice_.surfaces()),
        aovs_(context.scene().aov_names, choice_.aovs) {
    for (const std::string& name : context.scene().surfaces.material_names()) {
      material_ids_.push_back(id_of(name));
    }
    for (const Instance& instance : context.scene().instances) {
      object_ids_.push_back(id_of(instance.names->name));
      asset_ids_.push_back(
          id_of(instance.names->asset.empty() ? instance.names->name : instance.names->asset));
    }
    if (choice_.wants(DataPass::Vector) && moves(*context.exposure.timeless())) {
      motion_.emplace(context.exposure, context.cancel);
    }
  }

  void render_wave(const Wave& wave) override {
    const CameraDesc& camera = context_.scene().camera;
    view_ = view_of(camera);
    surroundings_ = no_object(view_);
    eye_ = vec3(camera.transform[3]);
    forward_ = -vec3(camera.transform[2]);
    const size_t width = context_.film.rect().width();
    for_each_row([&](size_t row, Counters& counters) {
      std::vector<std::optional<DataSample>> samples(width);
      for (size_t x = 0; x < width; ++x) {
        if (wave.includes(x, row) && context_.film.active(row * width + x)) {
          look(row * width + x, wave.pass, samples[x].emplace(), counters);
        }
      }
      film_.add(row * width, samples);
    });
  }

 private:
  static float id_of(const std::string& name) { return cryptomatte_id(cryptomatte_hash(name)); }

  void look(size_t index, int pass, DataSample& sample, Counters& counters) const {
    Sampler sampler = camera_sampler(index, pass);
    sampler.start_block(0);
    const vec2 raster = context_.film.sample_position(index, sampler.next_2d());
    const CameraRay seen = context_.camera().sample_ray(raster, sampler.next_2d());
    if (seen.blind()) {
      see_nothing(sample);
      return;
    }
    const Ray& ray = seen.ray;
    if (surfaces_) {
      look_straight(ray, sampler, sample, counters);
    }
    if (choice_.features()) {
      look_for_features(ray, sampler, sample, counters);
    }
  }

  // Follows the camera's ray through what is transparent.
  void look_straight(Ray ray, Sampler& sampler, DataSample& sample, Counters& counters) const {
    const vec3 origin = ray.origin;
    Rgb through(1.0f);
    AovShare aov_share;
    bool done = false;  // have the passes that are means got their surface?
    for (int crossings = 0; crossings <= settings_.walk.max_crossings; ++crossings) {
      ++counters.camera_rays;
      const auto hit = context_.scene().intersect(ray, RayType::Camera);
      if (!hit) {
        if (!done) {
          see_nothing(sample);
          write_background_aovs(ray.direction, aov_share.value(), sample);
        }
        return;
      }
      const vec3 wo = -ray.direction;
      const PathSoFar path = PathSoFar().after(crossings, glm::length(hit->p - origin));
      const ShadingResult shading = context_.scene().shade(*hit, wo, path);
      if (!done && !choice_.aovs.empty()) {
        const bool emits = context_.scene().surfaces.program(hit->material).emits();
        const float share = aov_share.arrive(crossings, emits);
        context_.scene().surfaces.write_aovs(*hit, wo, path, aovs_.writer(share, sample));
      }
      if (context_.scene().instances[hit->instance].holdout || shading.holdout >= 1.0f) {
        if (!done) {
          see_nothing(sample);
        }
        return;
      }
      const float alpha = 1.0f - average(shading.transparency);
      if (!done) {  // what is looked through leaves no trace here
        see_first(*hit, sample);
      }
      if (!done && alpha >= data_.alpha_threshold) {
        see_surface(*hit, shading, wo, sample);
        done = true;
      }
      const float share = average(through * (Rgb(1.0f) - shading.transparency));
      add(sample, DataPass::Mist, vec3((1.0f - data_.mist.at(distance(hit->p))) * share));
      if (choice_.wants(DataPass::AmbientOcclusion)) {
        sampler.start_block(static_cast<uint32_t>(crossings) + 1);
        ++counters.camera_rays;
        add(sample, DataPass::AmbientOcclusion,
            through * (Rgb(1.0f) - shading.transparency) *
                open_sky(*hit, shading, wo, sampler.next_2d()));
      }
      see_mattes(*hit, average(through) * alpha, sample);
      aov_share.cross(shading);
      through *= shading.transparency;
      if (is_black(through)) {
        return;
      }
      ray = Ray{offset_origin(hit->p, hit->ng, hit->offset, ray.direction), ray.direction,
                ray.t_max - glm::length(hit->p - ray.origin)};
    }
  }

  void write_background_aovs(vec3 direction, float share, DataSample& sample) const {
    const Program* program = context_.scene().world_aovs.get();
    if (program && !choice_.aovs.empty() && !settings_.walk.film_transparent) {
      program->run_aovs(sky_point(direction, surroundings_), aovs_.writer(share, sample));
    }
  }

  void see_first(const SurfaceInteraction& hit, DataSample& sample) const {
    const bool panoramic = is_panorama(context_.scene().camera.type);
    const vec3 p = hit.p;
    sample.set(DataPass::Depth,
               panoramic ? glm::length(p - eye_) : (view_.from_world * vec4(p, 1.0f)).z);
    sample.set(DataPass::Position, p);
    sample.set(DataPass::ObjectIndex, context_.scene().instances[hit.instance].object_index);
    sample.set(DataPass::MaterialIndex, context_.scene().surfaces.material_index(hit.material));
  }

  static void see_nothing(DataSample& sample) {
    for (size_t i = 0; i < kDataPassCount; ++i) {
      if (kDataPasses[i].first) {
        sample.set(static_cast<DataPass>(i), vec3(0.0f));
      }
    }
  }

  void see_surface(const SurfaceInteraction& hit, const ShadingResult& shading, vec3 wo,
                   DataSample& sample) const {
    const BsdfView bsdf = shading.bsdf.view(hit.ng, shading.ns);
    sample.set(DataPass::Normal, average_normal(bsdf, facing(shading.ns, hit, wo), wo));
    const Shape& shape = *context_.scene().shapes[context_.scene().instances[hit.instance].shape];
    if (const AttributeDesc* uv = shape.attribute("uv:"); uv && choice_.wants(DataPass::Uv)) {
      ShadingPoint point{};
      point.barycentric = hit.barycentric;
      point.triangle = shape.indices(hit.primitive);
      point.attributes = &uv;
      const vec4 value = point.attribute(0);
      sample.set(DataPass::Uv, vec3(value.x, value.y, 1.0f));
    }
    if (choice_.wants(DataPass::Vector)) {
      sample.set_seen(DataPass::Vector, motion_ ? motion_->of(hit) : vec4(0.0f));
    }
  }

  // What a ray over the surface, drawn by the cosine, meets of the surroundings: white is nothing.
  Rgb open_sky(const SurfaceInteraction& hit, const ShadingResult& shading, vec3 wo, vec2 u) const {
    const BsdfView bsdf = shading.bsdf.view(hit.ng, shading.ns);
    const Frame frame(diffuse_normal(bsdf, facing(shading.ns, hit, wo), wo));
    const vec3 d = frame.to_world(square_to_cosine_hemisphere(u));
    const Bounds& all = context_.scene().accel->bounds();
    const float beyond = glm::length(hit.p - all.center()) + 2.0f * all.radius();
    const float reach = data_.occlusion_distance > 0.0f ? data_.occlusion_distance : beyond;
    const vec3 origin = offset_origin(hit.p, hit.ng, hit.offset, d);
    return context_.scene().transmittance(origin, origin + std::min(reach, beyond) * d,
                                          RayType::Shadow, settings_.walk.max_crossings);
  }

  void see_mattes(const SurfaceInteraction& hit, float weight, DataSample& sample) const {
    if (weight > 0.0f && std::ranges::any_of(choice_.mattes, std::identity())) {
      sample.mattes.push_back({{object_ids_[hit.instance],
                                material_ids_[context_.scene().surfaces.material(hit.material)],
                                asset_ids_[hit.instance]},
                               weight});
    }
  }

  static vec3 facing(vec3 n, const SurfaceInteraction& hit, vec3 wo) {
    return dot(wo, hit.ng) < 0.0f ? -n : n;
  }

  // As Cycles measures it for mist.
  float distance(vec3 p) const {
    return context_.scene().camera.type == CameraType::Orthographic
               ? std::abs(dot(p - eye_, forward_))
               : glm::length(p - eye_);
  }

  // Follows a path to the first surface that is rough enough for a denoiser, into mirrors and
  // through glass.
  void look_for_features(Ray ray, Sampler& sampler, DataSample& sample, Counters& counters) const {
    Rgb share(1.0f);
    RayType type = RayType::Camera;
    PathSoFar path;
    vec3 origin = ray.origin;
    for (int steps = 1; steps < settings_.walk.max_edges + settings_.walk.max_crossings; ++steps) {
      ++counters.camera_rays;
      const auto hit = context_.scene().intersect(ray, type);
      if (!hit) {
        add(sample, DataPass::DenoisingAlbedo, share * background(ray, type, path));
        return;
      }
      const vec3 wo = -ray.direction;
      path.ray_length = glm::length(hit->p - origin);
      const ShadingResult shading = context_.scene().shade(*hit, wo, path);
      const BsdfView bsdf = shading.bsdf.view(hit->ng, shading.ns);
      const float length = glm::length(hit->p - ray.origin);
      add(sample, DataPass::DenoisingDepth, vec3(average(share) * length));
      add(sample, DataPass::DenoisingAlbedo, share * shading.emission);
      const SurfaceFeatures found =
          surface_features(bsdf, shading.transparency, facing(shading.ns, *hit, wo), wo);
      if (found.rough) {
        add(sample, DataPass::DenoisingAlbedo, share * found.albedo);
        sample.set(DataPass::DenoisingNormal, vec3(view_.from_world * vec4(found.normal, 0.0f)));
        return;
      }
      share *= found.smooth;
      sampler.start_block(static_cast<uint32_t>(steps));
      const float through = average(shading.transparency);
      const float pass = through > 0.0f ? through / (through + shading.bsdf.albedo()) : 0.0f;
      if (sampler.next_1d() < pass) {
        ray = Ray{offset_origin(hit->p, hit->ng, hit->offset, ray.direction), ray.direction};
        ++path.crossings;
        continue;
      }
      const float u_lobe = sampler.next_1d();
      const auto next = bsdf.sample(wo, u_lobe, sampler.next_2d(), TransportMode::Radiance);
      if (!next) {
        return;
      }
      type = next->transmitted ? RayType::Transmission : RayType::Glossy;
      ray = Ray{offset_origin(hit->p, hit->ng, hit->offset, next->direction), next->direction};
      origin = ray.origin;
      ++path.depth;
      path.bounces = path.bounces.with(type);
    }
  }

  // What shines from infinitely far away.
  Rgb background(const Ray& ray, RayType type, const PathSoFar& path) const {
    Rgb sum(0.0f);
    context_.scene().lamp_index.for_each_on_ray(ray, [&](size_t lamp) {
      const Light& light = *context_.scene().lights[lamp];
      if (light.background && contains(light.visibility, type)) {
        const auto hit = light.look_along(Ray{ray.origin, ray.direction, kInfinity}, path);
        sum += hit ? hit->radiance : Rgb(0.0f);
      }
    });
    return sum;
  }

  static void add(DataSample& sample, DataPass pass, vec3 value) {
    float* to = sample.values[static_cast<size_t>(pass)];
    to[0] += value.x, to[1] += value.y, to[2] += value.z;
  }

  DataSettings data_;
  DataFilm& film_;
  DataChoice choice_;
  bool surfaces_;  // does it want something of them?
  AovWriter aovs_;
  CameraView view_{};
  ObjectData surroundings_;  // of the world's point
  vec3 eye_{}, forward_{};
  std::optional<PictureMotion> motion_;
  std::vector<float> material_ids_, object_ids_, asset_ids_;
};

}  // namespace

std::unique_ptr<Integrator> make_data_passes(const RenderContext& context,
                                             const IntegratorSettings& settings,
                                             const DataSettings& data, DataFilm& film) {
  return std::make_unique<DataPasses>(context, settings, data, film);
}

}  // namespace janus
