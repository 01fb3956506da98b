// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/render/builder.h"

#include <algorithm>

#include "janus/render/lamp.h"
#include "janus/render/onlookers.h"
#include "janus/render/world.h"
#include "janus/scene/panorama.h"
#include "janus/shading/compiler.h"
#include "janus/util/error.h"

namespace janus {

// The camera looks along +z in Cycles; panoramas look along +x, with +z up; the mirror ball along
// -y, with +z up and +x to the right.
CameraView view_of(const CameraDesc& camera) {
  mat4 turn(1.0f);
  turn[2][2] = -1.0f;
  if (camera.type == CameraType::MirrorBall) {
    turn = mat4(0.0f);
    turn[0][0] = turn[1][2] = turn[2][1] = turn[3][3] = 1.0f;
  } else if (is_panorama(camera.type)) {
    turn = mat4(0.0f);
    turn[0][1] = turn[2][0] = -1.0f;
    turn[1][2] = turn[3][3] = 1.0f;
  }
  const mat4 from_world = turn * glm::inverse(camera.transform);
  const vec2 shift = camera.shift * vec2(camera.right - camera.left, camera.top - camera.bottom);
  return {camera.type,
          from_world,
          glm::inverse(from_world),
          camera.left - shift.x,
          camera.right - shift.x,
          camera.bottom - shift.y,
          camera.top - shift.y,
          camera.fisheye};
}

namespace {

// A material's programs in Surfaces, by kRays.
using ProgramsByRay = std::array<uint32_t, std::size(kRays)>;

// One commit: fills a Scene step by step, in the order in which the parts need each other.
class Commit {
 public:
  Commit(Scene& scene, const CancelToken& cancel) : scene_(scene), cancel_(cancel) {}

  void add_materials(const std::map<std::string, MaterialDesc>& materials, const ImageMap& images) {
    scene_.surfaces.add_program(default_surface(), "default_surface");  // Cycles' name
    for (const auto& [key, desc] : materials) {
      const std::string& name = desc.name.empty() ? key : desc.name;
      const auto first = first_with_answers(desc.graph);
      auto& programs = program_index_[key];
      for (size_t i = 0; i < programs.size(); ++i) {
        if (first[i] != i) {
          programs[i] = programs[first[i]];
          continue;
        }
        Diagnostics said;
        Program program =
            compile(desc.graph, name, images, said, {SeenTree::Of::Surface, kRays[i]});
        add_new(scene_.diagnostics, said);
        program.sample_emission = desc.sample_emission;
        programs[i] = scene_.surfaces.add_program(std::move(program), name, desc.material_index);
      }
    }
  }

  void add_meshes(const std::map<std::string, std::shared_ptr<MeshItem>>& meshes) {
    for (const auto& [key, item] : meshes) {
      cancel_.throw_if_cancelled();
      mesh_index_[key] = static_cast<uint32_t>(scene_.meshes.size());
      scene_.meshes.push_back(item->mesh(key));
      add_new(scene_.diagnostics, scene_.meshes.back()->diagnostics());
    }
  }

  void add_instances(const std::map<std::string, InstanceDesc>& instances) {
    for (const auto& [key, desc] : instances) {
      const auto mesh = mesh_index_.find(desc.mesh);
      if (mesh == mesh_index_.end()) {
        throw SceneError(key, "mesh", "there is no mesh '" + desc.mesh + "'");
      }
      const std::string& name = desc.name.empty() ? key : desc.name;
      Instance instance;
      instance.name = name;
      instance.light_group = desc.light_group;
      instance.asset = desc.asset;
      instance.mesh = mesh->second;
      instance.to_world = desc.transform;
      instance.visibility = desc.visibility;
      instance.holdout = desc.holdout;
      const float determinant = glm::determinant(mat3(desc.transform));
      if (!is_finite(desc.transform) || !std::isfinite(determinant) || determinant == 0.0f) {
        warn(name, "its transform is flat or not finite; the object is left out");
        continue;
      }
      instance.color = desc.color;
      instance.object_index = desc.object_index;
      instance.random = desc.random;
      instance.normal_to_world = glm::transpose(glm::inverse(mat3(desc.transform)));
      // The same surface for all rays, or one for those that see the same of it.
      std::map<std::vector<uint32_t>, RayMask> by_look;
      for (size_t ray = 0; ray < std::size(kRays); ++ray) {
        by_look[programs_of(key, desc, ray)] |= ray_bit(kRays[ray]);
      }
      const size_t first = scene_.instances.size();
      for (const auto& [programs, rays] : by_look) {
        Instance seen = instance;
        seen.visibility &= rays;
        for (const uint32_t program : programs) {
          seen.materials.push_back(
              scene_.surfaces.bind(program, *scene_.meshes[seen.mesh], desc.attributes));
        }
        add_instance(std::move(seen));
      }
      for (size_t i = first; i < scene_.instances.size(); ++i) {
        scene_.instances[i].first_copy = static_cast<uint32_t>(first);
        scene_.instances[i].copies = static_cast<uint32_t>(scene_.instances.size() - first);
      }
    }
  }

  void set_objects(const CameraDesc& camera) {
    const float pixel =
        pixel_scale(camera.type, camera.fisheye) *
        (camera.pixel_size > 0.0f ? camera.pixel_size : 1e-3f * (camera.top - camera.bottom));
    const bool parallel = camera.type == CameraType::Orthographic;
    scene_.surfaces.set_objects(
        scene_.meshes, scene_.instances, view_of(camera),
        {vec3(camera.transform[3]), parallel ? 0.0f : pixel, parallel ? pixel : 0.0f});
  }

  void build_accel(const Scene* last) {
    scene_.accel = std::make_unique<Accel>(scene_.meshes, scene_.instances, cancel_,
                                           last ? last->accel.get() : nullptr);
  }

  void add_mesh_lights() {
    for (size_t i = 0; i < scene_.instances.size(); ++i) {
      Instance& instance = scene_.instances[i];
      const bool emits =
          std::any_of(instance.materials.begin(), instance.materials.end(),
                      [&](uint32_t p) { return scene_.surfaces.program(p).emits(); });
      if (!emits) {
        continue;
      }
      // Rays find what nobody looks for, or what was dark wherever one looked.
      const bool by_chance =
          std::any_of(instance.materials.begin(), instance.materials.end(), [&](uint32_t p) {
            const Program& program = scene_.surfaces.program(p);
            return program.emits() && (!program.sample_emission || program.varying_emission);
          });
      auto light =
          std::make_unique<MeshLight>(*scene_.accel, scene_.surfaces, *scene_.meshes[instance.mesh],
                                      instance, static_cast<uint32_t>(i));
      if (light->power() > 0.0f || by_chance) {
        instance.light = static_cast<int>(scene_.lights.size());
        light->holdout = instance.holdout;
        light->light_group = instance.light_group;
        scene_.lights.push_back(std::move(light));
      }
    }
  }

  void add_lamps(const std::map<std::string, LightDesc>& lights, const ImageMap& images,
                 const CameraDesc& camera) {
    const LampSurroundings around{view_of(camera), surroundings(),
                                  [&](const LightDesc& lamp) { return surfaces_near(lamp); }};
    for (const auto& [key, desc] : lights) {
      LightDesc lamp = desc;
      if (lamp.name.empty()) {
        lamp.name = key;
      }
      for (auto& light : make_lamp(std::move(lamp), images, around, scene_.diagnostics)) {
        light->light_group = desc.light_group;
        add_light(std::move(light));
      }
    }
  }

  void add_world(const WorldDesc& world, const ImageMap& images, const CameraDesc& camera) {
    for (auto& light :
         make_world(world, images, view_of(camera), surroundings(), scene_.diagnostics, cancel_)) {
      add_light(std::move(light));
    }
  }

  void finish() {
    const auto partial = [](RayMask mask, RayMask of) { return (mask & of) != of; };
    scene_.has_ray_types =
        std::ranges::any_of(scene_.instances,
                            [&](const auto& i) { return partial(i.visibility, kAllRays); }) ||
        std::ranges::any_of(scene_.lights,
                            [&](const auto& l) { return partial(l->visibility, kLabels); });
    scene_.has_unblocked = std::ranges::any_of(
        scene_.lights, [](const auto& l) { return l->shadow_ray == RayType::Unblocked; });
    scene_.has_ray_types = scene_.has_ray_types || scene_.has_unblocked;
    scene_.lamp_index = LampIndex(scene_.lights, scene_.lamps);
    scene_.light_sampler = LightSampler(scene_.lights);
  }

 private:
  void warn(const std::string& object, const std::string& message) {
    scene_.diagnostics.push_back({Severity::Warning, object, "", "", message});
  }

  std::vector<uint32_t> programs_of(const std::string& key, const InstanceDesc& desc,
                                    size_t ray) const {
    std::vector<uint32_t> programs;
    for (const auto& material : desc.materials) {
      programs.push_back(material ? find_program(key, *material)[ray] : 0);
    }
    if (programs.empty()) {
      programs.push_back(0);
    }
    return programs;
  }

  void add_instance(Instance instance) {
    if (instance.visibility == 0) {
      return;
    }
    scene_.has_holdouts = scene_.has_holdouts || instance.holdout;
    for (const uint32_t program : instance.materials) {
      scene_.has_holdouts |= scene_.surfaces.program(program).holds_out();
      instance.opaque = instance.opaque && !scene_.surfaces.program(program).has_transparency();
    }
    scene_.has_transparency = scene_.has_transparency || !instance.opaque;
    scene_.instances.push_back(std::move(instance));
  }

  const ProgramsByRay& find_program(const std::string& instance,
                                    const std::string& material) const {
    const auto it = program_index_.find(material);
    if (it == program_index_.end()) {
      throw SceneError(instance, "materials", "there is no material '" + material + "'");
    }
    return it->second;
  }

  void add_light(std::unique_ptr<Light> light) {
    if (light->hittable()) {
      scene_.lamps.push_back(scene_.lights.size());
    }
    scene_.lights.push_back(std::move(light));
  }

  // Around all surfaces.
  SceneBox surroundings() const { return SceneBox(scene_.accel->bounds()); }

  // Can a surface lie within the lamp's radius?
  bool surfaces_near(const LightDesc& lamp) const {
    const vec3 center(lamp.transform[3]);
    for (const Instance& instance : scene_.instances) {
      const Mesh& mesh = *scene_.meshes[instance.mesh];
      const auto near = [&](const Bounds& bounds) {
        return length2(glm::clamp(center, bounds.lower, bounds.upper) - center) < sqr(lamp.radius);
      };
      if (mesh.triangles().empty() || !near(transformed(mesh.bounds(), instance.to_world))) {
        continue;
      }
      for (const Mesh::Triangle& triangle : mesh.triangles()) {
        Bounds bounds;
        for (const uint32_t v : triangle.v) {
          bounds.extend(vec3(instance.to_world * vec4(mesh.positions()[v], 1.0f)));
        }
        if (near(bounds)) {
          return true;
        }
      }
    }
    return false;
  }

  Scene& scene_;
  const CancelToken& cancel_;
  std::map<std::string, uint32_t> mesh_index_;
  std::map<std::string, ProgramsByRay> program_index_;
};

}  // namespace

void SceneBuilder::remove(const std::string& key) {
  meshes_.erase(key);
  materials_.erase(key);
  images_.erase(key);
  instances_.erase(key);
  lights_.erase(key);
}

std::shared_ptr<const Scene> SceneBuilder::commit(const CancelToken& cancel) const {
  if (!camera_) {
    throw SceneError("camera", "", "the scene has no camera");
  }
  const float window = (camera_->right - camera_->left) * (camera_->top - camera_->bottom);
  const float volume = glm::determinant(mat3(camera_->transform));
  const auto usable = [](float x) { return std::isfinite(x) && x != 0.0f; };
  if (!is_finite(camera_->transform) || !usable(volume) || !usable(window)) {
    throw SceneError(camera_->name, "camera", "its transform or its window is degenerate");
  }
  if (!(camera_->clip_end > camera_->clip_start) || !(camera_->clip_start >= 0.0f)) {
    throw SceneError(camera_->name, "camera", "its clipping range is empty");
  }
  const CameraView view = view_of(*camera_);
  if (camera_->type == CameraType::Equirectangular &&
      !(std::max(std::abs(view.bottom), std::abs(view.top)) <= 1.0001f * 0.5f * kPi)) {
    throw SceneError(camera_->name, "camera", "its latitudes go beyond the poles");
  }
  if (is_panorama(camera_->type) && !usable_fisheye(camera_->fisheye)) {
    throw SceneError(camera_->name, "camera", "its fisheye sees nothing, or without end");
  }
  if (!(camera_->aperture_radius >= 0.0f) || !std::isfinite(camera_->aperture_radius) ||
      !(camera_->focus_distance >= 0.0f) || !std::isfinite(camera_->focus_distance) ||
      !(camera_->aperture_ratio > 0.0f) || !std::isfinite(camera_->aperture_rotation)) {
    throw SceneError(camera_->name, "camera", "its lens is not a lens");
  }
  auto scene = std::make_shared<Scene>();
  scene->camera = *camera_;
  Commit commit(*scene, cancel);
  commit.add_materials(materials_, images_);
  commit.add_meshes(meshes_);
  commit.add_instances(instances_);
  commit.set_objects(*camera_);
  std::shared_ptr<const Scene> last;
  {
    const std::lock_guard lock(last_->mutex);
    last = last_->scene.lock();
  }
  commit.build_accel(last.get());
  commit.add_mesh_lights();
  commit.add_lamps(lights_, images_, *camera_);
  if (world_) {
    commit.add_world(*world_, images_, *camera_);
  }
  commit.finish();
  const std::lock_guard lock(last_->mutex);
  last_->scene = scene;
  return scene;
}

}  // namespace janus
