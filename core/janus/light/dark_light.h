// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "janus/light/light.h"

namespace janus {

// In the place of a light that is chosen as if it shone. Two scenes that differ in their lights
// then choose alike, and their pictures have the same noise where the others light them (shadow
// catchers are a quotient of two such pictures).
class DarkLight final : public Light {
 public:
  // `light` has to be usable when somebody asks for emitters.
  explicit DarkLight(std::shared_ptr<const Light> light) : light_(std::move(light)) {
    name = light_->name;
  }

  float power() const override { return light_->power(); }
  bool hittable() const override { return false; }
  bool infinite() const override { return light_->infinite(); }
  std::optional<EmissionSample> sample_emission(vec2, vec2) const override { return std::nullopt; }
  std::vector<Emitter> emitters() const override { return light_->emitters(); }
  std::optional<IlluminationSample> sample_illumination(vec3, uint32_t, vec2) const override {
    return std::nullopt;
  }
  float pdf_illumination(const EmissionSample&, vec3, vec3) const override { return 0.0f; }
  std::optional<LightHit> intersect(const Ray&) const override { return std::nullopt; }

 private:
  std::shared_ptr<const Light> light_;
};

}  // namespace janus
