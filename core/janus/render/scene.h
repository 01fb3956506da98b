// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "janus/geometry/accel.h"
#include "janus/geometry/surfaces.h"
#include "janus/light/lamp_index.h"
#include "janus/light/light_sampler.h"
#include "janus/light/mesh_light.h"
#include "janus/scene/description.h"
#include "janus/scene/diagnostics.h"

namespace janus {

// Cycles' camera space.
CameraView view_of(const CameraDesc& camera);

// A committed scene: immutable, shared by any number of threads and sessions. Made by
// SceneBuilder::commit().
class Scene {
 public:
  // Lets `surfaces` know the instances as they stand, and the camera.
  void place_objects();

  // The nearest surface that rays of `type` meet, written to `hit`; false: none.
  bool intersect(const Ray& ray, RayType type, SurfaceInteraction& hit) const {
    return accel->intersect(ray, type, hit);
  }
  std::optional<SurfaceInteraction> intersect(const Ray& ray,
                                              RayType type = RayType::Camera) const {
    std::optional<SurfaceInteraction> hit(std::in_place);
    if (!intersect(ray, type, *hit)) {
      hit.reset();
    }
    return hit;
  }
  // Makes `hit` the same point of a copy of what it is on (Instance::first_copy).
  void turn_to_copy(SurfaceInteraction& hit, uint32_t copy) const {
    const Instance& instance = instances[copy];
    hit.instance = copy;
    hit.material = instance.material(shapes[instance.shape]->material(hit.primitive));
  }
  // What the surface does there, seen from the unit direction `view` at the end of `path`.
  void shade(const SurfaceInteraction& hit, vec3 view, ShadingResult& result,
             const PathSoFar& path = {}) const {
    surfaces.shade(hit, view, result, path);
  }
  void shade(const SurfaceInteraction& hit, vec3 view, ShadingResult& result, Reshading& reshading,
             const PathSoFar& path = {}) const {
    surfaces.shade(hit, view, result, reshading, path);
  }
  bool occluded(vec3 a, vec3 b, RayType type = RayType::Shadow) const {
    return accel->occluded(a, b, type);
  }

  // What the surfaces that rays of `type` meet on the open segment from `a` to `b` let through;
  // black if one of them is opaque, or if they are more than `max_crossings`. `camera`: the end on
  // the camera's side, from which they are seen; `path`: how it leads there. Where that is not
  // known, what depends on it lets nothing through.
  enum class End { A, B };
  Rgb transmittance(vec3 a, vec3 b, RayType type, int max_crossings, End camera = End::A,
                    const PathSoFar* path = nullptr) const {
    if (!has_transparency) {
      return Rgb(occluded(a, b, type) ? 0.0f : 1.0f);
    }
    if (path && has_path_crossings) [[unlikely]] {
      return pass(camera == End::A ? a : b, camera == End::A ? b : a, type, max_crossings, *path)
          .through;
    }
    return transmittance_through(a, b, type, max_crossings, camera);
  }
  // The same from the camera's side to the light's, with what was passed.
  struct Passed {
    Rgb through = Rgb(1.0f);
    int crossings = 0;
    bool by_path = false;  // some of it depends on the path
  };
  Passed pass(vec3 camera, vec3 light, RayType type, int max_crossings,
              const PathSoFar& path) const;
  // The first shadow catcher that is passed on the open segment, which is clear to the camera, from
  // there at `a` to `b`: a point before its surface.
  std::optional<vec3> passed_catcher(vec3 a, vec3 b) const {
    return has_clear_catchers ? find_passed_catcher(a, b) : std::nullopt;
  }
  ShadingResult shade(const SurfaceInteraction& hit, vec3 view, const PathSoFar& path = {}) const {
    ShadingResult result;
    shade(hit, view, result, path);
    return result;
  }

  // A surface as the choice of a light sees it; `side`: a direction on its camera side (or, for one
  // that does not transmit, on its light side).
  Receiver receiver(const SurfaceInteraction& hit, bool transmits, vec3 side) const {
    return {hit.p, dot(side, hit.ng) < 0.0f ? -hit.ng : hit.ng, transmits,
            has_links ? instances[hit.instance].unlit_by : 0};
  }

  // The emitter that a surface is part of, if light paths can start on it.
  const MeshLight* mesh_light(const SurfaceInteraction& hit, size_t& index) const {
    const int light = instances[hit.instance].light;
    if (light < 0) {
      return nullptr;
    }
    index = static_cast<size_t>(light);
    return static_cast<const MeshLight*>(lights[index].get());
  }

  ShapeList shapes;
  std::vector<Instance> instances;
  Surfaces surfaces;
  std::shared_ptr<const Accel> accel;
  LightList lights;  // mesh lights first
  // Light objects as described, but for their node trees, with the lights that they became.
  struct Lamp {
    LightDesc desc;
    size_t first_light = 0, count = 0;
  };
  std::vector<Lamp> described_lamps;
  std::vector<size_t> lamps;  // those that rays meet without a surface; the world last
  LampIndex lamp_index;
  LightSampler light_sampler;
  bool has_transparency = false;    // of some surface
  RayMask shadow_types = 0;         // shadow rays of the lights
  bool has_own_shadows = false;     // some are not RayType::Shadow
  bool has_links = false;           // some light does not shine on everything
  bool has_ray_types = false;       // that, or some object or light is not visible to all rays
  bool has_by_path = false;         // some surface or light depends on the path to it
  bool has_path_crossings = false;  // so does what some surface lets through
  bool has_holdouts = false;        // of some object or surface
  bool has_clear_catchers = false;  // shadow catchers that are transparent in places
  Bounds surroundings;              // of all surfaces, at all times
  CameraDesc camera;
  Diagnostics diagnostics;
  // Names of AOVs, by the numbers that programs write.
  std::vector<std::string> aov_names;
  // What the camera sees of them in the background; null: nothing.
  std::shared_ptr<const Program> world_aovs;
  // Of a scene at a time of the shutter, or under a projector: the one that it was made of, with
  // which it shares much.
  std::shared_ptr<const Scene> made_of;
  // Where the camera may see shadow catchers: the scene as the footage shows it, with them and
  // their lights alone. Null: there are none.
  std::shared_ptr<const Scene> catchers_alone;
  // Of such a scene: that of which it is a part, at the same time. It outlives the use of this one.
  const Scene* whole = nullptr;

 private:
  std::optional<vec3> find_passed_catcher(vec3 a, vec3 b) const;
  Rgb transmittance_through(vec3 a, vec3 b, RayType type, int max_crossings, End camera) const;
};

}  // namespace janus
