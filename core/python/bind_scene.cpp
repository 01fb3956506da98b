// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>

#include "bind_arrays.h"
#include "janus/render/commit_task.h"
#include "janus/shading/compiler.h"

namespace janus::python {

namespace {

using namespace py::literals;
using Numbers = std::vector<float>;

constexpr EnumName<LightType> kLightTypes[] = {{"POINT", LightType::Point},
                                               {"SPOT", LightType::Spot},
                                               {"SUN", LightType::Sun},
                                               {"AREA", LightType::Area}};
constexpr EnumName<AreaShape> kAreaShapes[] = {{"SQUARE", AreaShape::Square},
                                               {"RECTANGLE", AreaShape::Rectangle},
                                               {"DISK", AreaShape::Disk},
                                               {"ELLIPSE", AreaShape::Ellipse}};
constexpr py::ssize_t kMaxImageSide = 1 << 16;
constexpr double kPollSeconds = 0.05;
constexpr EnumName<CameraType> kCameraTypes[] = {
    {"PERSP", CameraType::Perspective},
    {"ORTHO", CameraType::Orthographic},
    {"EQUIRECTANGULAR", CameraType::Equirectangular},
    {"FISHEYE_EQUIDISTANT", CameraType::FisheyeEquidistant},
    {"FISHEYE_EQUISOLID", CameraType::FisheyeEquisolid},
    {"FISHEYE_LENS_POLYNOMIAL", CameraType::FisheyeLensPolynomial},
    {"MIRRORBALL", CameraType::MirrorBall},
    {"EQUIANGULAR_CUBEMAP_FACE", CameraType::EquiangularCubemapFace},
    {"CENTRAL_CYLINDRICAL", CameraType::CentralCylindrical}};
constexpr EnumName<Severity> kSeverities[] = {
    {"INFO", Severity::Info}, {"WARNING", Severity::Warning}, {"ERROR", Severity::Error}};

// The rays that meet something, from Blender's five settings.
RayMask to_mask(bool camera, bool diffuse, bool glossy, bool transmission, bool shadow = true) {
  RayMask mask = 0;
  for (const auto& [visible, type] : {std::pair(camera, RayType::Camera),
                                      {diffuse, RayType::Diffuse},
                                      {glossy, RayType::Glossy},
                                      {transmission, RayType::Transmission},
                                      {shadow, RayType::Shadow}}) {
    mask |= visible ? ray_bit(type) : 0;
  }
  return mask;
}

LinkMask to_link_mask(Key key, const char* path, const std::vector<int>& sets, int most) {
  LinkMask mask = 0;
  for (const int set : sets) {
    if (set < 0 || set >= most) {
      const std::string count = std::to_string(most);
      throw SceneError(key, path, "must be a set of lights, from 0, of which there are " + count);
    }
    mask |= link_bit(set);
  }
  return mask;
}

EmitterLinks to_links(Key key, int receiver_set, int blocker_set) {
  to_link_mask(key, "receiver_set", {std::max(receiver_set, 0)}, kMostLinkSets);
  to_link_mask(key, "blocker_set", {std::max(blocker_set, 0)}, kMostShadowSets);
  return {receiver_set, blocker_set};
}

// --- Builder
// --------------------------------------------------------------------------------------

void set_image(SceneBuilder& self, Key key, std::string name, const py::object& pixels, bool srgb,
               bool associated) {
  const py::array a = to_array(pixels);
  const char kind = a.dtype().kind();
  if (kind != 'f' && kind != 'i' && kind != 'u') {
    throw SceneError(key, "pixels", "must hold numbers");
  }
  if (a.ndim() != 3 || a.shape(2) < 3 || a.shape(2) > 4 || a.size() == 0 ||
      a.shape(0) > kMaxImageSide || a.shape(1) > kMaxImageSide) {
    throw SceneError(key, "pixels",
                     "the shape must be (height, width, 3 or 4), not " + shape_of(a));
  }
  const auto values = converted<float>(a);
  auto image = std::make_shared<Image>();
  image->height = static_cast<int>(a.shape(0));
  image->width = static_cast<int>(a.shape(1));
  image->channels = static_cast<int>(a.shape(2));
  image->pixels.assign(values.data(), values.data() + values.size());
  image->pack();
  self.set_image(key, {std::move(name), std::move(image), srgb, associated});
}

void set_light(SceneBuilder& self, Key key, std::string name, const std::string& type,
               const py::object& transform, const std::array<float, 3>& color, float energy,
               float radius, bool soft_falloff, const std::string& shape, float size, float size_y,
               float spread, float spot_size, float spot_blend, bool spot_square, float angle,
               bool normalize, float exposure, bool visible_camera, bool visible_diffuse,
               bool visible_glossy, bool visible_transmission, bool cast_shadow, int max_bounces,
               const std::optional<py::dict>& graph, std::string light_group, int receiver_set,
               int blocker_set, bool lights_catchers) {
  LightDesc desc;
  desc.lights_catchers = lights_catchers;
  desc.links = to_links(key, receiver_set, blocker_set);
  desc.light_group = std::move(light_group);
  desc.name = std::move(name);
  desc.type = from_name(kLightTypes, type, "light type");
  desc.transform = to_matrix(key, transform);
  desc.color = Rgb(color[0], color[1], color[2]);
  desc.energy = energy;
  desc.exposure = exposure;
  desc.normalize = normalize;
  desc.radius = radius;
  desc.soft_falloff = soft_falloff;
  desc.shape = from_name(kAreaShapes, shape, "area shape");
  desc.size = size;
  desc.size_y = size_y;
  desc.spread = spread;
  desc.angle = angle;
  desc.spot_size = spot_size;
  desc.spot_blend = spot_blend;
  desc.spot_square = spot_square;
  desc.visibility = to_mask(visible_camera, visible_diffuse, visible_glossy, visible_transmission);
  desc.cast_shadow = cast_shadow;
  if (max_bounces < 0) {
    throw SceneError(key, "max_bounces", "must be at least 0");
  }
  desc.max_bounces = std::min(max_bounces, 1024);
  if (graph) {
    desc.graph = to_graph(key, *graph);
  }
  self.set_light(key, std::move(desc));
}

void set_camera(SceneBuilder& self, std::string name, const std::string& type,
                const py::object& transform, const std::array<float, 4>& window, float clip_start,
                float clip_end, float aperture_radius, float focus_distance, int aperture_blades,
                float aperture_rotation, float aperture_ratio, float pixel_size,
                const std::array<float, 2>& shift, float fisheye_fov, float fisheye_lens,
                const std::array<float, 5>& fisheye_polynomial) {
  CameraDesc desc;
  desc.type = from_name(kCameraTypes, type, "camera type");
  desc.transform = to_matrix(name, transform);
  desc.name = std::move(name);
  desc.left = window[0];
  desc.right = window[1];
  desc.bottom = window[2];
  desc.top = window[3];
  desc.clip_start = clip_start;
  desc.clip_end = clip_end;
  desc.aperture_radius = aperture_radius;
  desc.focus_distance = focus_distance;
  desc.aperture_blades = aperture_blades;
  desc.aperture_rotation = aperture_rotation;
  desc.aperture_ratio = aperture_ratio;
  desc.pixel_size = pixel_size;
  desc.shift = vec2(shift[0], shift[1]);
  desc.fisheye = {fisheye_fov, fisheye_lens, fisheye_polynomial};
  self.set_camera(std::move(desc));
}

// `poll`, which may call into Blender, runs in the thread that called, with the GIL; everybody else
// gets the GIL in between.
std::shared_ptr<const Scene> commit(const SceneBuilder& self, const py::object& poll) {
  std::optional<CommitTask> task;
  task.emplace(self);
  try {
    while (!wait_slices([&](double seconds) { return task->wait(seconds); }, kPollSeconds)) {
      if (!poll.is_none() && py::bool_(poll())) {
        task->cancel();
      }
    }
  } catch (...) {
    const py::gil_scoped_release release;
    task.reset();
    throw;
  }
  return task->scene();
}

py::dict counts(const Scene& scene) {
  size_t triangles = 0, round = 0;
  for (const Instance& instance : scene.instances) {
    const Shape& shape = *scene.shapes[instance.shape];
    (shape.mesh() ? triangles : round) += shape.primitives();
  }
  py::dict result;
  result["meshes"] = scene.shapes.size();
  result["instances"] = scene.instances.size();
  result["triangles"] = triangles;
  result["round"] = round;
  result["materials"] = scene.surfaces.size() - 1;  // without the default surface
  result["lights"] = scene.lights.size();
  result["meshes_built"] = scene.accel->built();
  result["shadow_catchers"] =
      scene.catchers_alone ? scene.catchers_alone->instances.size() : size_t{0};
  return result;
}

void bind_diagnostic(py::module_& m) {
  py::class_<Diagnostic>(m, "Diagnostic",
                         "A recoverable finding; empty strings mean 'does not apply'.")
      .def_property_readonly(
          "severity", [](const Diagnostic& d) { return to_name(kSeverities, d.severity); },
          "INFO, WARNING or ERROR.")
      .def_readonly("object", &Diagnostic::object, "Name of the object.")
      .def_readonly("material", &Diagnostic::material, "Name of the material, light or world.")
      .def_readonly("node", &Diagnostic::node, "Name of the shader node.")
      .def_readonly("message", &Diagnostic::message, "What is not as asked.")
      .def("__repr__", [](const Diagnostic& d) {
        return py::str("Diagnostic({!r}, object={!r}, material={!r}, node={!r}, message={!r})")
            .format(to_name(kSeverities, d.severity), d.object, d.material, d.node, d.message);
      });
}

}  // namespace

void bind_scene(py::module_& m) {
  bind_diagnostic(m);

  py::class_<Scene, std::shared_ptr<Scene>>(
      m, "Scene", "A committed scene: immutable, may be shared by sessions and threads.")
      .def_property_readonly(
          "diagnostics", [](const Scene& s) { return s.diagnostics; },
          "What could not be rendered as asked: list of Diagnostic.")
      .def_property_readonly("counts", &counts,
                             "Numbers of meshes, instances, triangles (with instances), materials, "
                             "lights (sources with their own sampling), meshes_built: those that "
                             "are not shared with the scene before, and shadow_catchers, if the "
                             "camera may see some.");

  // release_gil_before_calling_cpp_dtor: the destructor waits for the thread.
  py::class_<CommitTask>(m, "CommitTask", py::release_gil_before_calling_cpp_dtor(),
                         "A commit on a thread of its own. Dropping it cancels it.")
      .def(
          "wait",
          [](CommitTask& self, double seconds) {
            return wait_slices([&](double s) { return self.wait(s); }, seconds);
          },
          "seconds"_a, "Waits up to `seconds` for the end, without the GIL; True if it has come.")
      .def("cancel", &CommitTask::cancel, "Asks it to stop and returns.")
      .def("scene", &CommitTask::scene, py::call_guard<py::gil_scoped_release>(),
           "Waits for the end. Raises SceneError, or Cancelled if it was cancelled.");

  py::class_<SceneBuilder> builder(
      m, "SceneBuilder",
      "Collects a scene description. Keys are the caller's; setting a key "
      "again replaces the item. Lengths in metres, matrices as in Blender.");
  bind_mesh(builder);
  bind_motion(builder);
  builder.def(py::init<>())
      .def(
          "set_material",
          [](SceneBuilder& self, Key key, std::string name, const py::dict& graph,
             bool sample_emission, float material_index, const std::optional<py::dict>& aovs) {
            MaterialDesc desc{std::move(name), to_graph(key, graph), sample_emission,
                              material_index};
            std::vector<std::string> attributes = required_attributes(desc.graph);
            if (aovs) {
              desc.aovs = to_graph(key, *aovs);
              for (std::string& attribute : attributes_of_aovs(desc.aovs)) {
                if (std::ranges::find(attributes, attribute) == attributes.end()) {
                  attributes.push_back(std::move(attribute));
                }
              }
            }
            self.set_material(key, std::move(desc));
            return attributes;
          },
          "key"_a, py::kw_only(), "name"_a, "graph"_a, "sample_emission"_a = true,
          "material_index"_a = 0.0f, "aovs"_a = py::none(),
          "A surface, as a flattened node tree: {'nodes': [{'name', 'type', 'inputs', "
          "'properties'}], 'surface': {'link': [node, output]} or None, 'displacement': likewise, "
          "by which it is bumped}; aovs: likewise a tree that ends in OUTPUT_AOV nodes, with the "
          "property aov_name. Returns the keys of the attributes that they read. Of a mesh: "
          "'generated', 'normal', 'color:', 'uv:NAME', "
          "'tangent:NAME', 'tangent_sign:NAME' (no name: the active one), 'attribute:NAME', "
          "'pointiness', 'random_per_island'; of points 'point_radius'. Of an instance: "
          "'object:NAME', 'instancer:NAME', 'dupli_generated', 'dupli_uv', 'particle:times' (index "
          "and age), 'particle:lifetime', 'particle:size', 'particle:location', "
          "'particle:velocity', 'particle:angular_velocity'.")
      .def(
          "set_image", &set_image, "key"_a, py::kw_only(), "name"_a, "pixels"_a, "srgb"_a = false,
          "associated"_a = false,
          "A picture for texture nodes whose property 'image' is this key: float[H,W,3 or 4], the "
          "bottom row first, scene-linear Rec.709 unless srgb; associated: multiplied by alpha, as "
          "they are encoded. Copied.")
      .def(
          "set_instance",
          [](SceneBuilder& self, Key key, std::string name, std::string mesh,
             const py::object& transform, std::vector<std::optional<std::string>> materials,
             bool camera, bool diffuse, bool glossy, bool transmission, bool shadow, bool holdout,
             const std::array<float, 4>& color, float object_index, float random,
             const std::map<std::string, std::array<float, 4>>& attributes, std::string light_group,
             std::string asset, int receiver_set, int blocker_set, const std::vector<int>& unlit_by,
             const std::vector<int>& lets_pass, bool shadow_catcher) {
            InstanceDesc desc{std::move(name),
                              std::move(mesh),
                              to_matrix(key, transform),
                              std::move(materials),
                              to_mask(camera, diffuse, glossy, transmission, shadow),
                              holdout,
                              shadow_catcher,
                              vec4(color[0], color[1], color[2], color[3]),
                              object_index,
                              random,
                              {},
                              std::move(light_group),
                              std::move(asset)};
            desc.emitter = to_links(key, receiver_set, blocker_set);
            desc.receiver = {to_link_mask(key, "unlit_by", unlit_by, kMostLinkSets),
                             to_link_mask(key, "lets_pass", lets_pass, kMostShadowSets)};
            for (const auto& [name, v] : attributes) {
              desc.attributes[name] = vec4(v[0], v[1], v[2], v[3]);
            }
            self.set_instance(key, std::move(desc));
          },
          "key"_a, py::kw_only(), "name"_a, "mesh"_a, "transform"_a,
          "materials"_a = std::vector<std::optional<std::string>>(), "visible_camera"_a = true,
          "visible_diffuse"_a = true, "visible_glossy"_a = true, "visible_transmission"_a = true,
          "visible_shadow"_a = true, "holdout"_a = false,
          "color"_a = std::array{1.0f, 1.0f, 1.0f, 1.0f}, "object_index"_a = 0.0f,
          "random"_a = 0.0f, "attributes"_a = std::map<std::string, std::array<float, 4>>(),
          "light_group"_a = "", "asset"_a = "", "receiver_set"_a = -1, "blocker_set"_a = -1,
          "unlit_by"_a = std::vector<int>(), "lets_pass"_a = std::vector<int>(),
          "shadow_catcher"_a = false,
          "Places mesh `mesh` (a key) in the world; materials: a key or None for each slot; "
          "visible_*: the rays that meet it; holdout: leaves a hole in the picture where the "
          "camera "
          "sees it; attributes: four numbers under each key (see set_material()); light_group: "
          "of what it emits; asset: the name of what it is a part of, for Cryptomatte; "
          "receiver_set, "
          "blocker_set: numbers of the sets of lights that it is in as a light, which shine on "
          "some "
          "things only, and are blocked by some only (-1: none); unlit_by, lets_pass: those that "
          "do "
          "not shine on it, and that it is not in the way of; shadow_catcher: part of the footage "
          "that the picture is laid over, which shows only what is done to its light; the rest is "
          "what the Object Info node says.")
      .def("set_light", &set_light, "key"_a, py::kw_only(), "name"_a, "type"_a, "transform"_a,
           "color"_a = std::array{1.0f, 1.0f, 1.0f}, "energy"_a = 10.0f, "radius"_a = 0.0f,
           "soft_falloff"_a = true, "shape"_a = "SQUARE", "size"_a = 0.25f, "size_y"_a = 0.25f,
           "spread"_a = kPi, "spot_size"_a = 0.785398f, "spot_blend"_a = 0.15f,
           "spot_square"_a = false, "angle"_a = 0.0f, "normalize"_a = true, "exposure"_a = 0.0f,
           "visible_camera"_a = true, "visible_diffuse"_a = true, "visible_glossy"_a = true,
           "visible_transmission"_a = true, "cast_shadow"_a = true, "max_bounces"_a = 1024,
           "graph"_a = py::none(), "light_group"_a = "", "receiver_set"_a = -1,
           "blocker_set"_a = -1, "lights_catchers"_a = true,
           "A light object, in Blender's words and units: type POINT, SPOT, SUN or AREA; energy in "
           "watts (sun: W/m^2); angles in radians; shape SQUARE, RECTANGLE, DISK or ELLIPSE; sets "
           "as in set_instance(); lights_catchers: it is part of the footage (shadow_catcher "
           "there).")
      .def(
          "set_world",
          [](SceneBuilder& self, std::string name, const std::optional<py::dict>& graph,
             bool camera, bool diffuse, bool glossy, bool transmission, std::string light_group,
             const std::optional<py::dict>& aovs) {
            WorldDesc desc;
            desc.light_group = std::move(light_group);
            desc.visibility = to_mask(camera, diffuse, glossy, transmission);
            if (graph) {
              desc.graph = to_graph(name, *graph);
            }
            if (aovs) {
              desc.aovs = to_graph(name, *aovs);
            }
            desc.name = std::move(name);
            self.set_world(std::move(desc));
          },
          py::kw_only(), "name"_a, "graph"_a, "visible_camera"_a = true, "visible_diffuse"_a = true,
          "visible_glossy"_a = true, "visible_transmission"_a = true, "light_group"_a = "",
          "aovs"_a = py::none(), "The background; graph None: black; aovs as in set_material().")
      .def(
          "set_camera", &set_camera, py::kw_only(), "name"_a, "type"_a = "PERSP", "transform"_a,
          "window"_a, "clip_start"_a = 0.1f, "clip_end"_a = 1000.0f, "aperture_radius"_a = 0.0f,
          "focus_distance"_a = 10.0f, "aperture_blades"_a = 0, "aperture_rotation"_a = 0.0f,
          "aperture_ratio"_a = 1.0f, "pixel_size"_a = 0.0f, "shift"_a = std::array{0.0f, 0.0f},
          "fisheye_fov"_a = FisheyeDesc().fov, "fisheye_lens"_a = FisheyeDesc().lens,
          "fisheye_polynomial"_a = FisheyeDesc().polynomial,
          "A camera that looks along its -z: PERSP, ORTHO or one of Cycles' panoramas. window: "
          "left, right, bottom, top of the full frame: on the plane at distance 1, in metres, or "
          "on the film of a panorama, see janus_core. aperture_radius in metres; 0: no depth of "
          "field. pixel_size: height of a pixel in units of the window, for bump; 0: a thousandth "
          "of it. shift: that the window has had, in widths and heights of it, if it is a "
          "panorama's. fisheye_fov in radians, fisheye_lens in millimetres, fisheye_polynomial: K0 "
          "to K4.")
      .def("remove", &SceneBuilder::remove, "key"_a, "Forgets a key; unknown keys are ignored.")
      .def(
          "commit", &commit, "poll"_a = py::none(),
          "Builds the immutable Scene without holding the GIL. poll() is called about every 50 ms "
          "in this thread; True cancels. Raises SceneError, Cancelled, or what poll raised. Meshes "
          "set before the last commit are shared with its Scene, if that is still in use.")
      .def(
          "start_commit",
          [](const SceneBuilder& self) { return std::make_unique<CommitTask>(self); },
          "The same on a thread of its own, without poll. The builder may be changed meanwhile.");
}

}  // namespace janus::python
