// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "janus/light/lamps.h"
#include "janus/math/frame.h"
#include "janus/math/warp.h"

namespace janus {

namespace {

// Blender's area light: a rectangle or an ellipse that shines along its local -z.
class AreaLight final : public Light {
 public:
  AreaLight(const LightDesc& desc, Rgb strength) : center_(desc.transform[3]) {
    const bool two_sizes = desc.shape == AreaShape::Rectangle || desc.shape == AreaShape::Ellipse;
    ellipse_ = desc.shape == AreaShape::Disk || desc.shape == AreaShape::Ellipse;
    half_u_ = 0.5f * desc.size * vec3(desc.transform[0]);
    half_v_ = 0.5f * (two_sizes ? desc.size_y : desc.size) * vec3(desc.transform[1]);
    // The plane's own normal: under a sheared transform the local axis is not perpendicular to it.
    const vec3 plane = cross(half_u_, half_v_);
    normal_ = normalize(dot(plane, vec3(desc.transform[2])) < 0.0f ? plane : -plane);
    parallelogram_ = 4.0f * glm::length(plane);
    area_ = ellipse_ ? 0.25f * kPi * parallelogram_ : parallelogram_;
    dual_u_ = cross(half_v_, plane) / length2(plane);
    dual_v_ = cross(plane, half_u_) / length2(plane);
    margin_ = std::max(glm::length(half_u_), glm::length(half_v_));

    half_spread_ = 0.5f * std::clamp(desc.spread, 0.0f, kPi);
    full_spread_ = half_spread_ >= 0.5f * kPi;
    const vec2 spread = cos_sin(half_spread_);
    tan_spread_ = full_spread_ ? kInfinity : spread.y / spread.x;
    sin2_spread_ = full_spread_ ? 1.0f : sqr(spread.y);
    // Cycles' soft box: radiance falls as 1 - tan(theta) / tan(half_spread), normalized so that
    // the power does not change; a series where the difference would cancel.
    spread_scale_ = half_spread_ > 0.05f ? 1.0f / (tan_spread_ - half_spread_)
                                         : 3.0f / (sqr(half_spread_) * half_spread_);
    radiance_ = lamp_power(desc, strength) / (kPi * (desc.normalize ? area_ : 1.0f));
    name = desc.name;
    set_rules(desc);
  }

  float power() const override { return luminance(radiance_) * kPi * area_; }

  bool hittable() const override { return true; }

  std::vector<Emitter> emitters() const override {
    Emitter e;
    e.strength = luminance(radiance_) * attenuation(1.0f) * area_;
    for (const float u : {-1.0f, 1.0f}) {
      for (const float v : {-1.0f, 1.0f}) {
        e.bounds.extend(center_ + u * half_u_ + v * half_v_);
      }
    }
    e.axis = normal_;
    e.theta_o = 0.0f;
    e.theta_e = full_spread_ ? 0.5f * kPi : half_spread_;
    return {e};
  }

  std::optional<EmissionSample> sample_emission(vec2 u_position, vec2 u_direction) const override {
    const vec3 local = square_to_cosine_cone(u_direction, sin2_spread_);
    const vec3 direction = Frame(normal_).to_world(local);
    const Rgb radiance = radiance_ * attenuation(local.z);
    if (is_black(radiance)) {
      return std::nullopt;
    }
    const RayDensity density = ray_density();
    return EmissionSample{point({vec2(-1.0f), vec2(1.0f), area_, true}, u_position), direction,
                          radiance / density.value, density};
  }

  std::optional<IlluminationSample> sample_illumination(vec3 receiver, uint32_t /*primitive*/,
                                                        vec2 u) const override {
    const Region region = this->region(receiver);
    const vec3 target = point(region, u);
    const vec3 d = target - receiver;
    const float d2 = length2(d);
    if (d2 == 0.0f || !(region.area > 0.0f)) {
      return std::nullopt;
    }
    const vec3 wi = d / std::sqrt(d2);
    const float cos_light = -dot(wi, normal_);
    const Rgb radiance =
        cos_light > 0.0f && inside(target) ? radiance_ * attenuation(cos_light) : Rgb(0.0f);
    if (is_black(radiance)) {
      return std::nullopt;
    }
    return IlluminationSample{wi,           target, d2, radiance, d2 / (region.area * cos_light),
                              ray_density()};
  }

  float pdf_illumination(const EmissionSample& /*sample*/, vec3 endpoint,
                         vec3 receiver) const override {
    const vec3 d = receiver - endpoint;
    const float d2 = length2(d);
    const float cos_light = dot(d, normal_) / std::sqrt(d2);
    const float area = region(receiver).area;
    return cos_light > 0.0f && area > 0.0f ? d2 / (area * cos_light) : 0.0f;
  }

  std::optional<LightHit> intersect(const Ray& ray) const override {
    const float cos_light = -dot(ray.direction, normal_);
    if (cos_light <= 0.0f) {
      return std::nullopt;
    }
    const float t = dot(ray.origin - center_, normal_) / cos_light;
    if (!(t > 0.0f && t < ray.t_max) || !inside(ray.origin + t * ray.direction)) {
      return std::nullopt;
    }
    const Rgb radiance = radiance_ * attenuation(cos_light);
    if (is_black(radiance)) {
      return std::nullopt;
    }
    const float area = region(ray.origin).area;
    const float pdf = area > 0.0f ? sqr(t) / (area * cos_light) : 0.0f;
    return LightHit{t, radiance, pdf, ray_density(), sqr(t)};
  }

 private:
  // A part of the light's plane, in coordinates along half_u_ and half_v_.
  struct Region {
    vec2 low, high;
    float area;
    bool whole;  // the light itself
  };

  // What can shine at a receiver: with a narrow spread only the part around the point below it.
  Region region(vec3 receiver) const {
    const Region whole{vec2(-1.0f), vec2(1.0f), area_, true};
    if (full_spread_) {
      return whole;
    }
    const vec3 d = receiver - center_;
    const vec2 below = coordinates(d);  // the normal has none
    // A little wider, so that rounding leaves no light out.
    const float radius = 1.001f * std::max(0.0f, dot(d, normal_)) * tan_spread_ + 1e-4f * margin_;
    const vec2 reach = radius * vec2(glm::length(dual_u_), glm::length(dual_v_));
    const vec2 low = glm::max(below - reach, vec2(-1.0f)), high = glm::min(below + reach, vec2(1));
    const vec2 size = glm::max(high - low, vec2(0.0f));
    const float area = 0.25f * parallelogram_ * size.x * size.y;
    return area < area_ ? Region{low, high, area, false} : whole;
  }

  // Uniform on the surface; directions by the cosine within the spread, so the density per
  // projected area and solid angle is constant.
  RayDensity ray_density() const { return {1.0f / (area_ * kPi * sin2_spread_), false}; }

  // Of a point relative to the centre: [-1, 1] for a rectangle, the unit disk for an ellipse. The
  // axes may be sheared by the object's transform.
  vec2 coordinates(vec3 p) const { return vec2(dot(p, dual_u_), dot(p, dual_v_)); }

  bool inside(vec3 p) const {
    const vec2 q = coordinates(p - center_);
    return ellipse_ ? dot(q, q) <= 1.0f : std::abs(q.x) <= kRim && std::abs(q.y) <= kRim;
  }

  vec3 point(const Region& region, vec2 u) const {
    const vec2 q =
        region.whole && ellipse_ ? square_to_disk(u) : region.low + u * (region.high - region.low);
    return center_ + q.x * half_u_ + q.y * half_v_;
  }

  float attenuation(float cos_light) const {
    if (full_spread_) {
      return 1.0f;
    }
    const float tan_angle = std::sqrt(std::max(0.0f, 1.0f - sqr(cos_light))) / cos_light;
    return std::max(0.0f, (tan_spread_ - tan_angle) * spread_scale_);
  }

  // A sampled point counts as inside whatever rounding does to its coordinates.
  static constexpr float kRim = 1.0f + 1e-6f;

  vec3 center_, half_u_, half_v_, normal_;
  vec3 dual_u_, dual_v_;  // dual basis of half_u_, half_v_ in their plane
  Rgb radiance_;
  float area_, parallelogram_, margin_;
  float half_spread_, tan_spread_, sin2_spread_, spread_scale_;
  bool ellipse_, full_spread_;
};

}  // namespace

std::unique_ptr<Light> make_area_light(const LightDesc& desc, Rgb strength) {
  return std::make_unique<AreaLight>(desc, strength);
}

}  // namespace janus
