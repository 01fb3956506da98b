// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/render/time_slice.h"

#include <algorithm>

namespace janus {

namespace {

CameraDesc camera_at(const CameraDesc& camera, float time) {
  CameraDesc result = camera;
  result.motion.clear();
  if (camera.motion.empty()) {
    return result;
  }
  std::vector<mat4> transforms;
  for (const CameraDesc::Key& key : camera.motion) {
    transforms.push_back(key.transform);
  }
  result.transform = Motion(transforms).at(time);
  const KeyTime at(time, camera.motion.size());
  const CameraDesc::Key &a = camera.motion[at.first], &b = camera.motion[at.first + 1];
  const auto blend = [&](float from, float to) { return (1.0f - at.share) * from + at.share * to; };
  result.left = blend(a.left, b.left);
  result.right = blend(a.right, b.right);
  result.bottom = blend(a.bottom, b.bottom);
  result.top = blend(a.top, b.top);
  return result;
}

bool any_instance_moves(const Scene& scene) {
  return std::ranges::any_of(scene.instances, [&](const auto& i) { return moves(scene, i); });
}

void move_shapes(Scene& slice, float time) {
  for (std::shared_ptr<const Shape>& shape : slice.shapes) {
    if (shape->moves()) {
      shape = shape->at(time);
    }
  }
}

void move_instances(Scene& slice, float time) {
  for (Instance& instance : slice.instances) {
    if (instance.motion) {
      instance.to_world = instance.motion->at(time);
      instance.normal_to_world = glm::transpose(glm::inverse(mat3(instance.to_world)));
      instance.motion = nullptr;
    }
  }
}

// Mesh lights that move, or may look different to a camera that does.
bool renew_lights(Scene& slice, const Scene& scene) {
  bool renewed = false;
  for (size_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    const auto varies = [&](uint32_t surface) {
      return scene.surfaces.program(surface).varying_emission;
    };
    if (instance.light < 0 ||
        !(moves(scene, instance) ||
          (!scene.camera.motion.empty() && std::ranges::any_of(instance.materials, varies)))) {
      continue;
    }
    const auto index = static_cast<size_t>(instance.light);
    slice.lights[index] = std::make_shared<const MeshLight>(
        *slice.accel, slice.surfaces, *slice.shapes[instance.shape], slice.instances[i],
        static_cast<uint32_t>(i), static_cast<const MeshLight*>(scene.lights[index].get()));
    renewed = true;
  }
  return renewed;
}

}  // namespace

bool moves(const Scene& scene, const Instance& instance) {
  return instance.motion || scene.shapes[instance.shape]->moves();
}

bool moves(const Scene& scene) { return !scene.camera.motion.empty() || any_instance_moves(scene); }

size_t slice_work(const Scene& scene) {
  size_t work = scene.instances.size();
  for (const auto& shape : scene.shapes) {
    work += shape->moves() ? shape->primitives() : 0;
  }
  for (const Instance& instance : scene.instances) {
    const bool shines = instance.light >= 0 && moves(scene, instance);
    work += shines ? scene.shapes[instance.shape]->primitives() : 0;
  }
  return work;
}

std::shared_ptr<const Scene> at_time(const std::shared_ptr<const Scene>& scene, float time,
                                     const CancelToken& cancel, const Scene* whole) {
  auto slice = std::make_shared<Scene>(*scene);
  slice->made_of = scene;
  slice->whole = whole;
  slice->camera = camera_at(scene->camera, time);
  const bool instances_move = any_instance_moves(*scene);
  if (instances_move) {
    move_shapes(*slice, time);
    move_instances(*slice, time);
    slice->accel =
        std::make_shared<const Accel>(slice->shapes, slice->instances, cancel, scene->accel.get());
  }
  slice->place_objects();
  if (renew_lights(*slice, *scene)) {
    slice->light_sampler = LightSampler(slice->lights);
  }
  return slice;
}

}  // namespace janus
