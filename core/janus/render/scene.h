// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "janus/geometry/accel.h"
#include "janus/geometry/mesh.h"
#include "janus/light/lamp_index.h"
#include "janus/light/light_sampler.h"
#include "janus/light/mesh_light.h"
#include "janus/scene/description.h"
#include "janus/scene/diagnostics.h"
#include "janus/shading/program.h"

namespace janus {

// A committed scene: immutable, shared by any number of threads and sessions. Made by
// SceneBuilder::commit().
class Scene {
 public:
  std::optional<SurfaceInteraction> intersect(const Ray& ray) const {
    return accel->intersect(ray);
  }
  bool occluded(vec3 a, vec3 b) const { return accel->occluded(a, b); }
  ShadingResult shade(const SurfaceInteraction& hit) const {
    return programs[hit.material].run(hit.ns);
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

  std::vector<Mesh> meshes;
  std::vector<Instance> instances;
  std::vector<Program> programs;
  std::unique_ptr<Accel> accel;
  std::vector<std::unique_ptr<Light>> lights;  // mesh lights first
  std::vector<size_t> lamps;  // the lights that rays meet without a surface; the world last
  LampIndex lamp_index;
  LightSampler light_sampler;
  CameraDesc camera;
  Diagnostics diagnostics;
};

}  // namespace janus
