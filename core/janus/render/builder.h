// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <variant>

#include "janus/geometry/mesh.h"
#include "janus/geometry/round_shape.h"
#include "janus/render/scene.h"
#include "janus/scene/description.h"
#include "janus/util/cancel.h"
#include "janus/util/error.h"

namespace janus {

// A shape in the making: scenes that show it share one.
class ShapeItem {
 public:
  explicit ShapeItem(std::variant<MeshDesc, RoundDesc> desc) : desc_(std::move(desc)) {}

  // Throws Error once the shape is made.
  void set_motion(const std::string& key, std::vector<MeshKey> motion) {
    const std::lock_guard lock(mutex_);
    if (shape_) {
      throw SceneError(key, "motion", "the mesh is in use: set it again first");
    }
    std::visit([&](auto& desc) { desc.motion = std::move(motion); }, desc_);
  }

  // Made of the description when it is first asked for. May be called from any thread. Throws what
  // the shape throws.
  std::shared_ptr<const Shape> shape(const std::string& key) {
    const std::lock_guard lock(mutex_);
    if (!shape_) {
      if (auto* mesh = std::get_if<MeshDesc>(&desc_)) {
        shape_ = std::make_shared<const Mesh>(key, std::move(*mesh));
      } else {
        shape_ = std::make_shared<const RoundShape>(key, std::move(std::get<RoundDesc>(desc_)));
      }
    }
    return shape_;
  }

 private:
  std::mutex mutex_;
  std::variant<MeshDesc, RoundDesc> desc_;  // empty once the shape is made
  std::shared_ptr<const Shape> shape_;
};

// Collects a description item by item and turns it into a Scene. Keys are the caller's; setting a
// key again replaces the item. One thread at a time.
class SceneBuilder {
 public:
  // Meshes and what is round share their keys.
  void set_mesh(const std::string& key, MeshDesc desc) {
    shapes_[key] = std::make_shared<ShapeItem>(std::move(desc));
  }
  void set_round(const std::string& key, RoundDesc desc) {
    shapes_[key] = std::make_shared<ShapeItem>(std::move(desc));
  }
  void set_material(const std::string& key, MaterialDesc desc) {
    materials_[key] = std::move(desc);
  }
  void set_image(const std::string& key, ImageDesc desc) { images_[key] = std::move(desc); }
  void set_instance(const std::string& key, InstanceDesc desc) {
    instances_[key] = std::move(desc);
  }
  // Motion of what has been set, at even times from the one when the shutter opens to the one when
  // it closes. Throw SceneError for what is not there.
  void set_mesh_motion(const std::string& key, std::vector<MeshKey> motion);
  void set_instance_motion(const std::string& key, std::vector<mat4> motion);
  void set_camera_motion(std::vector<CameraDesc::Key> motion);
  // CameraDesc::shutter.
  void set_shutter(std::vector<float> shutter);

  void set_light(const std::string& key, LightDesc desc) { lights_[key] = std::move(desc); }
  void set_world(WorldDesc desc) { world_ = std::move(desc); }
  void set_camera(CameraDesc desc) { camera_ = std::move(desc); }
  void remove(const std::string& key);

  // Validates everything and builds what rendering needs. Throws SceneError for what cannot be
  // rendered, Cancelled; the rest is reported in Scene::diagnostics. Shapes that were set before
  // the last commit, their hierarchies for rays among them, are shared with its scene, if that is
  // still in use: so a small change to a large scene takes little time.
  std::shared_ptr<const Scene> commit(const CancelToken& cancel) const;

 private:
  // A scene that shares what it can with `last`, if there is one; of the shadow catchers alone in
  // the scene `whole`, if that is one.
  std::shared_ptr<Scene> make(const Scene* last, const Scene* whole,
                              const CancelToken& cancel) const;

  // Ordered maps: the scene, and so the image, does not depend on the order of the calls.
  // Copies of a builder share the shapes, its heaviest part.
  std::map<std::string, std::shared_ptr<ShapeItem>> shapes_;
  std::map<std::string, MaterialDesc> materials_;
  std::map<std::string, ImageDesc> images_;
  std::map<std::string, InstanceDesc> instances_;
  std::map<std::string, LightDesc> lights_;
  std::optional<WorldDesc> world_;
  std::optional<CameraDesc> camera_;

  struct LastScene {
    std::mutex mutex;
    std::weak_ptr<const Scene> scene;
  };
  std::shared_ptr<LastScene> last_ = std::make_shared<LastScene>();  // of all copies
};

}  // namespace janus
