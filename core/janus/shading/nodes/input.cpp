// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a shader is told about the point: coordinates, the object, the view.
#include <algorithm>
#include <cmath>
#include <limits>

#include "janus/shading/compiler.h"
#include "janus/shading/fresnel.h"
#include "janus/shading/node_emitter.h"
#include "janus/shading/nodes/families.h"
#include "janus/shading/point_reads.h"
#include "janus/shading/rotation.h"

namespace janus {

namespace {

using enum SocketType;

// --- Texture Coordinate --------------------------------------------------------------------------

constexpr std::string_view kCoordinates[] = {"Generated", "Normal", "UV",        "Object",
                                             "Camera",    "Window", "Reflection"};

constexpr Operation kObjectNormal = by_side<[](const Context& c) {
  if (c.point.moved && !is_black(c.point.object_normal)) {
    return c.point.facing(safe_normalize(c.point.object_normal));
  }
  // Normals go to the object by the transpose of its matrix.
  return safe_normalize(glm::transpose(mat3(c.point.object->to_world)) *
                        c.point.facing(c.point.ns));
}>;
constexpr Operation kCameraPoint = at_point<[](const Context& c) {
  return vec3(c.point.object->camera->from_world * vec4(c.point.p, 1.0f));
}>;
// Worlds are as far from the camera as from anything.
constexpr Operation kCameraDirection =
    at_point<[](const Context& c) { return mat3(c.point.object->camera->from_world) * c.point.p; }>;
// `data`: 1, for a world.
constexpr Operation kWindow = at_point<[](const Context& c) {
  return c.point.object->camera->window(c.point.p, c.data != 0);
}>;
// By the rows of a matrix in a table.
constexpr Operation kOtherObjectPoint = at_point<[](const Context& c) {
  const std::vector<float>& m = c.program.tables[c.data];
  const vec3 p = c.point.p;
  vec3 out;
  for (int i = 0; i < 3; ++i) {
    out[i] = m[4 * i] * p.x + m[4 * i + 1] * p.y + m[4 * i + 2] * p.z + m[4 * i + 3];
  }
  return out;
}>;
constexpr Operation kReflection = by_view<[](const Context& c) {
  const vec3 n = c.point.facing(c.point.ns);
  return 2.0f * dot(n, c.point.view) * n - c.point.view;
}>;

void emit_coordinates(NodeEmitter& e) {
  const bool world = e.seen().of == SeenTree::Of::World, lamp = e.seen().of == SeenTree::Of::Lamp;
  const bool dupli = e.flag("from_instancer");
  e.output("Generated", dupli && !world && !lamp
                            ? e.emit(kAttribute, {}, e.attribute("dupli_generated"))
                            : e.generated());
  e.output("Normal", e.emit(kObjectNormal, {}));
  e.output("UV", lamp ? e.emit(kParametric, {})
                      : e.emit(kAttribute, {}, e.attribute(dupli ? "dupli_uv" : "uv:")));
  const std::vector<float>* other = e.list("object_matrix");
  e.output("Object", other && other->size() == 16 ? e.emit(kOtherObjectPoint, {}, e.table(*other))
                                                  : e.emit(kObjectPoint, {}));
  e.output("Camera", e.emit(world ? kCameraDirection : kCameraPoint, {}));
  e.output("Window", e.emit(kWindow, {}, world ? 1 : 0));
  e.output("Reflection", e.emit(kReflection, {}));
}

// --- Object Info, Camera Data --------------------------------------------------------------------

constexpr std::string_view kObject[] = {"Location",     "Color",          "Alpha",
                                        "Object Index", "Material Index", "Random"};

void emit_object(NodeEmitter& e) {
  e.output("Location",
           e.emit(at_point<[](const Context& c) { return c.point.object->location; }>, {}));
  e.output(
      "Color",
      e.convert(e.emit(at_point<[](const Context& c) { return vec3(c.point.object->color); }>, {}),
                Color));
  e.output("Alpha", e.emit(at_point<[](const Context& c) { return c.point.object->color.w; }>, {}));
  e.output("Object Index",
           e.emit(at_point<[](const Context& c) { return c.point.object->object_index; }>, {}));
  e.output("Material Index",
           e.emit(at_point<[](const Context& c) { return c.point.material_index; }>, {}));
  e.output("Random", e.emit(at_point<[](const Context& c) { return c.point.object->random; }>, {}));
}

constexpr std::string_view kCamera[] = {"View Vector", "View Z Depth", "View Distance"};

void emit_camera(NodeEmitter& e) {
  const Value p = e.unshifted().emit(kCameraPoint, {});
  e.output("View Vector", e.emit(pure<&safe_normalize>, {p}));
  e.output("View Z Depth", e.emit(pure<[](vec3 v) { return v.z; }>, {p}));
  e.output("View Distance", e.emit(pure<[](vec3 v) { return glm::length(v); }>, {p}));
}

// --- Light Path ----------------------------------------------------------------------------------

constexpr std::string_view kLightPath[] = {
    "Is Camera Ray",      "Is Shadow Ray",     "Is Diffuse Ray",      "Is Glossy Ray",
    "Is Singular Ray",    "Is Reflection Ray", "Is Transmission Ray", "Is Volume Scatter Ray",
    "Ray Length",         "Ray Depth",         "Diffuse Depth",       "Glossy Depth",
    "Transmission Depth", "Transparent Depth", "Portal Depth"};

constexpr float kFar = std::numeric_limits<float>::max();  // of what is infinitely far

template <auto Count>
constexpr Operation kPathCount =
    by_path<[](const Context& c) { return static_cast<float>(Count(c.point.path)); }>;
// As Cycles counts vertices, for the three kinds of trees (PathSoFar).
constexpr Operation kRayDepth[] = {
    kPathCount<[](const PathSoFar& path) { return path.depth; }>,
    kPathCount<[](const PathSoFar& path) { return path.depth + 1; }>,
    kPathCount<[](const PathSoFar& path) { return path.depth + (path.looks ? 0 : 1); }>,
};
// Of bounces with a label, and of those that worlds see.
template <int Label>
constexpr Operation kLabelled =
    kPathCount<[](const PathSoFar& path) { return path.bounces.of[Label]; }>;
template <int Label>
constexpr Operation kLabelledOfWorld =
    kPathCount<[](const PathSoFar& path) { return path.all_bounces().of[Label]; }>;
constexpr Operation kCrossings = kPathCount<[](const PathSoFar& path) { return path.crossings; }>;
constexpr Operation kRayLength =
    by_path<[](const Context& c) { return std::min(c.point.path.ray_length, kFar); }>;
// How far it is to what a lamp lights is known to its light paths, too.
constexpr Operation kLengthOfLamp =
    by_view<[](const Context& c) { return std::min(c.point.path.ray_length, kFar); }>;

// There is a program for each type of ray, with the answers as constants.
void emit_light_path(NodeEmitter& e) {
  for (const std::string_view output : kLightPath) {
    if (const auto yes = light_path_answer(e.seen().ray, output)) {
      e.output(output, e.constant(*yes ? 1.0f : 0.0f));
    }
  }
  const SeenTree::Of of = e.seen().of;
  const bool world = of == SeenTree::Of::World;
  e.output("Ray Depth", e.emit(kRayDepth[static_cast<int>(of)], {}));
  e.output("Diffuse Depth", e.emit(world ? kLabelledOfWorld<0> : kLabelled<0>, {}));
  e.output("Glossy Depth", e.emit(world ? kLabelledOfWorld<1> : kLabelled<1>, {}));
  e.output("Transmission Depth", e.emit(world ? kLabelledOfWorld<2> : kLabelled<2>, {}));
  e.output("Transparent Depth", e.emit(kCrossings, {}));
  e.output("Portal Depth", e.constant(0.0f));  // no closure is a portal
  e.output("Ray Length", world ? e.constant(kFar)
                               : e.emit(of == SeenTree::Of::Lamp ? kLengthOfLamp : kRayLength, {}));
}

// --- Light Falloff -------------------------------------------------------------------------------

constexpr SocketDecl kFalloffInputs[] = {{"Strength", Float, 100.0f}, {"Smooth", Float, 0.0f}};
constexpr std::string_view kFalloff[] = {"Quadratic", "Linear", "Constant"};

// Light falls with the square of the distance by itself. From infinitely far it does not.
float falloff(float distance, int power, float strength, float smooth) {
  if (std::isinf(distance)) {
    return strength;
  }
  const float squared = sqr(distance);
  strength *= power == 0 ? 1.0f : power == 1 ? distance : squared;
  return smooth > 0.0f ? strength * (squared / (smooth + squared)) : strength;
}
template <int Power>
float falloff_there(const Context& c, float strength, float smooth) {
  return falloff(c.point.path.ray_length, Power, strength, smooth);
}

void emit_falloff(NodeEmitter& e) {
  const Value strength = e.input("Strength"), smooth = e.input("Smooth");
  if (e.seen().of == SeenTree::Of::World) {
    for (const std::string_view output : kFalloff) {
      e.output(output, strength);
    }
    return;
  }
  const auto emit = [&](const Operation& of_lamp, const Operation& of_surface) {
    const bool lamp = e.seen().of == SeenTree::Of::Lamp;
    return e.emit(lamp ? of_lamp : of_surface, {strength, smooth});
  };
  // Light falls so without the node: no need to ask how far it has come.
  e.output("Quadratic", e.is_constant(smooth, vec3(0.0f))
                            ? strength
                            : emit(by_view<&falloff_there<0>>, by_path<&falloff_there<0>>));
  e.output("Linear", emit(by_view<&falloff_there<1>>, by_path<&falloff_there<1>>));
  e.output("Constant", emit(by_view<&falloff_there<2>>, by_path<&falloff_there<2>>));
}

// --- Fresnel, Layer Weight -----------------------------------------------------------------------

constexpr SocketDecl kFresnelInputs[] = {{"IOR", Float, 1.5f},
                                         {"Normal", Vector, Implicit::Normal}};
constexpr SocketDecl kLayerInputs[] = {{"Blend", Float, 0.5f},
                                       {"Normal", Vector, Implicit::Normal}};
constexpr std::string_view kFactor[] = {"Fac"}, kLayer[] = {"Fresnel", "Facing"};

float fresnel_factor(const Context& c, float ior, vec3 n) {
  const float eta = std::max(ior, 1e-5f);
  return fresnel_dielectric(std::abs(dot(c.point.view, n)),
                            c.point.backfacing() ? 1.0f / eta : eta);
}
float layer_fresnel(const Context& c, float blend, vec3 n) {
  const float eta = std::max(1.0f - blend, 1e-5f);
  return fresnel_dielectric(std::abs(dot(c.point.view, n)),
                            c.point.backfacing() ? eta : 1.0f / eta);
}
float layer_facing(const Context& c, float blend, vec3 n) {
  float f = std::abs(dot(c.point.view, n));
  if (blend != 0.5f) {
    blend = std::clamp(blend, 0.0f, 1.0f - 1e-5f);
    f = std::pow(f, blend < 0.5f ? 2.0f * blend : 0.5f / (1.0f - blend));
  }
  return 1.0f - f;
}

void emit_fresnel(NodeEmitter& e) {
  e.output("Fac", e.emit(by_view<&fresnel_factor>, {e.input("IOR"), e.input("Normal")}));
}
void emit_layer_weight(NodeEmitter& e) {
  const Value blend = e.input("Blend"), n = e.input("Normal");
  e.output("Fresnel", e.emit(by_view<&layer_fresnel>, {blend, n}));
  e.output("Facing", e.emit(by_view<&layer_facing>, {blend, n}));
}

}  // namespace

// As in Cycles, what glass lets through is a glossy ray, too. The types do not tell mirrors from
// rough surfaces, nor count bounces.
std::optional<bool> light_path_answer(RayType ray, std::string_view output) {
  const bool diffuse = ray == RayType::Diffuse, glossy = ray == RayType::Glossy;
  const bool transmission = ray == RayType::Transmission;
  const std::pair<std::string_view, bool> answers[] = {
      {"Is Camera Ray", ray == RayType::Camera},
      {"Is Shadow Ray", ray == RayType::Shadow},
      {"Is Diffuse Ray", diffuse},
      {"Is Glossy Ray", glossy || transmission},
      {"Is Reflection Ray", diffuse || glossy},
      {"Is Transmission Ray", transmission},
      {"Is Volume Scatter Ray", false},
  };
  for (const auto& [name, yes] : answers) {
    if (name == output) {
      return yes;
    }
  }
  return std::nullopt;
}

std::span<const NodeDecl> input_nodes() {
  static const NodeDecl kNodes[] = {
      {"TEX_COORD", {}, kCoordinates, &emit_coordinates},
      {"OBJECT_INFO", {}, kObject, &emit_object},
      {"CAMERA", {}, kCamera, &emit_camera},
      {"LIGHT_PATH", {}, kLightPath, &emit_light_path},
      {"LIGHT_FALLOFF", kFalloffInputs, kFalloff, &emit_falloff},
      {"FRESNEL", kFresnelInputs, kFactor, &emit_fresnel},
      {"LAYER_WEIGHT", kLayerInputs, kLayer, &emit_layer_weight},
  };
  return kNodes;
}

}  // namespace janus
