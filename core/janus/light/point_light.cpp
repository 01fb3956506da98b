// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "janus/light/lamps.h"
#include "janus/math/frame.h"
#include "janus/math/warp.h"

namespace janus {

namespace {

// Blender's point light: a point, a sphere, or ("Soft Falloff") a disk that turns to each
// receiver. All three emit rays uniformly over the lines that pass within `radius` of the centre.
class PointLight final : public Light {
 public:
  PointLight(const LightDesc& desc, Rgb strength)
      : center_(desc.transform[3]),
        radius_(std::max(0.0f, desc.radius)),
        sphere_(!desc.soft_falloff) {
    // Cycles: radiance P / (pi * 4 pi r^2); a point has intensity P / (4 pi).
    const float area = radius_ > 0.0f ? 4.0f * kPi * sqr(radius_) : 4.0f;
    value_ = lamp_power(desc, strength) / (kPi * (desc.normalize ? area : 1.0f));
    name = desc.name;
    visible_camera = desc.visible_camera;
  }

  float power() const override {
    return luminance(value_) * kPi * (radius_ > 0.0f ? 4.0f * kPi * sqr(radius_) : 4.0f);
  }

  bool hittable() const override { return radius_ > 0.0f; }

  std::optional<EmissionSample> sample_emission(vec2 u_position, vec2 u_direction) const override {
    const vec3 direction = square_to_sphere(u_direction);
    const RayDensity density = ray_density();
    if (radius_ == 0.0f) {
      return EmissionSample{center_, direction, value_ / density.value, density};
    }
    const vec2 disk = radius_ * square_to_disk(u_position);
    const Frame frame(direction);
    vec3 origin = center_ + disk.x * frame.s + disk.y * frame.t;
    if (sphere_) {  // leave from the sphere's near surface, not from inside
      origin += std::sqrt(std::max(0.0f, sqr(radius_) - dot(disk, disk))) * direction;
    }
    return EmissionSample{origin, direction, value_ / density.value, density};
  }

  std::optional<vec3> endpoint(const EmissionSample& sample, vec3 receiver) const override {
    if (radius_ == 0.0f || sphere_) {
      return sample.origin;
    }
    // The disk through the centre, perpendicular to (receiver - centre).
    const vec3 axis = receiver - center_;
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
    if (d2 == 0.0f) {
      return std::nullopt;
    }
    const vec3 to_receiver = axis / std::sqrt(d2);
    if (radius_ == 0.0f) {
      return IlluminationSample{-to_receiver, center_, d2, value_ / d2, 1.0f, ray_density()};
    }
    if (sphere_) {
      return sample_sphere(receiver, to_receiver, d2, u);
    }
    const Frame frame(to_receiver);
    const vec2 disk = radius_ * square_to_disk(u);
    const vec3 target = center_ + disk.x * frame.s + disk.y * frame.t;
    const vec3 wi = normalize(target - receiver);
    return IlluminationSample{wi,
                              target,
                              length2(target - receiver),
                              value_,
                              disk_pdf(to_receiver, wi, length2(target - receiver)),
                              ray_density()};
  }

  float pdf_illumination(const EmissionSample& /*sample*/, vec3 endpoint,
                         vec3 receiver) const override {
    if (radius_ == 0.0f) {
      return 1.0f;
    }
    const vec3 axis = receiver - center_;
    const float d2 = length2(axis);
    if (sphere_) {
      return d2 > sqr(radius_) ? cone_pdf(d2) : 0.0f;
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
    float t, pdf;
    if (sphere_) {
      const float along = -dot(axis, ray.direction);
      const vec3 nearest = axis + along * ray.direction;
      const float h2 = sqr(radius_) - length2(nearest);
      if (d2 <= sqr(radius_) || along <= 0.0f || h2 < 0.0f) {
        return std::nullopt;
      }
      t = along - std::sqrt(h2);
      pdf = cone_pdf(d2);
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
    if (t >= ray.t_max) {
      return std::nullopt;
    }
    return LightHit{t, value_, pdf, ray_density(), sqr(t)};
  }

 private:
  RayDensity ray_density() const {
    if (radius_ == 0.0f) {
      return {0.25f * kInvPi, true};
    }
    return {0.25f * kInvPi / (kPi * sqr(radius_)), false};
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
  float cone_pdf(float d2) const { return 0.5f * kInvPi / one_minus_cos(d2); }

  // From inside the sphere nothing is seen: its surface emits outwards only.
  std::optional<IlluminationSample> sample_sphere(vec3 receiver, vec3 to_receiver, float d2,
                                                  vec2 u) const {
    if (d2 <= sqr(radius_)) {
      return std::nullopt;
    }
    const vec3 wi = Frame(-to_receiver).to_world(square_to_cone(u, one_minus_cos(d2)));
    const float along = std::sqrt(d2) * -dot(wi, to_receiver);
    const vec3 nearest = (receiver - center_) + along * wi;
    const float t = along - std::sqrt(std::max(0.0f, sqr(radius_) - length2(nearest)));
    return IlluminationSample{wi, receiver + t * wi, sqr(t), value_, cone_pdf(d2), ray_density()};
  }

  vec3 center_;
  float radius_;
  bool sphere_;
  Rgb value_;  // radiance, or intensity of a point
};

}  // namespace

std::unique_ptr<Light> make_point_light(const LightDesc& desc, Rgb strength) {
  return std::make_unique<PointLight>(desc, strength);
}

}  // namespace janus
