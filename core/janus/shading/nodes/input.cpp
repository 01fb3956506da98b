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

// There is a program for each type of ray, with the answers as constants.
void emit_light_path(NodeEmitter& e) {
  for (const std::string_view output : kLightPath) {
    if (const auto yes = light_path_answer(e.seen().ray, output)) {
      e.output(output, e.constant(*yes ? 1.0f : 0.0f));
    }
  }
  if (e.seen().of == SeenTree::Of::World) {
    e.output("Ray Length", e.constant(kFar));
  } else if (e.seen().of == SeenTree::Of::Lamp) {
    constexpr static Operation kLength =
        by_view<[](const Context& c) { return std::min(c.point.ray_length, kFar); }>;
    e.output("Ray Length", e.emit(kLength, {}));
  }
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
constexpr Operation kFalloffOfLamp = by_view<[](const Context& c, float strength, float smooth) {
  return falloff(c.point.ray_length, Power, strength, smooth);
}>;
template <int Power>
constexpr Operation kFalloffAtOneMetre =
    pure<[](float strength, float smooth) { return falloff(1.0f, Power, strength, smooth); }>;

void emit_falloff(NodeEmitter& e) {
  const Value strength = e.input("Strength"), smooth = e.input("Smooth");
  if (e.seen().of == SeenTree::Of::World) {
    for (const std::string_view output : kFalloff) {
      e.output(output, strength);
    }
    return;
  }
  const bool lamp = e.seen().of == SeenTree::Of::Lamp;
  const auto emit = [&](const Operation& of_lamp, const Operation& at_one_metre) {
    return e.emit(lamp ? of_lamp : at_one_metre, {strength, smooth});
  };
  e.output("Quadratic", emit(kFalloffOfLamp<0>, kFalloffAtOneMetre<0>));
  e.output("Linear", emit(kFalloffOfLamp<1>, kFalloffAtOneMetre<1>));
  e.output("Constant", emit(kFalloffOfLamp<2>, kFalloffAtOneMetre<2>));
  const bool exact = lamp || (e.is_constant(smooth, vec3(0.0f)) && !e.output_linked("Linear") &&
                              !e.output_linked("Constant"));
  if (!exact) {
    e.warn("on surfaces the distance is not known yet; one metre is used");
  }
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
