// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "janus/render/scene.h"
#include "janus/scene/description.h"
#include "janus/util/cancel.h"
#include "janus/util/error.h"

namespace janus {

// A mesh in the making: scenes that show it share one.
class MeshItem {
 public:
  explicit MeshItem(MeshDesc desc) : desc_(std::move(desc)) {}

  // Throws Error once the mesh is made.
  void set_motion(const std::string& key, std::vector<MeshKey> motion) {
    const std::lock_guard lock(mutex_);
    if (mesh_) {
      throw SceneError(key, "motion", "the mesh is in use: set it again first");
    }
    desc_.motion = std::move(motion);
  }

  // Made of the description when it is first asked for. May be called from any thread. Throws what
  // the mesh throws.
  std::shared_ptr<const Mesh> mesh(const std::string& key) {
    const std::lock_guard lock(mutex_);
    if (!mesh_) {
      mesh_ = std::make_shared<const Mesh>(key, std::move(desc_));
    }
    return mesh_;
  }

 private:
  std::mutex mutex_;
  MeshDesc desc_;  // empty once the mesh is made
  std::shared_ptr<const Mesh> mesh_;
};

// Collects a description item by item and turns it into a Scene. Keys are the caller's; setting a
// key again replaces the item. One thread at a time.
class SceneBuilder {
 public:
  void set_mesh(const std::string& key, MeshDesc desc) {
    meshes_[key] = std::make_shared<MeshItem>(std::move(desc));
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
  // rendered, Cancelled; the rest is reported in Scene::diagnostics. Meshes that were set before
  // the last commit, their hierarchies for rays among them, are shared with its scene, if that is
  // still in use: so a small change to a large scene takes little time.
  std::shared_ptr<const Scene> commit(const CancelToken& cancel) const;

 private:
  // A scene that shares what it can with `last`, if there is one; of the shadow catchers alone in
  // the scene `whole`, if that is one.
  std::shared_ptr<Scene> make(const Scene* last, const Scene* whole,
                              const CancelToken& cancel) const;

  // Ordered maps: the scene, and so the image, does not depend on the order of the calls.
  // Copies of a builder share the meshes, its heaviest part.
  std::map<std::string, std::shared_ptr<MeshItem>> meshes_;
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
