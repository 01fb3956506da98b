// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "janus/light/lamps.h"
#include "janus/light/spot_beam.h"
#include "janus/math/frame.h"
#include "janus/math/warp.h"

namespace janus {

namespace {

// Blender's point and spot lights: a point, a sphere, or ("Soft Falloff") a disk that turns to each
// receiver. All three emit rays uniformly over the lines that pass within `radius` of the centre; a
// spot's beam depends on their direction alone. A sphere shines inwards, too, without a beam.
class PointLight final : public Light {
 public:
  PointLight(const LightDesc& desc, Rgb strength, bool inside)
      : center_(desc.transform[3]),
        radius_(std::max(0.0f, desc.radius)),
        sphere_(!desc.soft_falloff && radius_ > 0.0f),
        share_outside_(sphere_ && inside ? 0.5f : 1.0f) {
    // Cycles: radiance P / (pi * 4 pi r^2); a point has intensity P / (4 pi).
    const float area = radius_ > 0.0f ? 4.0f * kPi * sqr(radius_) : 4.0f;
    value_ = lamp_power(desc, strength) / (kPi * (desc.normalize ? area : 1.0f));
    if (desc.type == LightType::Spot) {
      beam_.emplace(desc);
    }
    solid_angle_ = beam_ ? beam_->solid_angle() : 4.0f * kPi;
    name = desc.name;
    set_rules(desc);
  }

  float power() const override { return peak_intensity() * solid_angle_; }

  bool hittable() const override { return radius_ > 0.0f; }

  std::vector<Emitter> emitters() const override {
    Emitter e;
    e.strength = peak_intensity();
    e.bounds.extend(center_ - radius_);
    e.bounds.extend(center_ + radius_);
    if (beam_ && share_outside_ == 1.0f) {
      e.axis = beam_->axis();
      e.theta_o = beam_->theta_max();
      e.theta_e = 0.0f;
    }
    return {e};
  }

  std::optional<EmissionSample> sample_emission(vec2 u_position, vec2 u_direction) const override {
    const bool outwards = u_position.x < share_outside_;
    if (!outwards) {
      u_position.x = (u_position.x - share_outside_) / (1.0f - share_outside_);
    } else if (share_outside_ < 1.0f) {
      u_position.x = std::min(u_position.x / share_outside_, 0x1.fffffep-1f);
    }
    const bool beam = beam_ && outwards;
    const vec3 direction = beam ? beam_->sample(u_direction) : square_to_sphere(u_direction);
    const RayDensity density = ray_density(direction, outwards);
    const Rgb value = beam ? value_ * beam_->attenuation(direction) : value_;
    if (!(density.value > 0.0f) || is_black(value)) {
      return std::nullopt;
    }
    vec3 origin = center_;
    if (radius_ > 0.0f) {
      const vec2 disk = radius_ * square_to_disk(u_position);
      const Frame frame(direction);
      origin += disk.x * frame.s + disk.y * frame.t;
      if (sphere_) {  // leave from the sphere's near surface, or from the far one through the
                      // inside
        const float half = std::sqrt(std::max(0.0f, sqr(radius_) - dot(disk, disk)));
        origin += (outwards ? half : -half) * direction;
      }
    }
    return EmissionSample{origin, direction, value / density.value, density};
  }

  std::optional<vec3> endpoint(const EmissionSample& sample, vec3 receiver) const override {
    if (radius_ == 0.0f) {
      return sample.origin;
    }
    const vec3 axis = receiver - center_;
    if (sphere_) {
      const bool outwards = dot(sample.origin - center_, sample.direction) >= 0.0f;
      return outwards || length2(axis) < sqr(radius_) ? std::optional(sample.origin) : std::nullopt;
    }
    // The disk through the centre, perpendicular to (receiver - centre).
    const float slope = dot(sample.direction, axis);
    if (slope <= 0.0f) {
      return std::nullopt;
    }
    const vec3 p = sample.origin - sample.direction * (dot(sample.origin - center_, axis) / slope);
    if (length2(p - center_) > sqr(radius_)) {
      return std::nullopt;
    }
    return p;
  }

  std::optional<IlluminationSample> sample_illumination(vec3 receiver, uint32_t /*primitive*/,
                                                        vec2 u) const override {
    const vec3 axis = receiver - center_;
    const float d2 = length2(axis);
    if (d2 == 0.0f && !sphere_) {
      return std::nullopt;
    }
    vec3 wi, target = center_;
    float distance2 = d2, pdf = 1.0f;
    if (sphere_) {
      wi = sample_sphere(axis, d2, u);
      const float t = sphere_distance(axis, wi);
      target = receiver + t * wi;
      distance2 = sqr(t);
      pdf = sphere_pdf(d2);
    } else {
      const vec3 to_receiver = axis / std::sqrt(d2);
      if (radius_ > 0.0f) {
        const Frame frame(to_receiver);
        const vec2 disk = radius_ * square_to_disk(u);
        target += disk.x * frame.s + disk.y * frame.t;
        distance2 = length2(target - receiver);
      }
      wi = normalize(target - receiver);
      pdf = radius_ > 0.0f ? disk_pdf(to_receiver, wi, distance2) : 1.0f;
    }
    const bool outside = !inside(d2);
    const Rgb value = radiance(wi, outside);
    if (is_black(value)) {
      return std::nullopt;
    }
    return IlluminationSample{
        wi, target, distance2, radius_ > 0.0f ? value : value / d2, pdf, ray_density(-wi, outside)};
  }

  float pdf_illumination(const EmissionSample& /*sample*/, vec3 endpoint,
                         vec3 receiver) const override {
    if (radius_ == 0.0f) {
      return 1.0f;
    }
    const vec3 axis = receiver - center_;
    const float d2 = length2(axis);
    if (sphere_) {
      return sphere_pdf(d2);
    }
    const vec3 to_light = endpoint - receiver;
    return disk_pdf(axis / std::sqrt(d2), normalize(to_light), length2(to_light));
  }

  std::optional<LightHit> intersect(const Ray& ray) const override {
    if (radius_ == 0.0f) {
      return std::nullopt;
    }
    const vec3 axis = ray.origin - center_;
    const float d2 = length2(axis);
    const bool outside = !inside(d2);
    float t, pdf;
    if (sphere_) {
      const float along = -dot(axis, ray.direction);
      const vec3 nearest = axis + along * ray.direction;
      if ((outside && along <= 0.0f) || length2(nearest) > sqr(radius_)) {
        return std::nullopt;
      }
      t = sphere_distance(axis, ray.direction);
      pdf = sphere_pdf(d2);
    } else {
      if (d2 == 0.0f) {
        return std::nullopt;
      }
      const vec3 n = axis / std::sqrt(d2);
      const float slope = -dot(ray.direction, n);
      if (slope <= 0.0f) {
        return std::nullopt;
      }
      t = std::sqrt(d2) / slope;
      if (length2(axis + t * ray.direction) > sqr(radius_)) {
        return std::nullopt;
      }
      pdf = disk_pdf(n, ray.direction, sqr(t));
    }
    const Rgb value = radiance(ray.direction, outside);
    if (!(t > 0.0f && t < ray.t_max) || is_black(value)) {
      return std::nullopt;
    }
    return LightHit{t, value, pdf, ray_density(-ray.direction, outside), sqr(t)};
  }

 private:
  bool inside(float d2) const { return sphere_ && d2 <= sqr(radius_); }

  float peak_intensity() const {
    return luminance(value_) * (radius_ > 0.0f ? kPi * sqr(radius_) : 1.0f);
  }

  // Towards `wi`; the intensity of a point.
  Rgb radiance(vec3 wi, bool outside) const {
    return beam_ && outside ? value_ * beam_->attenuation(-wi) : value_;
  }

  RayDensity ray_density(vec3 direction, bool outwards) const {
    const float pdf = beam_ && outwards ? beam_->pdf_solid(direction) : 0.25f * kInvPi;
    if (radius_ == 0.0f) {
      return {pdf, true};
    }
    const float share = outwards ? share_outside_ : 1.0f - share_outside_;
    return {share * pdf / (kPi * sqr(radius_)), false};
  }

  // Uniform over the disk, as a density per solid angle at the receiver.
  float disk_pdf(vec3 to_receiver, vec3 wi, float distance2) const {
    const float cos_light = -dot(wi, to_receiver);
    return cos_light > 0.0f ? distance2 / (kPi * sqr(radius_) * cos_light) : 0.0f;
  }

  // 1 - cos of the cone under which the sphere is seen, without cancellation for small spheres.
  float one_minus_cos(float d2) const {
    const float sin2 = sqr(radius_) / d2;
    return sin2 / (1.0f + std::sqrt(std::max(0.0f, 1.0f - sin2)));
  }

  // Uniform in the cone of the sphere; inside, over all directions.
  vec3 sample_sphere(vec3 axis, float d2, vec2 u) const {
    if (inside(d2)) {
      return square_to_sphere(u);
    }
    return Frame(-axis / std::sqrt(d2)).to_world(square_to_cone(u, one_minus_cos(d2)));
  }
  float sphere_pdf(float d2) const {
    return inside(d2) ? 0.25f * kInvPi : 0.5f * kInvPi / one_minus_cos(d2);
  }
  // To the near surface, from inside to the far one.
  float sphere_distance(vec3 axis, vec3 wi) const {
    const float along = -dot(axis, wi);
    const float half = std::sqrt(std::max(0.0f, sqr(radius_) - length2(axis + along * wi)));
    return inside(length2(axis)) ? along + half : along - half;
  }

  vec3 center_;
  float radius_;
  bool sphere_;
  float share_outside_;  // of the emitted rays
  Rgb value_;            // radiance, or intensity of a point
  float solid_angle_;    // of the beam
  std::optional<SpotBeam> beam_;
};

}  // namespace

std::unique_ptr<Light> make_point_light(const LightDesc& desc, Rgb strength, bool inside) {
  return std::make_unique<PointLight>(desc, strength, inside);
}

}  // namespace janus
