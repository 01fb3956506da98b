// SPDX-License-Identifier: GPL-3.0-or-later
//
// One scene for each kind of light, for tests that hold for all of them. The light is the scene's
// first; the receiver, a square of side 1 at the origin with normal +z, is not part of the scene.
#pragma once

#include "janus/render/under_projector.h"
#include "support/scene_kit.h"
#include "support/statistics.h"

namespace janus::test {

inline constexpr double kPiD = 3.14159265358979;

struct LightCase {
  std::string name;
  SceneKit (*make)();
  double watts = 0;      // emitted; 0: not compared
  bool hittable = true;  // false: a point or a single direction
  bool nee = true;       // false: the world of one colour
  bool whole = true;     // shines over all of its surface towards the receiver
  // Projected area from which the light sends rays in a direction; null: not compared.
  double (*projected)(vec3) = nullptr;
  bool projector = false;  // the lamp as a projector of 8 x 4 pixels

  std::shared_ptr<const Scene> scene() const {
    const auto built = make().build();
    return projector ? under_projector(built, find_projector(*built, "lamp", 8, 4)) : built;
  }
};

inline std::ostream& operator<<(std::ostream& out, const LightCase& c) { return out << c.name; }

inline SceneKit lamp(LightDesc desc) { return SceneKit().light("lamp", std::move(desc)); }

inline mat4 sheared(int column, int row, float by) {
  mat4 m(1);
  m[column][row] = by;
  return m;
}

inline LightDesc shaped(AreaShape shape, const mat4& deform = mat4(1), float spread = kPi) {
  LightDesc desc = area_light({0.3f, -0.2f, 1.2f}, {0, 0, 0}, 0.6f, 7, spread);
  desc.shape = shape;
  desc.size_y = 0.3f;
  desc.transform = desc.transform * deform;
  return desc;
}

// `area` of the light before it is deformed.
inline double facing(const LightDesc& desc, double area, vec3 direction) {
  const vec3 plane = cross(vec3(desc.transform[0]), vec3(desc.transform[1]));
  return area * std::abs(dot(plane, direction));
}

inline LightDesc spot(float radius, bool soft, const mat4& deform = mat4(1)) {
  LightDesc desc = spot_light({0.3f, -0.2f, 1.2f}, {0.1f, 0, 0}, 7, 0.9f, 0.4f, radius, soft);
  desc.transform = desc.transform * deform;
  return desc;
}

// The share of a spot's watts that it emits: smoothstep over 1 - cos has the mean 1/2.
inline double beam(double size, double blend) {
  return 0.5 * (1 - std::cos(0.5 * size)) * (1 - 0.5 * blend);
}

// With a tree that depends on the direction and on the place.
inline LightDesc by_nodes(LightDesc desc) {
  const auto math = [](const char* name, const char* operation, const NodeInput& a,
                       const NodeInput& b) {
    Node n = node(name, "VECT_MATH", {{"Vector", a}, {"Vector_001", b}});
    n.properties = {{"operation", std::string(operation)}};
    return n;
  };
  NodeGraph graph = single("EMISSION", {{"Color", link("Sum", "Vector")}, {"Strength", 0.7f}});
  graph.nodes.insert(graph.nodes.end(),
                     {node("Where", "TEX_COORD", {}),
                      math("Scaled", "MULTIPLY", link("Where", "Normal"), vec3(0.5f, -0.4f, -0.3f)),
                      math("Moved", "ADD", link("Scaled", "Vector"), link("Where", "Object")),
                      math("Sum", "ADD", link("Moved", "Vector"), vec3(1.4f, 1.3f, 1.2f))});
  desc.graph = graph;
  return desc;
}

inline const vec3 kFallingFrom(0.2f, 0.1f, 1);
// With a tree by which it falls linearly, and less close to it.
inline LightDesc falling(LightDesc desc) {
  NodeGraph graph = single("EMISSION", {{"Strength", link("Falloff", "Linear")}});
  graph.nodes.push_back(node("Falloff", "LIGHT_FALLOFF", {{"Strength", 0.8f}, {"Smooth", 0.4f}}));
  desc.graph = graph;
  return desc;
}

// Geometry around the receiver sets the extent of the scene: light comes from beyond.
inline SceneKit around() {
  return SceneKit()
      .add("floor", plane(3, 3), {}, translation({0, 0, -0.1f}))
      .add("post", plane(0.1f, 0.1f), {}, translation({1.4f, 1.4f, 0.2f}));
}

inline double of_point(vec3) { return 1; }
inline double of_ball(vec3) { return kPiD * 0.09; }
// A box of 3 x 3 x 0.3.
inline double of_scene(vec3 d) { return 9 * std::abs(d.z) + 0.9 * (std::abs(d.x) + std::abs(d.y)); }

// All brightnesses, twice as bright from above, and a small sun.
inline Image sky() {
  Image image(16, 8, 3);
  Random random(3);
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    image.pixels[i] = random.next() * (i > image.pixels.size() / 2 ? 2.0f : 1.0f);
  }
  for (int c = 0; c < 3; ++c) {
    image.pixels[3 * (6 * 16 + 4) + c] = 100.0f;
  }
  return image;
}

// By nodes: the picture above, times the square of the height, and a sharp spot of its own; black
// below the horizon.
inline NodeGraph sky_of_nodes(float strength = 1.0f) {
  const auto math = [](const char* name, const char* operation, const NodeInput& a,
                       const NodeInput& b) {
    Node n = node(name, "MATH", {{"Value", a}, {"Value_001", b}});
    n.properties = {{"operation", std::string(operation)}};
    return n;
  };
  NodeGraph graph =
      single("BACKGROUND", {{"Color", link("Times", "Vector")}, {"Strength", strength}});
  Node times = node("Times", "VECT_MATH",
                    {{"Vector", link("Map", "Color")}, {"Scale", link("Sum", "Value")}});
  times.properties = {{"operation", std::string("SCALE")}};
  Node map = node("Map", "TEX_ENVIRONMENT", {});
  map.properties = {{"image", std::string("image")}};
  graph.nodes.insert(graph.nodes.end(),
                     {times, map, node("Where", "TEX_COORD", {}),
                      node("Split", "SEPXYZ", {{"Vector", link("Where", "Generated")}}),
                      math("Above", "MAXIMUM", link("Split", "Z"), 0.0f),
                      math("Square", "MULTIPLY", link("Above", "Value"), link("Above", "Value")),
                      math("Spot", "GREATER_THAN", link("Split", "Z"), 0.95f),
                      math("Bright", "MULTIPLY", link("Spot", "Value"), 20.0f),
                      math("Sum", "ADD", link("Square", "Value"), link("Bright", "Value"))});
  return graph;
}
inline SceneKit world_of_nodes(SceneKit kit) {
  kit.builder.set_image("image", {"Sky", std::make_shared<Image>(sky()), false});
  kit.builder.set_world({"World", sky_of_nodes()});
  return kit;
}

// A world of Blender's Sky Texture: a clear day, dimmed.
inline NodeGraph sky_texture(const std::string& model,
                             std::map<std::string, NodeProperty> properties = {}) {
  NodeGraph graph = single("BACKGROUND", {{"Color", link("Sky", "Color")}, {"Strength", 0.02f}});
  Node sky = node("Sky", "TEX_SKY", {});
  sky.properties = std::move(properties);
  sky.properties.merge(std::map<std::string, NodeProperty>{
      {"sky_type", model},
      {"sun_disc", true},
      {"sun_size", 0.0095f},
      {"sun_intensity", 1.0f},
      {"sun_elevation", 0.6f},
      {"altitude", 100.0f},
      {"air_density", 1.0f},
      {"dust_density", 1.0f},
      {"aerosol_density", 1.0f},
      {"ozone_density", 1.0f},
      {"turbidity", 3.0f},
      {"ground_albedo", 0.3f},
      {"sun_direction", std::vector<float>{0.6f, 0.0f, 0.8f}},
  });
  graph.nodes.push_back(std::move(sky));
  return graph;
}

inline const LightCase kLightCases[] = {
    {.name = "projector",  // a watt for each pixel
     .make = [] { return lamp(spot(0, true, scaling({2, 0.5f, 1}))); },
     .watts = 32,
     .hittable = false,
     .projected = of_point,
     .projector = true},
    {.name = "projector_parallel",
     .make =
         [] {
           return lamp(
               shaped(AreaShape::Rectangle, rotation({1, 0, 0}, 0.2f) * scaling({2, -1, 1}), 0));
         },
     .watts = 32,
     .hittable = false,
     .projector = true},
    {.name = "point",
     .make = [] { return lamp(point_light({0.2f, 0.1f, 1}, 7)); },
     .watts = 7,
     .hittable = false,
     .projected = of_point},
    {.name = "point_soft",
     .make = [] { return lamp(point_light({0.2f, 0.1f, 1}, 7, 0.3f)); },
     .watts = 7,
     .projected = of_ball},
    {.name = "point_sphere",
     .make = [] { return lamp(point_light({0.2f, 0.1f, 1}, 7, 0.3f, false)); },
     .watts = 7,
     .projected = of_ball},
    {.name = "spot",
     .make = [] { return lamp(spot(0, true)); },
     .watts = 7 * beam(0.9, 0.4),
     .hittable = false,
     .projected = of_point},
    {.name = "spot_hard",
     .make = [] { return lamp(spot_light({0.2f, 0, 1}, {0, 0, 0}, 7, 0.5f, 0)); },
     .watts = 7 * beam(0.5, 0),
     .hittable = false,
     .projected = of_point},
    {.name = "spot_scaled",
     .make = [] { return lamp(spot(0, true, scaling({2, 0.5f, 1}) * sheared(1, 0, 0.3f))); },
     .hittable = false,
     .projected = of_point},
    {.name = "spot_wide",
     .make = [] { return lamp(spot_light({0.2f, 0, 1}, {0, 0, 0}, 7, kPi, 1)); },
     .watts = 7 * beam(kPiD, 1),
     .hittable = false,
     .projected = of_point},
    {.name = "spot_soft",
     .make = [] { return lamp(spot(0.3f, true)); },
     .watts = 7 * beam(0.9, 0.4),
     .whole = false,
     .projected = of_ball},
    {.name = "spot_sphere",
     .make = [] { return lamp(spot(0.3f, false)); },
     .watts = 7 * beam(0.9, 0.4),
     .whole = false,
     .projected = of_ball},
    {.name = "spot_sphere_scaled",
     .make = [] { return lamp(spot(0.3f, false, scaling({1.5f, -0.6f, 1}))); },
     .whole = false,
     .projected = of_ball},
    {.name = "sun",
     .make = [] { return around().light("lamp", sun_light({1, 0.5f, 2}, 3, 0)); },
     .watts = 3 * of_scene(normalize(vec3(1, 0.5f, 2))),
     .hittable = false},
    {.name = "sun_disk",
     .make = [] { return around().light("lamp", sun_light({1, 0.5f, 2}, 3, 0.5f)); },
     .projected = of_scene},
    {.name = "sun_half_sky",
     .make = [] { return around().light("lamp", sun_light({0.1f, 0.5f, 2}, 3, kPi)); },
     .projected = of_scene},
    {.name = "square",
     .make = [] { return lamp(shaped(AreaShape::Square)); },
     .watts = 7,
     .projected = [](vec3 d) { return facing(shaped(AreaShape::Square), 0.36, d); }},
    {.name = "rectangle_scaled",
     .make = [] { return lamp(shaped(AreaShape::Rectangle, scaling({2, -0.7f, 1.5f}))); },
     .watts = 7},
    {.name = "disk", .make = [] { return lamp(shaped(AreaShape::Disk)); }, .watts = 7},
    {.name = "ellipse_scaled",
     .make = [] { return lamp(shaped(AreaShape::Ellipse, scaling({1, 3, 1}))); },
     .watts = 7,
     .projected =
         [](vec3 d) {
           return facing(shaped(AreaShape::Ellipse, scaling({1, 3, 1})), kPiD / 4 * 0.18, d);
         }},
    {.name = "sheared",  // as under a parent that is scaled unevenly
     .make = [] { return lamp(shaped(AreaShape::Rectangle, sheared(1, 0, 0.5f))); },
     .watts = 7},
    {.name = "sheared_axis",  // the light's axis is not perpendicular to it
     .make = [] { return lamp(shaped(AreaShape::Rectangle, sheared(2, 0, 0.4f))); },
     .watts = 7},
    {.name = "spread",
     .make = [] { return lamp(shaped(AreaShape::Square, mat4(1), 1.0f)); },
     .watts = 7,
     .whole = false,
     .projected = [](vec3 d) { return facing(shaped(AreaShape::Square), 0.36, d); }},
    {.name = "narrow_spread",
     .make = [] { return lamp(shaped(AreaShape::Disk, mat4(1), 0.3f)); },
     .watts = 7,
     .whole = false},
    {.name = "mesh",  // both sides of 0.4 * 0.5 * 1.5 m^2 shine with pi L
     .make =
         [] {
           return SceneKit().add("lamp", plane(0.4f, 0.5f), emission(Rgb(1), 3),
                                 translation({0.1f, 0.2f, 0.9f}) * rotation({1, 2, 0}, 2.5f) *
                                     scaling({-1, 1.5f, 1}));
         },
     .watts = 2 * 0.4 * 0.5 * 1.5 * 3 * kPiD},
    {.name = "world", .make = [] { return around().world(Rgb(2)); }, .nee = false},
    {.name = "world_image", .make = [] { return around().world(sky()); }, .projected = of_scene},
    {.name = "world_image_closest_turned",
     .make =
         [] {
           Node turn = node("Turn", "MAPPING", {{"Rotation", vec3(0.3f, -0.5f, 1.0f)}});
           return around().world(sky(), 0.5f, "Closest", turn);
         },
     .projected = of_scene},
    {.name = "point_by_nodes",
     .make = [] { return lamp(by_nodes(point_light({0.2f, 0.1f, 1}, 7))); },
     .hittable = false},
    {.name = "point_soft_by_nodes",
     .make = [] { return lamp(by_nodes(point_light({0.2f, 0.1f, 1}, 7, 0.3f))); }},
    {.name = "sphere_by_nodes",
     .make = [] { return lamp(by_nodes(point_light({0.2f, 0.1f, 1}, 7, 0.3f, false))); }},
    {.name = "spot_by_nodes", .make = [] { return lamp(by_nodes(spot(0.2f, true))); }},
    {.name = "area_by_nodes", .make = [] { return lamp(by_nodes(shaped(AreaShape::Rectangle))); }},
    {.name = "sun_by_nodes",
     .make = [] { return around().light("lamp", by_nodes(sun_light({0.3f, -1, 1}, 3, 0.5f))); }},
    {.name = "point_falling_by_nodes",
     .make = [] { return lamp(falling(point_light(kFallingFrom, 7))); },
     .hittable = false},
    {.name = "point_soft_falling_by_nodes",
     .make = [] { return lamp(falling(point_light(kFallingFrom, 7, 0.3f))); }},
    {.name = "sphere_falling_by_nodes",
     .make = [] { return lamp(falling(point_light(kFallingFrom, 7, 0.3f, false))); }},
    {.name = "area_falling_by_nodes",
     .make = [] { return lamp(falling(area_light(kFallingFrom, {0, 0, 0}, 0.6f, 7))); }},
    {.name = "world_of_nodes",
     .make = [] { return world_of_nodes(around()); },
     .projected = of_scene},
};

// The first light along the ray.
inline std::optional<LightHit> hit_light(const Scene& scene, const Ray& ray) {
  const Light& light = *scene.lights[0];
  const auto surface = light.infinite() ? std::nullopt : scene.intersect(ray, RayType::Camera);
  if (surface) {
    size_t index;
    const MeshLight* mesh = scene.mesh_light(*surface, index);
    return mesh ? std::optional(mesh->at(*surface, ray.origin, ray.direction,
                                         scene.shade(*surface, -ray.direction).emission))
                : std::nullopt;
  }
  return light.intersect(ray);
}

}  // namespace janus::test
