// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "janus/light/infinite.h"
#include "janus/math/frame.h"
#include "janus/math/warp.h"

namespace janus {

namespace {

// Blender's sun: a disk in the sky of constant radiance, or parallel light.
class SunLight final : public InfiniteLight {
 public:
  SunLight(const LightDesc& desc, Rgb strength, const SceneBox& scene)
      : InfiniteLight(scene),
        axis_(normalize(vec3(desc.transform[2]))),
        half_angle_(0.5f * std::clamp(desc.angle, 0.0f, kPi)),
        one_minus_cos_(2.0f * sqr(cos_sin(0.5f * half_angle_).y)),
        pdf_(parallel() ? 1.0f : 0.5f * kInvPi / one_minus_cos_) {
    // Cycles: the strength is the irradiance of a surface that faces the sun.
    const bool spread = desc.normalize && !parallel();
    value_ = lamp_power(desc, strength) / (spread ? kPi * sqr(cos_sin(half_angle_).y) : 1.0f);
    name = desc.name;
    set_rules(desc);
  }

  float power() const override { return luminance(value_) / pdf_ * scene_.area(axis_); }

  bool hittable() const override { return !parallel(); }

  std::vector<Emitter> emitters() const override {
    Emitter e;
    e.infinite = true;
    e.strength = luminance(value_) / pdf_;
    e.axis = axis_;
    e.theta_o = half_angle_;
    return {e};
  }

  std::optional<EmissionSample> sample_emission(vec2 u_position, vec2 u_direction) const override {
    return emit(-direction(u_direction), u_position, value_, pdf_);
  }

  std::optional<IlluminationSample> sample_illumination(vec3 receiver, uint32_t /*primitive*/,
                                                        vec2 u) const override {
    return illuminate(receiver, direction(u), value_, pdf_);
  }

  float pdf_illumination(const EmissionSample& /*sample*/, vec3 /*endpoint*/,
                         vec3 /*receiver*/) const override {
    return pdf_;
  }

  std::optional<LightHit> intersect(const Ray& ray) const override {
    // 1 - cos = |a - b|^2 / 2 keeps its precision for the real sun's half a degree.
    if (parallel() || ray.t_max < kInfinity ||
        0.5f * length2(ray.direction - axis_) > one_minus_cos_) {
      return std::nullopt;
    }
    return LightHit{kInfinity, value_, pdf_, density(ray.direction, pdf_), kInfinity};
  }

 private:
  bool parallel() const { return half_angle_ == 0.0f; }
  vec3 direction(vec2 u) const {
    return parallel() ? axis_ : Frame(axis_).to_world(square_to_cone(u, one_minus_cos_));
  }

  vec3 axis_;  // to the sun
  float half_angle_, one_minus_cos_;
  float pdf_;  // per solid angle; 1 stands for the delta of parallel light
  Rgb value_;  // radiance, or irradiance of parallel light
};

}  // namespace

std::unique_ptr<Light> make_sun_light(const LightDesc& desc, Rgb strength, const SceneBox& scene) {
  return std::make_unique<SunLight>(desc, strength, scene);
}

}  // namespace janus
