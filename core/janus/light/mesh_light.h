// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "janus/geometry/accel.h"
#include "janus/geometry/surfaces.h"
#include "janus/light/light.h"
#include "janus/math/discrete.h"

namespace janus {

// The emitting triangles of one instance. Both sides shine, as in Cycles. Of what is round all
// primitives stay dark here, as there: their light is found by chance.
class MeshLight final : public Light {
 public:
  // Of instance `index`, whose materials emit. What is not to be looked for stays dark here.
  // `at_rest`: the same light at another time, which has looked at what varies: where it is bright
  // is known well enough from there.
  MeshLight(const Accel& accel, const Surfaces& surfaces, const Shape& shape,
            const Instance& instance, uint32_t index, const MeshLight* at_rest = nullptr);

  float power() const override { return power_; }
  bool hittable() const override { return true; }
  std::optional<EmissionSample> sample_emission(vec2 u_position, vec2 u_direction) const override;
  std::optional<IlluminationSample> sample_illumination(vec3 receiver, uint32_t primitive,
                                                        vec2 u) const override;
  std::vector<Emitter> emitters() const override;
  float pdf_illumination(const EmissionSample& sample, vec3 endpoint, vec3 receiver) const override;
  using Light::shine_on;
  void shine_on(const PathSoFar& path, uint32_t primitive,
                IlluminationSample& sample) const override;

  // Mesh lights are surfaces: the walk finds them, and asks at() then.
  std::optional<LightHit> intersect(const Ray& /*ray*/) const override { return std::nullopt; }
  LightHit at(const SurfaceInteraction& hit, vec3 origin, vec3 direction, Rgb radiance) const;

 private:
  // A triangle that shines.
  struct Triangle {
    Rgb radiance;  // everywhere, or the mean of what was looked at
    bool varying;  // over the triangle, or with the direction
    bool by_path;  // with the path to it
    vec3 ng;
    float offset;    // as in SurfaceInteraction
    float pdf_area;  // 1 / area
    RayDensity density;
    uint32_t primitive;
  };
  static constexpr uint32_t kDark = 0xffffffffU;

  const Triangle& triangle(uint32_t primitive) const { return triangles_[slot_[primitive]]; }
  void add_triangles(const Mesh& mesh, const Instance& instance, const MeshLight* at_rest);
  // What the mesh's triangle emits: the mean over some of its points, from both sides.
  Rgb mean_radiance(uint32_t primitive) const;
  Rgb known_radiance(uint32_t primitive) const {
    return slot_[primitive] == kDark ? Rgb(0.0f) : triangle(primitive).radiance;
  }
  // At a point, into the unit direction `view`.
  Rgb radiance(const Triangle& triangle, vec2 barycentric, vec3 view) const {
    return triangle.varying ? varying_radiance(triangle, barycentric, view, {}) : triangle.radiance;
  }
  Rgb varying_radiance(const Triangle& triangle, vec2 barycentric, vec3 view,
                       const PathSoFar& path) const;

  const Accel& accel_;
  const Surfaces& surfaces_;
  uint32_t instance_;
  std::vector<Triangle> triangles_;
  std::vector<uint32_t> slot_;  // by primitive: its place in triangles_, or kDark
  DiscreteDistribution by_power_;
  float power_ = 0.0f;  // of what light paths start on
};

}  // namespace janus
