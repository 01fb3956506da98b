// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/render/under_projector.h"

#include <algorithm>

#include "janus/light/lamps.h"
#include "janus/util/error.h"

namespace janus {

ProjectorDesc find_projector(const Scene& scene, const std::string& name, int width, int height) {
  const Scene::Lamp* found = nullptr;
  std::string known;
  for (const Scene::Lamp& lamp : scene.described_lamps) {
    known += (known.empty() ? "'" : ", '") + lamp.desc.name + "'";
    if (lamp.desc.name == name) {
      if (found) {
        throw SceneError(name, "projector", "there are several lights of this name in the scene");
      }
      found = &lamp;
    }
  }
  if (!found) {
    throw SceneError(name, "projector",
                     "there is no such light in the scene; there " +
                         (known.empty() ? std::string("is none") : "are " + known));
  }
  return projector_of(found->desc, width, height);
}

std::shared_ptr<const Scene> under_projector(const std::shared_ptr<const Scene>& scene,
                                             const ProjectorDesc& projector) {
  auto lit = std::make_shared<Scene>(*scene);
  lit->made_of = scene;
  for (Instance& instance : lit->instances) {
    instance.light = -1;
  }
  const std::shared_ptr<const Light> light = make_projector(projector);
  lit->lights = {light};
  lit->lamps.clear();
  lit->described_lamps.clear();
  lit->lamp_index = LampIndex(lit->lights, lit->lamps);
  lit->light_sampler = LightSampler(lit->lights);
  lit->shadow_types = ray_bit(light->shadow_ray);
  lit->has_own_shadows = light->shadow_ray != RayType::Shadow;
  lit->catchers_alone = nullptr;
  return lit;
}

LampWatts lamp_watts(const Scene& scene, const ProjectorDesc& projector) {
  LampWatts watts;
  watts.own.resize(static_cast<size_t>(projector.width) * projector.height, Rgb(0.0f));
  const auto lamp = std::ranges::find(scene.described_lamps, projector.lamp.name,
                                      [](const Scene::Lamp& l) { return l.desc.name; });
  // Where the tree asks for the kind of ray, diffuse surfaces decide.
  for (size_t i = 0; lamp != scene.described_lamps.end() && i < lamp->count; ++i) {
    const Light& light = *scene.lights[lamp->first_light + i];
    if (contains(light.visibility, RayType::Diffuse)) {
      if (depends_on_distance(projector, light)) {
        throw SceneError(projector.lamp.name, "node_tree",
                         "a projector's light must not depend on the distance (Light Falloff)");
      }
      const std::vector<Rgb> part = watts_by_pixel(projector, light);
      std::ranges::transform(part, watts.own, watts.own.begin(), std::plus<>());
    }
  }
  const auto plain = projector.parallel ? make_area_light(projector.lamp, Rgb(1.0f))
                                        : make_point_light(projector.lamp, Rgb(1.0f));
  watts.plain = watts_by_pixel(projector, *plain);
  return watts;
}

}  // namespace janus
