// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "janus/light/infinite.h"
#include "janus/light/lamps.h"
#include "janus/math/warp.h"

namespace janus {

namespace {

// A world of one colour. Directions sampled by the surfaces find it as well as any other strategy
// could, so it is left out of next event estimation.
class ConstantEnvironment final : public InfiniteLight {
 public:
  ConstantEnvironment(Rgb radiance, const SceneBox& scene)
      : InfiniteLight(scene), radiance_(radiance) {
    name = "World";
  }

  float power() const override { return luminance(radiance_) * 4.0f * kPi * scene_.mean_area(); }

  bool hittable() const override { return true; }
  std::vector<Emitter> emitters() const override {
    Emitter e;
    e.infinite = true;
    return {e};
  }

  std::optional<EmissionSample> sample_emission(vec2 u_position, vec2 u_direction) const override {
    return emit(square_to_sphere(u_direction), u_position, radiance_, 0.25f * kInvPi);
  }

  std::optional<IlluminationSample> sample_illumination(vec3 /*receiver*/, uint32_t /*primitive*/,
                                                        vec2 /*u*/) const override {
    return std::nullopt;
  }

  float pdf_illumination(const EmissionSample& /*sample*/, vec3 /*endpoint*/,
                         vec3 /*receiver*/) const override {
    return 0.0f;
  }

  std::optional<LightHit> intersect(const Ray& ray) const override {
    if (ray.t_max < kInfinity) {
      return std::nullopt;
    }
    return LightHit{kInfinity, radiance_, 0.0f, density(ray.direction, 0.25f * kInvPi), kInfinity};
  }

 private:
  Rgb radiance_;
};

// A world that varies: EnvironmentMap, ProgramSky, or a part of one: SkySun. Emission and
// illumination draw from the same directions.
template <class Sky>
class VaryingEnvironment final : public InfiniteLight {
 public:
  VaryingEnvironment(Sky sky, const SceneBox& scene) : InfiniteLight(scene), sky_(std::move(sky)) {
    name = "World";
    if constexpr (kProgram) {
      by_path = sky_.by_path();
    }
  }

  float power() const override {
    if (by_path) {
      return 0.0f;
    }
    if constexpr (kSun) {
      return sky_.total() * scene_.area(sky_.cone().direction);
    } else {
      return sky_.total() * scene_.mean_area();
    }
  }

  bool hittable() const override { return true; }

  std::vector<Emitter> emitters() const override {
    Emitter e;
    e.infinite = true;
    if constexpr (kSun) {
      e.strength = sky_.total();
      e.axis = sky_.cone().direction;
      e.theta_o = sky_.cone().half_angle;
    } else {
      e.strength = 0.5f * sky_.total();  // a surface sees half of the directions
    }
    return {e};
  }

  std::optional<EmissionSample> sample_emission(vec2 u_position, vec2 u_direction) const override {
    const vec3 to_light = sky_.sample(u_direction);
    const float pdf = sky_.pdf_solid(to_light);
    const Rgb radiance = sky_.radiance(to_light);
    if (!(pdf > 0.0f) || is_black(radiance)) {
      return std::nullopt;
    }
    return emit(-to_light, u_position, radiance, pdf);
  }

  std::optional<IlluminationSample> sample_illumination(vec3 receiver, uint32_t /*primitive*/,
                                                        vec2 u) const override {
    const vec3 wi = sky_.sample(u);
    const float pdf = sky_.pdf_solid(wi);
    const Rgb radiance = known_radiance(wi);
    if (!(pdf > 0.0f) || is_black(radiance)) {
      return std::nullopt;
    }
    return illuminate(receiver, wi, radiance, pdf);
  }

  float pdf_illumination(const EmissionSample& sample, vec3 /*endpoint*/,
                         vec3 /*receiver*/) const override {
    return sky_.pdf_solid(-sample.direction);
  }

  std::optional<LightHit> intersect(const Ray& ray) const override {
    if (ray.t_max < kInfinity) {
      return std::nullopt;
    }
    const Rgb radiance = known_radiance(ray.direction);
    if (is_black(radiance)) {
      return std::nullopt;
    }
    const float pdf = sky_.pdf_solid(ray.direction);
    return LightHit{kInfinity, radiance, pdf, density(ray.direction, pdf), kInfinity};
  }

  void shine_on(const PathSoFar& path, uint32_t /*primitive*/,
                IlluminationSample& sample) const override {
    if constexpr (kProgram) {
      sample.radiance = sky_.radiance(sample.wi, path);
    }
  }
  void shine_on(const PathSoFar& path, const Ray& ray, LightHit& hit) const override {
    if constexpr (kProgram) {
      hit.radiance = sky_.radiance(ray.direction, path);
    }
  }

 private:
  // Something above 0 where the path has to be known.
  Rgb known_radiance(vec3 to_light) const { return by_path ? Rgb(1.0f) : sky_.radiance(to_light); }

  static constexpr bool kSun = std::is_same_v<Sky, SkySun>;
  static constexpr bool kProgram = kSun || std::is_same_v<Sky, ProgramSky>;
  Sky sky_;
};

}  // namespace

std::unique_ptr<Light> make_environment_light(Rgb radiance, const SceneBox& scene) {
  return std::make_unique<ConstantEnvironment>(radiance, scene);
}

std::unique_ptr<Light> make_environment_light(EnvironmentMap map, const SceneBox& scene) {
  return std::make_unique<VaryingEnvironment<EnvironmentMap>>(std::move(map), scene);
}

std::unique_ptr<Light> make_environment_light(ProgramSky sky, const SceneBox& scene) {
  return std::make_unique<VaryingEnvironment<ProgramSky>>(std::move(sky), scene);
}

std::unique_ptr<Light> make_environment_light(SkySun sun, const SceneBox& scene) {
  return std::make_unique<VaryingEnvironment<SkySun>>(std::move(sun), scene);
}

}  // namespace janus
