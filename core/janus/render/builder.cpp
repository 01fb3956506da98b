// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/render/builder.h"

#include <algorithm>

#include "janus/light/dark_light.h"
#include "janus/render/camera_checks.h"
#include "janus/render/lamp.h"
#include "janus/render/onlookers.h"
#include "janus/render/surroundings.h"
#include "janus/render/time_slice.h"
#include "janus/render/world.h"
#include "janus/shading/compiler.h"

namespace janus {

namespace {

constexpr const char* kFibersOnMesh =
    "its closures of hair are made for hair; on a mesh they may look otherwise than in Cycles";

// A material's programs in Surfaces, by kRays.
using ProgramsByRay = std::array<uint32_t, std::size(kRays)>;

// One commit: fills a Scene step by step, in the order in which the parts need each other.
class Commit {
 public:
  // `scene.whole`: of a scene of shadow catchers alone.
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
      const auto camera = std::ranges::find(kRays, RayType::Camera) - std::begin(kRays);
      add_aovs(desc.aovs, name, images, SeenTree::Of::Surface, [&](Program program) {
        scene_.surfaces.add_aovs(programs[camera], std::move(program));
      });
    }
  }

  void add_shapes(const std::map<std::string, std::shared_ptr<ShapeItem>>& shapes) {
    for (const auto& [key, item] : shapes) {
      cancel_.throw_if_cancelled();
      shape_index_[key] = static_cast<uint32_t>(scene_.shapes.size());
      scene_.shapes.push_back(item->shape(key));
      add_new(scene_.diagnostics, scene_.shapes.back()->diagnostics());
    }
  }

  void add_instances(const std::map<std::string, InstanceDesc>& instances) {
    for (const auto& [key, desc] : instances) {
      const auto shape = shape_index_.find(desc.mesh);
      if (shape == shape_index_.end()) {
        throw SceneError(key, "mesh", "there is no mesh '" + desc.mesh + "'");
      }
      if (scene_.whole && !desc.shadow_catcher) {
        continue;
      }
      const std::string& name = desc.name.empty() ? key : desc.name;
      const auto names =
          std::make_shared<const Instance::Names>(name, desc.light_group, desc.asset);
      Instance instance;
      instance.names = names_.try_emplace(*names, names).first->second;
      instance.shape = shape->second;
      instance.to_world = desc.transform;
      instance.visibility = desc.visibility;
      instance.holdout = desc.holdout;
      instance.catcher = desc.shadow_catcher && !desc.holdout;
      instance.emitter = desc.emitter;
      instance.unlit_by = desc.receiver.unlit_by;
      if (!is_placement(desc.transform)) {
        warn(name, "its transform is flat or not finite; the object is left out");
        continue;
      }
      instance.color = desc.color;
      instance.object_index = desc.object_index;
      instance.random = desc.random;
      instance.motion = motion_of(name, desc.motion);
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
        add_shadow_types(seen, desc.receiver);
        for (const uint32_t program : programs) {
          seen.materials.push_back(
              scene_.surfaces.bind(program, *scene_.shapes[seen.shape], desc.attributes));
        }
        if (fibers_on_mesh(seen)) {
          add_new(scene_.diagnostics, {{Severity::Warning, name, "", "", kFibersOnMesh}});
        }
        add_instance(std::move(seen));
      }
      for (size_t i = first; i < scene_.instances.size(); ++i) {
        scene_.instances[i].first_copy = static_cast<uint32_t>(first);
        scene_.instances[i].copies = static_cast<uint32_t>(scene_.instances.size() - first);
      }
    }
  }

  void build_accel(const Scene* last) {
    scene_.accel = std::make_shared<const Accel>(scene_.shapes, scene_.instances, cancel_,
                                                 last ? last->accel.get() : nullptr);
    scene_.surroundings = scene_.whole ? scene_.whole->surroundings : surroundings(scene_);
  }

  void add_mesh_lights() {
    if (scene_.whole) {
      add_dark_mesh_lights();
    }
    for (size_t i = 0; i < scene_.instances.size(); ++i) {
      Instance& instance = scene_.instances[i];
      const bool emits =
          std::any_of(instance.materials.begin(), instance.materials.end(),
                      [&](uint32_t p) { return scene_.surfaces.program(p).emits(); });
      if (!emits) {
        continue;
      }
      const Shape& shape = *scene_.shapes[instance.shape];
      // Rays find what nobody looks for, or what was dark wherever one looked.
      const bool by_chance =
          shape.round() ||
          std::any_of(instance.materials.begin(), instance.materials.end(), [&](uint32_t p) {
            const Program& program = scene_.surfaces.program(p);
            return program.emits() && (!program.sample_emission || program.varying_emission);
          });
      auto light = std::make_unique<MeshLight>(*scene_.accel, scene_.surfaces, shape, instance,
                                               static_cast<uint32_t>(i));
      if (light->power() > 0.0f || by_chance) {
        instance.light = static_cast<int>(scene_.lights.size());
        scene_.lights.push_back(std::move(light));
      }
    }
  }

  void add_lamps(const std::map<std::string, LightDesc>& lights, const ImageMap& images,
                 const CameraDesc& camera) {
    const LampSurroundings around{
        view_of(camera), SceneBox(scene_.surroundings),
        [&](const LightDesc& lamp) { return surfaces_near(scene_, lamp); }};
    for (const auto& [key, desc] : lights) {
      const bool shines = !scene_.whole || desc.lights_catchers;
      LightDesc lamp = desc;
      if (lamp.name.empty()) {
        lamp.name = key;
      }
      Scene::Lamp described{lamp, scene_.lights.size()};
      described.desc.graph.reset();
      for (auto& light : make_lamp(std::move(lamp), images, around, scene_.diagnostics)) {
        light->light_group = desc.light_group;
        add_light(shines ? std::move(light) : std::make_unique<DarkLight>(std::move(light)));
      }
      described.count = scene_.lights.size() - described.first_light;
      scene_.described_lamps.push_back(std::move(described));
    }
  }

  void add_world(const WorldDesc& world, const ImageMap& images, const CameraDesc& camera) {
    for (auto& light : make_world(world, images, view_of(camera), SceneBox(scene_.surroundings),
                                  scene_.diagnostics, cancel_)) {
      add_light(std::move(light));
    }
    if (contains(world.visibility, RayType::Camera)) {
      add_aovs(world.aovs, world.name, images, SeenTree::Of::World, [&](Program program) {
        scene_.world_aovs = std::make_shared<const Program>(std::move(program));
      });
    }
  }

  void finish() {
    const auto partial = [](RayMask mask, RayMask of) { return (mask & of) != of; };
    scene_.has_ray_types =
        std::ranges::any_of(scene_.instances,
                            [&](const auto& i) { return partial(i.visibility, kAllRays); }) ||
        std::ranges::any_of(scene_.lights,
                            [&](const auto& l) { return partial(l->visibility, kLabels); });
    for (const Instance& instance : scene_.instances) {
      for (const uint32_t surface : instance.materials) {
        const Program& program = scene_.surfaces.program(surface);
        scene_.has_by_path |= program.by_path;
        scene_.has_path_crossings |= program.by_path && program.has_transparency();
      }
    }
    for (const auto& light : scene_.lights) {
      scene_.has_by_path |= light->by_path;
      scene_.shadow_types |= ray_bit(light->shadow_ray);
      scene_.has_links = scene_.has_links || light->link_set >= 0;
    }
    scene_.has_own_shadows = (scene_.shadow_types & ~ray_bit(RayType::Shadow)) != 0;
    scene_.has_ray_types = scene_.has_ray_types || scene_.has_own_shadows;
    scene_.lamp_index = LampIndex(scene_.lights, scene_.lamps);
    scene_.light_sampler = LightSampler(scene_.lights);
  }

 private:
  // Those of the whole scene that are not in this one.
  void add_dark_mesh_lights() {
    for (const Instance& instance : scene_.whole->instances) {
      if (instance.light >= 0 && !instance.catcher) {
        const auto& light = scene_.whole->lights[static_cast<size_t>(instance.light)];
        scene_.lights.push_back(std::make_shared<const DarkLight>(light));
      }
    }
  }

  void warn(const std::string& object, const std::string& message) {
    scene_.diagnostics.push_back({Severity::Warning, object, "", "", message});
  }

  // Does some triangle have closures of hair? The hair that grows on a mesh shares its slots.
  bool fibers_on_mesh(const Instance& instance) const {
    const auto fibers = [&](uint32_t p) { return scene_.surfaces.program(p).fibers; };
    const Mesh* mesh = scene_.shapes[instance.shape]->mesh();
    return mesh && std::ranges::any_of(instance.materials, fibers) &&
           std::ranges::any_of(mesh->triangles(), [&](const Mesh::Triangle& triangle) {
             return fibers(instance.material(triangle.material));
           });
  }

  // add(program): of the AOVs that the camera sees, if there are any.
  template <class Add>
  void add_aovs(const NodeGraph& graph, const std::string& name, const ImageMap& images,
                SeenTree::Of of, Add&& add) {
    if (!graph.nodes.empty()) {
      Diagnostics said;
      add(compile_aovs(graph, name, images, scene_.aov_names, said, {of, RayType::Camera}));
      add_new(scene_.diagnostics, said);
    }
  }

  // What stands in the way of a light's shadow rays of their own type.
  static void add_shadow_types(Instance& instance, const ReceiverLinks& links) {
    if (!contains(instance.visibility, RayType::Shadow)) {
      return;
    }
    for (int set = 0; set < kMostShadowSets; ++set) {
      const bool passes = (links.lets_pass & link_bit(set)) != 0;
      instance.visibility |= passes ? 0 : ray_bit(shadow_ray_of(set));
    }
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
    scene_.has_clear_catchers |= instance.catcher && !instance.opaque;
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

  // Null: it stands still.
  std::shared_ptr<const Motion> motion_of(const std::string& name, const std::vector<mat4>& keys) {
    if (keys.size() < 2) {
      return nullptr;
    }
    if (!std::ranges::all_of(keys, [](const mat4& key) { return is_placement(key); })) {
      warn(name, "its transform is flat or not finite while the shutter is open; it stands still");
      return nullptr;
    }
    return std::make_shared<const Motion>(keys);
  }

  Scene& scene_;
  const CancelToken& cancel_;
  std::map<std::string, uint32_t> shape_index_;
  std::map<Instance::Names, std::shared_ptr<const Instance::Names>> names_;
  std::map<std::string, ProgramsByRay> program_index_;
};

}  // namespace

void SceneBuilder::set_mesh_motion(const std::string& key, std::vector<MeshKey> motion) {
  const auto mesh = shapes_.find(key);
  if (mesh == shapes_.end()) {
    throw SceneError(key, "motion", "there is no such mesh");
  }
  mesh->second->set_motion(key, std::move(motion));
}

void SceneBuilder::set_instance_motion(const std::string& key, std::vector<mat4> motion) {
  const auto instance = instances_.find(key);
  if (instance == instances_.end()) {
    throw SceneError(key, "motion", "there is no such instance");
  }
  instance->second.motion = std::move(motion);
}

void SceneBuilder::set_camera_motion(std::vector<CameraDesc::Key> motion) {
  if (!camera_) {
    throw SceneError("camera", "motion", "the scene has no camera");
  }
  camera_->motion = std::move(motion);
}

void SceneBuilder::set_shutter(std::vector<float> shutter) {
  if (!camera_) {
    throw SceneError("camera", "shutter", "the scene has no camera");
  }
  camera_->shutter = std::move(shutter);
}

void SceneBuilder::remove(const std::string& key) {
  shapes_.erase(key);
  materials_.erase(key);
  images_.erase(key);
  instances_.erase(key);
  lights_.erase(key);
}

std::shared_ptr<const Scene> SceneBuilder::commit(const CancelToken& cancel) const {
  if (!camera_) {
    throw SceneError("camera", "", "the scene has no camera");
  }
  check_camera(*camera_);
  std::shared_ptr<const Scene> last;
  {
    const std::lock_guard lock(last_->mutex);
    last = last_->scene.lock();
  }
  const std::shared_ptr<Scene> scene = make(last.get(), nullptr, cancel);
  const auto seen = [](const Instance& i) {
    return i.catcher && contains(i.visibility, RayType::Camera);
  };
  if (std::ranges::any_of(scene->instances, seen)) {
    scene->catchers_alone = make(scene.get(), scene.get(), cancel);
  }
  const std::lock_guard lock(last_->mutex);
  last_->scene = scene;
  return scene;
}

std::shared_ptr<Scene> SceneBuilder::make(const Scene* last, const Scene* whole,
                                          const CancelToken& cancel) const {
  auto scene = std::make_shared<Scene>();
  scene->camera = *camera_;
  scene->whole = whole;
  Commit commit(*scene, cancel);
  commit.add_materials(materials_, images_);
  commit.add_shapes(shapes_);
  commit.add_instances(instances_);
  scene->place_objects();
  commit.build_accel(last);
  commit.add_mesh_lights();
  commit.add_lamps(lights_, images_, *camera_);
  if (world_) {
    commit.add_world(*world_, images_, *camera_);
  }
  commit.finish();
  return scene;
}

}  // namespace janus
