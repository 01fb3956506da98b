// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/light/program_light.h"

#include <algorithm>

#include "janus/image/latlong.h"
#include "janus/math/warp.h"
#include "janus/sampling/sampler.h"
#include "janus/shading/shading_point.h"

namespace janus {

namespace {

constexpr int kProbes = 4096;

// Of the lamp's own brightness: it is chosen at least as often as if the tree left it this share.
constexpr float kLeast = 0.01f;

class ProgramLight final : public Light {
 public:
  ProgramLight(std::unique_ptr<Light> lamp, const LightDesc& desc, Program program,
               const CameraView& camera)
      : lamp_(std::move(lamp)), desc_(desc), program_(std::move(program)) {
    name = lamp_->name;
    set_rules(desc);
    by_path = program_.by_path;
    object_.to_world = desc.transform;
    object_.to_object = glm::inverse(desc.transform);
    object_.normal_to_world = glm::transpose(mat3(object_.to_object));
    object_.camera = std::make_shared<const CameraView>(camera);
    object_.location = vec3(desc.transform[3]);
    center_ = object_.location;
    sphere_ = !desc.soft_falloff && desc.radius > 0.0f;
    const vec3 plane = cross(vec3(desc.transform[0]), vec3(desc.transform[1]));
    plane_normal_ = length2(plane) > 0.0f ? normalize(plane) : vec3(0.0f, 0.0f, 1.0f);
    const vec2 half = cos_sin(0.5f * std::clamp(desc.spot_size, 0.0f, kPi));
    half_cot_ = 0.5f * half.x / std::max(half.y, 1e-6f);
    const float sine = cos_sin(0.25f * std::clamp(desc.angle, 0.0f, kPi)).y;
    half_inv_sin_ = sine > 0.0f ? 0.5f / sine : 0.0f;
    size_ = vec2(desc.size, desc.shape == AreaShape::Rectangle || desc.shape == AreaShape::Ellipse
                                ? desc.size_y
                                : desc.size);
    // Of a light that falls otherwise than lights do, as seen from around what is in the picture.
    brightness_ = measure(std::max(glm::length(center_ - vec3(camera.to_world[3])), 1e-3f));
  }

  float power() const override { return by_path ? 0.0f : brightness_ * lamp_->power(); }
  bool hittable() const override { return lamp_->hittable(); }
  bool infinite() const override { return lamp_->infinite(); }

  std::vector<Emitter> emitters() const override {
    std::vector<Emitter> emitters = lamp_->emitters();
    for (Emitter& e : emitters) {
      e.strength *= brightness_;
    }
    return emitters;
  }

  std::optional<EmissionSample> sample_emission(vec2 u_position, vec2 u_direction) const override {
    return lamp_->sample_emission(u_position, u_direction);
  }

  std::optional<vec3> endpoint(const EmissionSample& sample, vec3 receiver) const override {
    return lamp_->endpoint(sample, receiver);
  }

  std::optional<IlluminationSample> sample_illumination(vec3 receiver, uint32_t primitive,
                                                        vec2 u) const override {
    auto sample = lamp_->sample_illumination(receiver, primitive, u);
    if (sample && !by_path) {
      sample->radiance *= tint(sample->target, -sample->wi, std::sqrt(sample->distance2));
      if (is_black(sample->radiance)) {
        sample.reset();
      }
    }
    return sample;
  }

  float pdf_illumination(const EmissionSample& sample, vec3 endpoint,
                         vec3 receiver) const override {
    return lamp_->pdf_illumination(sample, endpoint, receiver);
  }

  std::optional<LightHit> intersect(const Ray& ray) const override {
    auto hit = lamp_->intersect(ray);
    if (hit && !by_path) {
      hit->radiance *= tint(ray.origin + hit->t * ray.direction, -ray.direction, hit->t);
      if (is_black(hit->radiance)) {
        hit.reset();
      }
    }
    return hit;
  }

  void shine_on(const PathSoFar& path, uint32_t /*primitive*/,
                IlluminationSample& sample) const override {
    sample.radiance *= tint_by_path(sample.target, -sample.wi, path);
  }
  void shine_on(const PathSoFar& path, const Ray& ray, LightHit& hit) const override {
    hit.radiance *= tint_by_path(ray.origin + hit.t * ray.direction, -ray.direction, path);
  }

  Rgb tint(vec3 endpoint, vec3 direction, float distance) const override {
    return tint_by_path(endpoint, direction,
                        PathSoFar().after(0, infinite() ? kInfinity : distance));
  }

 private:
  // Cycles' coordinates of lamps (intern/cycles/kernel/light): their normal is that of the surface,
  // or looks along the ray where the lamp has none of its own.
  Rgb tint_by_path(vec3 endpoint, vec3 direction, const PathSoFar& path) const {
    ShadingPoint point{};
    // A sun is where its rays point to, as seen from the origin.
    point.p = infinite() ? direction : endpoint;
    point.view = direction;
    point.ng = direction;
    if (desc_.type == LightType::Area) {
      point.ng = dot(plane_normal_, direction) < 0.0f ? -plane_normal_ : plane_normal_;
    } else if (sphere_ && !infinite()) {
      const vec3 n = normalize(endpoint - center_);
      point.ng = dot(n, direction) < 0.0f ? -n : n;
    }
    point.ns = point.ng;
    point.object_normal = mat3(object_.to_object) * point.ng;
    const vec2 uv = coordinates(point);
    point.barycentric = vec2(uv.y, 1.0f - uv.x - uv.y);
    point.object = &object_;
    point.footprint = 1e-2f;
    point.path = path;
    ShadingResult result;
    program_.run(point, result);
    return is_finite(result.emission) ? glm::max(result.emission, Rgb(0.0f)) : Rgb(0.0f);
  }

  // Over the rays of the lamp, as many as carry the same power.
  float measure(float usual_distance) const {
    const float usual = infinite() ? kInfinity : usual_distance;
    double sum = 0.0, whole = 0.0;
    for (int i = 0; i < kProbes; ++i) {
      Sampler sampler(0, Stream::Pilot, 0, static_cast<uint64_t>(i));
      const vec2 u = sampler.next_2d();
      if (const auto s = lamp_->sample_emission(u, sampler.next_2d())) {
        whole += luminance(s->weight);
        sum += luminance(s->weight *
                         tint_by_path(s->origin, s->direction, usual_path(i % kUsualPaths, usual)));
      }
    }
    const double mean = whole > 0.0 ? sum / whole : 0.0;
    return static_cast<float>(std::clamp(mean, double{kLeast}, 1e20));
  }

  vec2 coordinates(const ShadingPoint& point) const {
    switch (desc_.type) {
      case LightType::Area: {
        const vec2 q = vec2(object_.to_object * vec4(point.p, 1.0f));
        return q / size_ + 0.5f;
      }
      case LightType::Spot: {
        const vec3 l = mat3(object_.to_object) * point.view;
        return -half_cot_ * vec2(l) / l.z + 0.5f;
      }
      case LightType::Sun: {  // a disk in equal areas
        const vec3 l = normalize(mat3(object_.to_object) * -point.view);
        return half_inv_sin_ * vec2(l) / glm::length(l + vec3(0.0f, 0.0f, 1.0f)) + 0.5f;
      }
      case LightType::Point:
        break;
    }
    return direction_to_sphere(mat3(object_.to_object) * point.ng);
  }

  std::unique_ptr<Light> lamp_;
  LightDesc desc_;
  Program program_;
  ObjectData object_;
  vec3 center_, plane_normal_;
  bool sphere_;
  float half_cot_;      // of half the spot's angle
  float half_inv_sin_;  // of a quarter of the sun's
  vec2 size_;
  float brightness_;  // beside the plain lamp
};

}  // namespace

std::unique_ptr<Light> make_program_light(std::unique_ptr<Light> lamp, const LightDesc& desc,
                                          Program program, const CameraView& camera) {
  return std::make_unique<ProgramLight>(std::move(lamp), desc, std::move(program), camera);
}

}  // namespace janus
