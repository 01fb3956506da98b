// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/render/lamp.h"

#include "janus/light/program_light.h"
#include "janus/render/onlookers.h"

namespace janus {

namespace {

constexpr float kMinSpread = 0.1f * kPi / 180.0f;

class LampMaker {
 public:
  LampMaker(LightDesc lamp, const LampSurroundings& around, Diagnostics& diagnostics)
      : lamp_(std::move(lamp)), around_(around), diagnostics_(diagnostics) {}

  std::vector<std::unique_ptr<Light>> make(const ImageMap& images) {
    std::vector<std::unique_ptr<Light>> lights;
    if (!is_finite(lamp_.transform)) {
      warn("its transform is not finite; the light is left out");
      return lights;
    }
    for (SeenProgram& seen : programs(images)) {
      if (scatters(seen.program)) {
        warn("a surface shader in a light has no effect");
      }
      const bool varies = seen.program.varying_emission;
      auto light = make_plain(varies ? Rgb(1.0f) : seen.program.emission);
      if (!light) {
        continue;
      }
      if (varies) {
        light =
            make_program_light(std::move(light), lamp_, std::move(seen.program), around_.camera);
      }
      light->visibility &= seen.seen_by;
      lights.push_back(std::move(light));
    }
    return lights;
  }

 private:
  void warn(const std::string& message) {
    diagnostics_.push_back({Severity::Warning, lamp_.name, "", "", message});
  }

  std::vector<SeenProgram> programs(const ImageMap& images) {
    std::vector<SeenProgram> programs;
    if (!lamp_.graph) {
      Program plain;
      plain.emission = Rgb(1.0f);
      programs.push_back({kAllRays, std::move(plain)});
      return programs;
    }
    const bool by_ray = asks_for_rays(*lamp_.graph);
    for (const RayType ray : kOnlookers) {
      Diagnostics said;
      add_seen(programs, ray,
               compile(*lamp_.graph, lamp_.name, images, said, {SeenTree::Of::Lamp, ray}));
      add_new(diagnostics_, said);
      if (!by_ray) {
        break;
      }
    }
    if (programs.size() == 1) {
      programs.front().seen_by = kAllRays;
    }
    return programs;
  }

  // Of constant strength; null if it does not shine.
  std::unique_ptr<Light> make_plain(Rgb strength) {
    const Rgb power = lamp_power(lamp_, strength);
    if (!is_finite(power)) {
      warn("its power is not finite; the light is left out");
      return nullptr;
    }
    if (power.x < 0.0f || power.y < 0.0f || power.z < 0.0f) {
      warn("negative light is not supported; the light is left out");
      return nullptr;
    }
    if (is_black(power)) {
      return nullptr;
    }
    switch (lamp_.type) {
      case LightType::Point:
        return make_point(strength);
      case LightType::Spot:
        return make_spot(strength);
      case LightType::Area:
        return make_area(strength);
      case LightType::Sun:
        return make_sun(strength);
    }
    return nullptr;
  }

  std::unique_ptr<Light> make_point(Rgb strength) {
    if (!std::isfinite(lamp_.radius)) {
      warn("its radius is not finite; the light is left out");
      return nullptr;
    }
    const bool sphere = !lamp_.soft_falloff && lamp_.radius > 0.0f;
    return make_point_light(lamp_, strength, sphere && around_.surfaces_near(lamp_));
  }

  std::unique_ptr<Light> make_spot(Rgb strength) {
    const float volume = glm::determinant(mat3(lamp_.transform));
    if (volume == 0.0f || !std::isfinite(volume)) {
      warn("a spot light that is scaled to nothing does not shine; it is left out");
      return nullptr;
    }
    if (!(lamp_.spot_size > 0.0f) || !std::isfinite(lamp_.spot_blend)) {
      warn("a spot light without a beam does not shine; it is left out");
      return nullptr;
    }
    return make_point(strength);
  }

  std::unique_ptr<Light> make_area(Rgb strength) {
    const bool two_sizes = lamp_.shape == AreaShape::Rectangle || lamp_.shape == AreaShape::Ellipse;
    const vec3 u = lamp_.size * vec3(lamp_.transform[0]);
    const vec3 v = (two_sizes ? lamp_.size_y : lamp_.size) * vec3(lamp_.transform[1]);
    const float area = glm::length(cross(u, v));
    const float volume = glm::determinant(mat3(lamp_.transform));
    if (!(area > 0.0f) || !std::isfinite(area) || !std::isfinite(volume) || volume == 0.0f) {
      warn("an area light without an area does not shine; it is left out");
      return nullptr;
    }
    if (!(lamp_.spread >= kMinSpread)) {
      warn("a spread below 0.1 degrees is not supported; 0.1 is used");
      lamp_.spread = kMinSpread;
    }
    return make_area_light(lamp_, strength);
  }

  std::unique_ptr<Light> make_sun(Rgb strength) {
    const float length = glm::length(vec3(lamp_.transform[2]));
    if (!(length > 0.0f) || !std::isfinite(length) || !std::isfinite(lamp_.angle)) {
      warn("its direction or its angle is not defined; the light is left out");
      return nullptr;
    }
    return make_sun_light(lamp_, strength, around_.scene);
  }

  LightDesc lamp_;
  const LampSurroundings& around_;
  Diagnostics& diagnostics_;
};

}  // namespace

std::vector<std::unique_ptr<Light>> make_lamp(LightDesc lamp, const ImageMap& images,
                                              const LampSurroundings& around,
                                              Diagnostics& diagnostics) {
  return LampMaker(std::move(lamp), around, diagnostics).make(images);
}

}  // namespace janus
