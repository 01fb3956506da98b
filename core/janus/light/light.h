// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sources of light.
//
// A light subpath starts with a ray, and the density of that ray is given once, per unit of
// projected area and solid angle (dA cos(theta) d omega, the measure that free flight preserves).
// The next vertex z_1 of the path fixes the rest: with the endpoint z_0 measured by its direction
// from z_1, the joint density of (z_0, z_1) is ray density * |cos theta_1|, for lamps, meshes and
// infinite lights alike (emission_density). Lights of a single point or direction carry flags; the
// common delta is left out of every density that contains it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "janus/geometry/interaction.h"
#include "janus/math/vec.h"
#include "janus/scene/description.h"
#include "janus/shading/path_so_far.h"

namespace janus {

// Density of an emitted ray. `from_point`: the light is a point, so `value` is per solid angle at
// the light instead.
struct RayDensity {
  float value = 0.0f;
  bool from_point = false;
};

// Joint density of (z_0 per solid angle at z_1, z_1 per area), given |cos| at z_1 and the squared
// distance from z_0. The one place where endpoints change measure.
inline float emission_density(RayDensity ray, float cos_1, float distance2) {
  return ray.value * cos_1 / (ray.from_point ? distance2 : 1.0f);
}

// Start of a light subpath.
struct EmissionSample {
  vec3 origin;     // already off the emitting surface
  vec3 direction;  // unit
  Rgb weight;      // radiance / ray density (flux)
  RayDensity density;
  // Emitting surfaces: the normal on the side that emits, the density per area with which
  // sample_illumination draws this point, and the primitive that it lies on.
  vec3 normal = vec3(0.0f);
  float pdf_area = 0.0f;
  uint32_t primitive = 0;
};

// Next event estimation: the light as seen from a receiver.
struct IlluminationSample {
  vec3 wi;          // from the receiver, unit
  vec3 target;      // end of the shadow ray, already off the emitting surface
  float distance2;  // to the endpoint; unused for infinite lights
  Rgb radiance;     // for a point: intensity / distance^2
  float pdf_solid;  // per solid angle at the receiver; 1 stands for the delta of a point
  RayDensity emission;
  vec2 barycentric = vec2(0.0f);  // mesh lights: on their triangle
};

// A light found along a ray from `origin`.
struct LightHit {
  float t;  // kInfinity for infinite lights
  Rgb radiance;
  float pdf_illumination;  // pdf_solid of sample_illumination at the ray's origin
  RayDensity emission;
  float distance2;
  uint32_t primitive = 0;

  // Found by chance only, because next event estimation leaves it out?
  bool by_chance() const { return pdf_illumination == 0.0f; }
};

// What light selection knows of an emitter: a lamp, or one triangle of a mesh light. The bounds are
// conservative: nothing shines outside of them.
struct Emitter {
  // Radiant intensity in the brightest direction, W/sr; infinite lights: irradiance of a surface
  // that faces them, W/m^2. Luminance; 0: never chosen.
  float strength = 0.0f;
  Bounds bounds;
  // Light leaves within theta_o + theta_e of an axis, and falls with the cosine beyond theta_o
  // (Conty Estevez & Kulla 2018). Infinite lights: light comes from within theta_o of the axis.
  vec3 axis = vec3(0.0f, 0.0f, 1.0f);
  float theta_o = kPi, theta_e = 0.5f * kPi;
  bool two_sided = false;  // likewise around the opposite axis
  bool infinite = false;
  LinkMask links = kLightsAll;  // what it shines on (scene/linking.h)
};

class Light {
 public:
  Light() = default;
  virtual ~Light() = default;
  Light(const Light&) = delete;
  Light& operator=(const Light&) = delete;

  std::string name, light_group;
  RayMask visibility = kAllRays;         // the camera, and the labels of z_1, that see it
  RayType shadow_ray = RayType::Shadow;  // or Unblocked, or one of its own
  int link_set = -1;                     // EmitterLinks::receivers
  // Edges of the paths on which next event estimation may find it, whichever technique does.
  int max_edges = 1 << 20;
  bool background = false;  // the world: a transparent film leaves it out
  bool holdout = false;     // part of an object that holds out
  // Its radiance depends on the path to it. What does emits no light paths, which would not know.
  bool by_path = false;

  void set_links(const EmitterLinks& links) {
    link_set = links.receivers;
    shadow_ray = links.blockers < 0 ? RayType::Shadow : shadow_ray_of(links.blockers);
  }

  // Takes the rules of a light object.
  void set_rules(const LightDesc& desc) {
    visibility = desc.visibility;
    set_links(desc.links);
    shadow_ray = desc.cast_shadow ? shadow_ray : RayType::Unblocked;
    max_edges = desc.max_bounces + 2;
  }

  // Emitted power, watts (an estimate that guides sampling; Rgb luminance).
  virtual float power() const = 0;

  // Can rays hit it? False for points.
  virtual bool hittable() const = 0;

  // Beyond all surfaces?
  virtual bool infinite() const { return false; }

  virtual std::optional<EmissionSample> sample_emission(vec2 u_position,
                                                        vec2 u_direction) const = 0;

  // The emitters that next event estimation chooses from: one for a lamp, one per primitive for a
  // mesh light.
  virtual std::vector<Emitter> emitters() const = 0;

  // A point of emitter `primitive` for `receiver`.
  virtual std::optional<IlluminationSample> sample_illumination(vec3 receiver, uint32_t primitive,
                                                                vec2 u) const = 0;

  // pdf_solid with which sample_illumination at `receiver`, given the emitter, draws the endpoint
  // of an emitted ray.
  virtual float pdf_illumination(const EmissionSample& sample, vec3 endpoint,
                                 vec3 receiver) const = 0;

  // Lamps and infinite lights: the light along the ray, before ray.t_max.
  virtual std::optional<LightHit> intersect(const Ray& ray) const = 0;

  // The endpoint z_0 of an emitted ray that reaches `receiver`. nullopt if the light does not
  // shine there after all: Blender's soft point light turns its disk to each receiver.
  virtual std::optional<vec3> endpoint(const EmissionSample& sample, vec3 receiver) const {
    (void)receiver;
    return sample.origin;
  }

  // What a node tree makes of the light that leaves z_0 at `endpoint` in `direction` for a z_1 at
  // `distance`, as a factor. The radiance of sample_illumination() and intersect() has it; the
  // weight of sample_emission(), which does not know these, has not.
  virtual Rgb tint(vec3 endpoint, vec3 direction, float distance) const {
    (void)endpoint, (void)direction, (void)distance;
    return Rgb(1.0f);
  }

  // Where `by_path`: completes a sample or a hit of `ray`, which know no path. (Walks that meet a
  // mesh light have asked its surface.)
  virtual void shine_on(const PathSoFar& path, uint32_t primitive,
                        IlluminationSample& sample) const {
    (void)path, (void)primitive, (void)sample;
  }
  virtual void shine_on(const PathSoFar& path, const Ray& ray, LightHit& hit) const {
    (void)path, (void)ray, (void)hit;
  }
  // The light of a lamp along the ray, before ray.t_max, as the path sees it.
  std::optional<LightHit> look_along(const Ray& ray, PathSoFar path) const {
    auto hit = intersect(ray);
    if (hit && by_path) [[unlikely]] {
      path.ray_length = hit->t;
      shine_on(path, ray, *hit);
      if (is_black(hit->radiance)) {
        hit.reset();
      }
    }
    return hit;
  }

  // Projectors: the number of the pixel from which light goes to z_1 (light/projector.h).
  virtual uint32_t pixel(vec3 z_1) const {
    (void)z_1;
    return 0;
  }
};

// Scenes that differ in time share the lights that stand still.
using LightList = std::vector<std::shared_ptr<const Light>>;

}  // namespace janus
