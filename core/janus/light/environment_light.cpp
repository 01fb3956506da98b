// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "janus/light/lamps.h"
#include "janus/math/frame.h"
#include "janus/math/warp.h"

namespace janus {

namespace {

// A world of one colour. Directions sampled by the surfaces find it as well as any other strategy
// could, so it is left out of next event estimation.
class ConstantEnvironment final : public Light {
 public:
  ConstantEnvironment(Rgb radiance, vec3 center, float radius)
      : radiance_(radiance), center_(center), radius_(radius) {
    name = "World";
  }

  float power() const override { return luminance(radiance_) * 4.0f * kPi * kPi * sqr(radius_); }

  bool hittable() const override { return true; }
  bool infinite() const override { return true; }
  std::vector<Emitter> emitters() const override { return {Emitter{}}; }

  // A direction, then a point on the disk that covers the scene's bounding sphere.
  std::optional<EmissionSample> sample_emission(vec2 u_position, vec2 u_direction) const override {
    const vec3 direction = square_to_sphere(u_direction);
    const vec2 disk = radius_ * square_to_disk(u_position);
    const Frame frame(direction);
    const vec3 origin = center_ + disk.x * frame.s + disk.y * frame.t - 1.01f * radius_ * direction;
    return EmissionSample{origin, direction, radiance_ / ray_density().value, ray_density()};
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
    return LightHit{kInfinity, radiance_, 0.0f, ray_density(), kInfinity};
  }

 private:
  RayDensity ray_density() const { return {0.25f * kInvPi / (kPi * sqr(radius_)), false}; }

  Rgb radiance_;
  vec3 center_;
  float radius_;
};

}  // namespace

std::unique_ptr<Light> make_environment_light(Rgb radiance, vec3 center, float radius) {
  return std::make_unique<ConstantEnvironment>(radiance, center, std::max(radius, 1e-3f));
}

}  // namespace janus
