// SPDX-License-Identifier: GPL-3.0-or-later
//
// Ray queries. Embree (3.13 or 4) is known to accel.cpp alone.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "janus/geometry/instance.h"
#include "janus/geometry/interaction.h"
#include "janus/geometry/placement.h"
#include "janus/util/cancel.h"

namespace janus {

class Accel {
 public:
  // Builds the two-level hierarchy; instances must outlive this. The hierarchies of shapes that
  // are also in `previous` are shared with it. Throws Cancelled, or Error with Embree's message.
  Accel(const ShapeList& shapes, const std::vector<Instance>& instances, const CancelToken& cancel,
        const Accel* previous = nullptr);
  ~Accel();
  Accel(const Accel&) = delete;
  Accel& operator=(const Accel&) = delete;

  // The nearest surface within (0, ray.t_max) that rays of `type` meet, written to `hit`; false:
  // none.
  bool intersect(const Ray& ray, RayType type, SurfaceInteraction& hit) const;

  // The same among all surfaces, whatever they are visible to.
  bool intersect_any(const Ray& ray, SurfaceInteraction& hit) const;

  // Do rays of both types meet the same instances?
  bool alike(RayType a, RayType b) const;

  // The share of a shadow ray that is traced: a surface at its end, seen from afar, is known no
  // better than to the rest.
  static constexpr float kShadowReach = 1.0f - 0x1p-17f;

  // True if something that rays of `type` meet lies on the open segment from `a` to `b` (points
  // already off surfaces), up to kShadowReach of it.
  bool occluded(vec3 a, vec3 b, RayType type) const;

  // The same among the instances with `opaque`, and the nearest surface among the others: together
  // they are what a shadow ray meets that some surfaces let through. Both cost nothing where all
  // instances are opaque.
  bool occluded_opaque(vec3 a, vec3 b, RayType type) const;
  bool intersect_transparent(const Ray& ray, RayType type, SurfaceInteraction& hit) const;

  // The surface at barycentric coordinates (b1, b2) of a triangle of a mesh; `offset` and normals
  // as from a hit. Used by light sampling, so that both ends of a shadow ray follow one rule.
  SurfaceInteraction surface_point(uint32_t instance, uint32_t primitive, vec2 b) const;

  // Its position alone; of what is round, the one amid it.
  vec3 position(uint32_t instance, uint32_t primitive, vec2 b) const {
    const Placement& placement = placements_[instance];
    return placement.round() ? placement.center(primitive, b.x) : placement.position(primitive, b);
  }

  // Looks for surfaces of one instance alone.
  class InstanceRays {
   public:
    InstanceRays(const Accel& accel, uint32_t instance);
    // The nearest within (0, ray.t_max), written to `hit`; false: none.
    bool intersect(const Ray& ray, SurfaceInteraction& hit) const;

   private:
    const Accel& accel_;
    uint32_t instance_;
    mat4 to_object_;
  };

  // World bounds of everything.
  const Bounds& bounds() const { return bounds_; }

  // Bytes that Embree holds, for this and for what shares hierarchies with it. Instances of one
  // shape share its hierarchy.
  size_t bytes() const;
  // How many hierarchies of shapes were built, and not taken over.
  size_t built() const { return built_; }

  static std::string embree_version();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
  const std::vector<Instance>& instances_;
  std::vector<Placement> placements_;  // by instance
  Bounds bounds_;
  size_t built_ = 0;
};

}  // namespace janus
