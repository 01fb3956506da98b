// SPDX-License-Identifier: GPL-3.0-or-later
//
// Small scenes in a few words.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "janus/render/builder.h"

namespace janus::test {

// --- Node graphs ---

inline Node node(std::string name, std::string type, std::map<std::string, NodeInput> inputs) {
  return Node{std::move(name), std::move(type), std::move(inputs), {}};
}

inline NodeInput link(const std::string& name, const std::string& output = "BSDF") {
  return NodeLink{name, output};
}

// A graph of one node.
inline NodeGraph single(const std::string& type, std::map<std::string, NodeInput> inputs) {
  NodeGraph graph;
  graph.nodes.push_back(node("Shader", type, std::move(inputs)));
  graph.surface = NodeLink{"Shader", "BSDF"};
  return graph;
}

inline NodeGraph diffuse(Rgb color) { return single("BSDF_DIFFUSE", {{"Color", vec4(color, 1)}}); }
inline NodeGraph mirror(Rgb color) {
  return single("BSDF_GLOSSY", {{"Color", vec4(color, 1)}, {"Roughness", 0.0f}});
}
inline NodeGraph glass(Rgb color, float ior) {
  return single("BSDF_GLASS", {{"Color", vec4(color, 1)}, {"Roughness", 0.0f}, {"IOR", ior}});
}
inline NodeGraph emission(Rgb color, float strength) {
  return single("EMISSION", {{"Color", vec4(color, 1)}, {"Strength", strength}});
}

// Light through which goes about 0.1 m below the surface, by default.
inline NodeGraph subsurface(Rgb color, std::map<std::string, NodeInput> more = {},
                            const std::string& method = "RANDOM_WALK") {
  NodeGraph graph = single("SUBSURFACE_SCATTERING", std::move(more));
  graph.nodes.front().inputs.insert({{"Color", vec4(color, 1)}, {"Scale", 1.0f}});
  graph.nodes.front().properties = {{"falloff", method}};
  graph.surface = NodeLink{"Shader", "BSSRDF"};
  return graph;
}

// `type` MIX_SHADER (with `factor`) or ADD_SHADER over two single-node graphs.
inline NodeGraph combine(const std::string& type, const NodeGraph& a, const NodeGraph& b,
                         float factor = 0.5f) {
  NodeGraph graph;
  graph.nodes = {a.nodes.front(), b.nodes.front()};
  graph.nodes[0].name = "A";
  graph.nodes[1].name = "B";
  graph.nodes.push_back(node("Top", type,
                             {{"Fac", factor},
                              {"Shader", link("A", a.surface->output)},
                              {"Shader_001", link("B", b.surface->output)}}));
  graph.surface = NodeLink{"Top", "Shader"};
  return graph;
}

// --- Meshes ---

inline void add_quad(MeshDesc& mesh, vec3 a, vec3 b, vec3 c, vec3 d) {
  const auto first = static_cast<uint32_t>(mesh.positions.size());
  for (const vec3 p : {a, b, c, d}) {
    mesh.positions.push_back(p);
  }
  mesh.triangles.push_back(first + glm::uvec3(0, 1, 2));
  mesh.triangles.push_back(first + glm::uvec3(0, 2, 3));
}

// A rectangle around the origin in the xy plane, normal +z.
inline MeshDesc plane(float width, float height) {
  MeshDesc mesh;
  const float x = 0.5f * width, y = 0.5f * height;
  add_quad(mesh, {-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0});
  return mesh;
}

// A cuboid with normals outwards; `open_front` leaves the side y = lower.y out.
inline MeshDesc cuboid(vec3 lower, vec3 upper, bool open_front = false) {
  MeshDesc mesh;
  const auto at = [&](int x, int y, int z) {
    return vec3(x ? upper.x : lower.x, y ? upper.y : lower.y, z ? upper.z : lower.z);
  };
  add_quad(mesh, at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0));  // bottom
  add_quad(mesh, at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1));  // top
  add_quad(mesh, at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0));  // left
  add_quad(mesh, at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1));  // right
  add_quad(mesh, at(0, 1, 0), at(0, 1, 1), at(1, 1, 1), at(1, 1, 0));  // back
  if (!open_front) {
    add_quad(mesh, at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1));
  }
  return mesh;
}

// A sphere of quads around the origin, normals outwards; `smooth` adds normals per corner.
inline MeshDesc ball(float radius, int segments = 16, bool smooth = false) {
  MeshDesc mesh;
  const int rings = segments / 2;
  for (int i = 0; i <= rings; ++i) {
    for (int j = 0; j <= segments; ++j) {
      const float theta = kPi * i / rings, phi = 2 * kPi * (j % segments) / segments;
      // Poles and seam exactly shared, so that the surface is closed.
      const float r = i == 0 || i == rings ? 0.0f : std::sin(theta);
      const vec3 n(r * std::cos(phi), r * std::sin(phi),
                   i == 0       ? 1.0f
                   : i == rings ? -1.0f
                                : std::cos(theta));
      mesh.positions.push_back(radius * n);
      if (smooth) {
        mesh.corner_normals.push_back(n);
      }
    }
  }
  const auto at = [&](int i, int j) { return static_cast<uint32_t>(i * (segments + 1) + j); };
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < segments; ++j) {
      if (i > 0) {
        mesh.triangles.emplace_back(at(i, j), at(i + 1, j), at(i, j + 1));
      }
      if (i + 1 < rings) {
        mesh.triangles.emplace_back(at(i, j + 1), at(i + 1, j), at(i + 1, j + 1));
      }
    }
  }
  return mesh;
}

// The mesh with one shading normal everywhere.
inline MeshDesc leaning(MeshDesc mesh, vec3 normal) {
  mesh.vertex_normals.assign(mesh.positions.size(), normalize(normal));
  return mesh;
}

// A tube along keys, of one radius.
inline RoundDesc strand(std::vector<vec3> keys, float radius, bool straight = false) {
  RoundDesc shape;
  shape.curves = {0, static_cast<uint32_t>(keys.size())};
  shape.radii.assign(keys.size(), radius);
  shape.positions = std::move(keys);
  shape.straight = straight;
  return shape;
}

inline RoundDesc balls(std::vector<vec3> centers, float radius) {
  RoundDesc shape;
  shape.radii.assign(centers.size(), radius);
  shape.positions = std::move(centers);
  return shape;
}

// --- Transforms ---

inline mat4 translation(vec3 t) {
  mat4 m(1.0f);
  m[3] = vec4(t, 1.0f);
  return m;
}

inline mat4 scaling(vec3 s) {
  mat4 m(1.0f);
  m[0][0] = s.x, m[1][1] = s.y, m[2][2] = s.z;
  return m;
}

inline mat4 rotation(vec3 axis, float angle) {
  const vec3 a = normalize(axis);
  const float c = std::cos(angle), s = std::sin(angle);
  mat4 m(1.0f);
  for (int i = 0; i < 3; ++i) {
    vec3 e(0.0f);
    e[i] = 1.0f;
    m[i] = vec4(c * e + s * cross(a, e) + (1 - c) * dot(a, e) * a, 0.0f);
  }
  return m;
}

// At `from`, local -z towards `to`: cameras and lights.
inline mat4 look_at(vec3 from, vec3 to) {
  const vec3 z = normalize(from - to);
  const vec3 up = std::abs(z.z) > 0.99f ? vec3(0, 1, 0) : vec3(0, 0, 1);
  const vec3 x = normalize(cross(up, z));
  mat4 m(1.0f);
  m[0] = vec4(x, 0), m[1] = vec4(cross(z, x), 0), m[2] = vec4(z, 0), m[3] = vec4(from, 1);
  return m;
}

// --- Scenes ---

class SceneKit {
 public:
  SceneKit() { camera({0, -3, 0}, {0, 0, 0}); }

  // A mesh with one material (no graph: the default surface).
  SceneKit& add(const std::string& name, MeshDesc mesh, std::optional<NodeGraph> material,
                const mat4& transform = mat4(1.0f), RayMask visibility = kAllRays,
                bool holdout = false) {
    InstanceDesc instance;
    instance.holdout = holdout;
    instance.visibility = visibility;
    instance.mesh = name;
    instance.transform = transform;
    if (material) {
      builder.set_material(name, MaterialDesc{name, *material});
      instance.materials.emplace_back(name);
    }
    builder.set_mesh(name, std::move(mesh));
    builder.set_instance(name, std::move(instance));
    return *this;
  }
  SceneKit& add(const std::string& name, RoundDesc shape, std::optional<NodeGraph> material,
                const mat4& transform = mat4(1.0f)) {
    add(name, MeshDesc{}, std::move(material), transform);
    builder.set_round(name, std::move(shape));
    return *this;
  }
  SceneKit& light(const std::string& name, LightDesc desc) {
    builder.set_light(name, std::move(desc));
    return *this;
  }
  SceneKit& world(Rgb color, float strength = 1.0f) {
    NodeGraph graph = single("BACKGROUND", {{"Color", vec4(color, 1)}, {"Strength", strength}});
    builder.set_world({"World", std::move(graph)});
    return *this;
  }
  // A lat-long picture; `mapping`: a MAPPING node between the direction and the picture.
  SceneKit& world(Image pixels, float strength = 1.0f, const std::string& interpolation = "Linear",
                  std::optional<Node> mapping = std::nullopt) {
    NodeGraph graph =
        single("BACKGROUND", {{"Color", link("Map", "Color")}, {"Strength", strength}});
    graph.nodes.push_back(node("Map", "TEX_ENVIRONMENT", {}));
    graph.nodes.back().properties = {{"image", std::string("image")},
                                     {"interpolation", interpolation}};
    if (mapping) {
      graph.nodes.back().inputs["Vector"] = link(mapping->name, "Vector");
      mapping->inputs["Vector"] = link("Coordinates", "Generated");
      graph.nodes.push_back(*mapping);
      graph.nodes.push_back(node("Coordinates", "TEX_COORD", {}));
    }
    builder.set_image("image", {"Sky", std::make_shared<Image>(std::move(pixels)), false});
    builder.set_world({"World", std::move(graph)});
    return *this;
  }
  SceneKit& camera(vec3 from, vec3 to, float half_window = 0.4f) {
    CameraDesc desc;
    desc.name = "Camera";
    desc.transform = look_at(from, to);
    desc.left = desc.bottom = -half_window;
    desc.right = desc.top = half_window;
    desc.clip_start = 0.01f;
    builder.set_camera(desc);
    return *this;
  }
  std::shared_ptr<const Scene> build() const { return builder.commit(CancelToken()); }

  SceneBuilder builder;
};

inline LightDesc area_light(vec3 from, vec3 to, float size, float watts, float spread = kPi) {
  LightDesc desc;
  desc.type = LightType::Area;
  desc.transform = look_at(from, to);
  desc.size = desc.size_y = size;
  desc.energy = watts;
  desc.spread = spread;
  return desc;
}

inline LightDesc point_light(vec3 p, float watts, float radius = 0.0f, bool soft = true) {
  LightDesc desc;
  desc.transform = translation(p);
  desc.energy = watts;
  desc.radius = radius;
  desc.soft_falloff = soft;
  return desc;
}

inline LightDesc spot_light(vec3 from, vec3 to, float watts, float size, float blend,
                            float radius = 0.0f, bool soft = true) {
  LightDesc desc = point_light({}, watts, radius, soft);
  desc.type = LightType::Spot;
  desc.transform = look_at(from, to);
  desc.spot_size = size;
  desc.spot_blend = blend;
  return desc;
}

// `from`: a direction to the sun.
inline LightDesc sun_light(vec3 from, float strength, float angle) {
  LightDesc desc;
  desc.type = LightType::Sun;
  desc.transform = look_at(from, vec3(0.0f));
  desc.energy = strength;
  desc.angle = angle;
  return desc;
}

// A box of side 2 around the origin, open towards the camera at y = -3, with coloured walls: the
// light that a path picks up tells which way it went.
inline SceneKit open_box(Rgb albedo = Rgb(0.6f, 0.5f, 0.4f)) {
  SceneKit kit;
  MeshDesc mesh = cuboid(vec3(-1.0f), vec3(1.0f), true);
  kit.add("box", std::move(mesh), diffuse(albedo));
  kit.camera({0, -3.2f, 0}, {0, 0, 0}, 0.42f);
  return kit;
}

// A closed box around the camera whose walls emit 1 and scatter `diffused` by a Lambert lobe and
// `mirrored` by a mirror: its radiance is a sum over the words of two letters.
inline SceneKit box_of_words(float diffused, float mirrored) {
  NodeGraph walls =
      combine("MIX_SHADER", diffuse(Rgb(2.0f * diffused)), mirror(Rgb(2.0f * mirrored)));
  walls.nodes.push_back(emission(Rgb(1), 1).nodes.front());
  walls.nodes.back().name = "Light";
  walls.nodes.push_back(
      node("Sum", "ADD_SHADER",
           {{"Shader", link("Top", "Shader")}, {"Shader_001", link("Light", "Emission")}}));
  walls.surface = NodeLink{"Sum", "Shader"};
  return SceneKit()
      .add("box", cuboid(vec3(-1), vec3(1)), walls)
      .camera({0, -0.8f, 0.1f}, {0, 1, 0}, 0.4f);
}

// Diffuse, and glossy in other colours.
inline NodeGraph plastic(Rgb color, float roughness) {
  return combine(
      "ADD_SHADER", diffuse(color),
      single("BSDF_GLOSSY", {{"Color", vec4(0.4f, 0.3f, 0.2f, 1)}, {"Roughness", roughness}}));
}

// The box with two diffuse blocks, so that there are shadows and paths of every length.
inline SceneKit room() {
  return open_box()
      .add("block", cuboid({-0.7f, -0.2f, -1}, {-0.2f, 0.4f, 0.1f}), diffuse(Rgb(0.7f)))
      .add("low", cuboid({0.2f, -0.6f, -1}, {0.7f, 0.0f, -0.4f}), diffuse(Rgb(0.2f, 0.5f, 0.8f)));
}

// A few thick fibres that light goes through, and a ball of glass which does not bend it twice:
// what is round is seen from outside alone.
inline SceneKit strands_in(SceneKit kit) {
  NodeGraph hair =
      combine("ADD_SHADER",
              single("BSDF_HAIR_PRINCIPLED", {{"Roughness", 0.6f}, {"Radial Roughness", 0.6f}}),
              single("BSDF_HAIR", {{"Color", vec4(0.3f, 0.4f, 0.2f, 1)}, {"RoughnessU", 0.9f}}));
  hair.nodes[0].properties["parametrization"] = std::string("COLOR");
  hair.nodes[0].inputs["Color"] = vec4(0.7f, 0.5f, 0.3f, 1);
  return kit
      .add("hair", strand({{-0.8f, 0, 0.3f}, {-0.2f, 0.1f, 0.6f}, {0.4f, -0.1f, 0.2f}}, 0.1f), hair)
      .add("leaf", strand({{0, -0.3f, 0.5f}, {0.7f, 0, 0.4f}}, 0.08f, true),
           combine("MIX_SHADER", single("BSDF_TRANSLUCENT", {}), diffuse(Rgb(0.7f))))
      .add("drop", balls({{0.1f, -0.3f, -0.1f}}, 0.15f),
           single("BSDF_GLASS", {{"Roughness", 0.5f}, {"IOR", 1.3f}}));
}

}  // namespace janus::test
