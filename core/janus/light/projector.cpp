// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/light/projector.h"

#include <algorithm>

#include "janus/math/warp.h"
#include "janus/util/error.h"

namespace janus {

namespace {

// Of area lights, radians: the narrowest that lamps have, which counts as straight ahead.
constexpr float kSpread = 0.1f * kPi / 180.0f;
// Of spots, radians. Wider films would be all edge.
constexpr float kWidest = 160.0f * kPi / 180.0f;

class ProjectorLight final : public Light {
 public:
  explicit ProjectorLight(const ProjectorDesc& desc)
      : desc_(desc),
        size_(desc.high - desc.low),
        pixels_(desc.width, desc.height),
        watts_(static_cast<float>(desc.width) * static_cast<float>(desc.height)),
        axis_(-desc.rotation[2]) {
    name = desc.lamp.name;
    set_rules(desc.lamp);
  }

  float power() const override { return watts_; }
  bool hittable() const override { return false; }

  std::vector<Emitter> emitters() const override {
    constexpr float kMargin = 0.01f;  // above rounding
    const vec2 corner = glm::max(glm::abs(desc_.low), glm::abs(desc_.high));
    Emitter e;
    e.axis = axis_;
    e.theta_e = 0.0f;
    if (desc_.parallel) {
      for (const vec2 q : {desc_.low, desc_.high, vec2(desc_.low.x, desc_.high.y),
                           vec2(desc_.high.x, desc_.low.y)}) {
        e.bounds.extend(on_film(q));
      }
      e.theta_o = kMargin;
      e.strength = watts_;
    } else {
      e.bounds.extend(desc_.center);
      e.theta_o = std::atan(glm::length(corner)) + kMargin;
      e.strength = watts_ * pdf_solid(direction(corner));
    }
    return {e};
  }

  std::optional<EmissionSample> sample_emission(vec2 u_position, vec2 u_direction) const override {
    const vec2 q = desc_.low + size_ * (desc_.parallel ? u_position : u_direction);
    const vec3 d = direction(q);
    return EmissionSample{desc_.parallel ? on_film(q) : desc_.center, d, Rgb(watts_), density(d)};
  }

  std::optional<IlluminationSample> sample_illumination(vec3 receiver, uint32_t /*primitive*/,
                                                        vec2 /*u*/) const override {
    const auto q = film_position(receiver);
    if (!q || q->x < desc_.low.x || q->y < desc_.low.y || q->x > desc_.high.x ||
        q->y > desc_.high.y) {
      return std::nullopt;
    }
    const vec3 from = desc_.parallel ? on_film(*q) : desc_.center;
    const vec3 to_light = from - receiver;
    const float d2 = length2(to_light);
    const vec3 wi = desc_.parallel ? -axis_ : to_light / std::sqrt(d2);
    const RayDensity ray = density(-wi);
    // Watts times the density of their rays: irradiance, or the intensity of a point.
    const float value = watts_ * ray.value / (desc_.parallel ? 1.0f : d2);
    return IlluminationSample{wi, from, d2, Rgb(value), 1.0f, ray};
  }

  float pdf_illumination(const EmissionSample& /*sample*/, vec3 /*endpoint*/,
                         vec3 /*receiver*/) const override {
    return 1.0f;
  }

  std::optional<LightHit> intersect(const Ray& /*ray*/) const override { return std::nullopt; }

  uint32_t pixel(vec3 z_1) const override {
    const vec2 q = film_position(z_1).value_or(desc_.low);
    const vec2 raster = glm::clamp((q - desc_.low) / size_ * pixels_, vec2(0.0f), pixels_ - 1.0f);
    return static_cast<uint32_t>(raster.y) * desc_.width + static_cast<uint32_t>(raster.x);
  }

 private:
  vec3 on_film(vec2 q) const { return desc_.center + desc_.rotation * vec3(q, 0.0f); }

  vec3 direction(vec2 q) const {
    return desc_.parallel ? axis_ : desc_.rotation * normalize(vec3(q, -1.0f));
  }

  // Where light leaves the film to get to `p`; nullopt behind it.
  std::optional<vec2> film_position(vec3 p) const {
    const vec3 local = glm::transpose(desc_.rotation) * (p - desc_.center);
    if (!(local.z < 0.0f)) {
      return std::nullopt;
    }
    return desc_.parallel ? vec2(local) : vec2(local) / -local.z;
  }

  // The film is even: from the pinhole, its solid angles shrink by cos^3.
  float pdf_solid(vec3 d) const {
    const float cosine = dot(d, axis_);
    return 1.0f / (size_.x * size_.y * cosine * cosine * cosine);
  }
  // Parallel light: per area, without the delta of its direction.
  RayDensity density(vec3 d) const {
    return desc_.parallel ? RayDensity{1.0f / (size_.x * size_.y), false}
                          : RayDensity{pdf_solid(d), true};
  }

  ProjectorDesc desc_;
  vec2 size_, pixels_;
  float watts_;  // of all pixels
  vec3 axis_;
};

// Watts that leave the film's place `q`, per area of the film, as they are seen from a distance.
Rgb film_flux(const ProjectorDesc& desc, const Light& light, vec2 q, float distance = 1.0f) {
  if (desc.parallel) {
    const vec3 p = desc.center + desc.rotation * vec3(q, -distance);
    const auto hit = light.intersect(Ray{p, desc.rotation[2]});
    if (!hit) {
      return Rgb(0.0f);
    }
    // The lamp's light is spread over a narrow cone, most of it straight ahead (AreaLight): its
    // exitance is pi times the mean radiance, of which `peak` times as much leaves along the axis.
    constexpr float half = 0.5f * kSpread;
    const float peak = 3.0f * std::tan(half) / (half * half * half);
    return hit->radiance * (kPi / peak);
  }
  const vec3 local(q, -1.0f);
  const float cosine = 1.0f / glm::length(local);
  const vec3 receiver = desc.center + desc.rotation * (distance * cosine * local);
  const auto sample = light.sample_illumination(receiver, 0, vec2(0.5f));
  return sample ? sample->radiance * (sqr(distance) * cosine * cosine * cosine) : Rgb(0.0f);
}

}  // namespace

ProjectorDesc projector_of(const LightDesc& lamp, int width, int height) {
  const auto refuse = [&](const char* setting, const std::string& message) -> void {
    throw SceneError(lamp.name, setting, message);
  };
  ProjectorDesc desc;
  desc.lamp = lamp;
  desc.width = width;
  desc.height = height;
  desc.parallel = lamp.type == LightType::Area;
  if (lamp.type != LightType::Spot && lamp.type != LightType::Area) {
    refuse("type", "a spot or an area light can be a projector, other lights have no picture");
  }
  const mat3 axes(lamp.transform);
  const vec3 scale(glm::length(axes[0]), glm::length(axes[1]), glm::length(axes[2]));
  if (!is_finite(lamp.transform) || !(scale.x > 0.0f && scale.y > 0.0f && scale.z > 0.0f)) {
    refuse("transform", "a projector must not be scaled to nothing");
  }
  desc.center = vec3(lamp.transform[3]);
  desc.rotation = mat3(axes[0] / scale.x, axes[1] / scale.y, axes[2] / scale.z);
  const mat3& r = desc.rotation;
  if (max_abs_component(vec3(dot(r[0], r[1]), dot(r[1], r[2]), dot(r[2], r[0]))) > 1e-3f) {
    refuse("transform", "a sheared lamp cannot be a projector");
  }
  vec2 half;
  if (desc.parallel) {
    const bool two_sizes = lamp.shape == AreaShape::Rectangle || lamp.shape == AreaShape::Ellipse;
    half = 0.5f * vec2(lamp.size * scale.x, (two_sizes ? lamp.size_y : lamp.size) * scale.y);
    if (!(half.x > 0.0f && half.y > 0.0f)) {
      refuse("size", "an area light without an area cannot be a projector");
    }
    if (!(lamp.spread <= 1.001f * kSpread)) {
      refuse("spread", "an area light projects a picture only with a spread of 0");
    }
    desc.lamp.spread = kSpread;
  } else {
    if (lamp.radius > 0.0f) {
      refuse("radius", "a spot light projects a sharp picture only with a radius of 0");
    }
    if (!(lamp.spot_size > 0.0f && lamp.spot_size <= kWidest)) {
      refuse("spot_size", "a projector's spot size must be above 0 and at most 160 degrees");
    }
    const vec2 angle = cos_sin(0.5f * lamp.spot_size);
    half = angle.y / angle.x * vec2(scale) / scale.z;
  }
  desc.low = -half;
  desc.high = half;
  return desc;
}

std::unique_ptr<Light> make_projector(const ProjectorDesc& desc) {
  return std::make_unique<ProjectorLight>(desc);
}

bool depends_on_distance(const ProjectorDesc& desc, const Light& light) {
  constexpr int kGrid = 8;
  int lit = 0, unlike = 0;
  for (int i = 0; i < kGrid * kGrid; ++i) {
    const vec2 place =
        (vec2(i % kGrid, i / kGrid) + vec2(0.38f, 0.62f)) / static_cast<float>(kGrid);
    const vec2 q = desc.low + place * (desc.high - desc.low);
    const Rgb near = film_flux(desc, light, q), far = film_flux(desc, light, q, 3.0f);
    lit += is_black(near + far) ? 0 : 1;
    unlike += max_abs_component(near - far) > 1e-3f * max_component(near + far) ? 1 : 0;
  }
  return 2 * unlike > lit;  // rounding may find other pixels of a slide in a few places
}

std::vector<Rgb> watts_by_pixel(const ProjectorDesc& desc, const Light& light) {
  constexpr int kGrid = 4;
  const vec2 step = (desc.high - desc.low) / vec2(desc.width, desc.height);
  std::vector<Rgb> watts;
  watts.reserve(static_cast<size_t>(desc.width) * desc.height);
  for (int y = 0; y < desc.height; ++y) {
    for (int x = 0; x < desc.width; ++x) {
      Rgb sum(0.0f);
      for (int i = 0; i < kGrid * kGrid; ++i) {
        const vec2 place(static_cast<float>(i % kGrid), static_cast<float>(i) / kGrid);
        const vec2 within = (glm::floor(place) + 0.5f) / static_cast<float>(kGrid);
        sum += film_flux(desc, light, desc.low + step * (vec2(x, y) + within));
      }
      watts.push_back(sum * (desc.pixel_area() / (kGrid * kGrid)));
    }
  }
  return watts;
}

}  // namespace janus
