// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/render/surroundings.h"

#include "janus/geometry/mesh.h"
#include "janus/render/time_slice.h"

namespace janus {

namespace {

Bounds swept(const Instance& instance, const Shape& shape) {
  return instance.motion ? instance.motion->swept(shape.bounds())
                         : transformed(shape.bounds(), instance.to_world);
}

}  // namespace

Bounds surroundings(const Scene& scene) {
  Bounds bounds = scene.accel->bounds();
  for (const Instance& instance : scene.instances) {
    const Shape& shape = *scene.shapes[instance.shape];
    if (moves(scene, instance) && shape.primitives() > 0) {
      bounds.extend(swept(instance, shape));
    }
  }
  return bounds;
}

bool surfaces_near(const Scene& scene, const LightDesc& lamp) {
  const vec3 center(lamp.transform[3]);
  for (const Instance& instance : scene.instances) {
    const Shape& shape = *scene.shapes[instance.shape];
    const auto near = [&](const Bounds& bounds) {
      return length2(glm::clamp(center, bounds.lower, bounds.upper) - center) < sqr(lamp.radius);
    };
    if (shape.primitives() == 0 || !near(swept(instance, shape))) {
      continue;
    }
    const Mesh* mesh = shape.mesh();
    if (moves(scene, instance) || !mesh) {
      return true;
    }
    for (const Mesh::Triangle& triangle : mesh->triangles()) {
      Bounds bounds;
      for (const uint32_t v : triangle.v) {
        bounds.extend(vec3(instance.to_world * vec4(mesh->positions()[v], 1.0f)));
      }
      if (near(bounds)) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace janus
