// SPDX-License-Identifier: GPL-3.0-or-later
//
// Vectors: Mapping, Vector Math, Vector Rotate, Vector Transform, Normal.
#include <algorithm>
#include <cmath>

#include "janus/shading/node_emitter.h"
#include "janus/shading/nodes/families.h"
#include "janus/shading/rotation.h"
#include "janus/shading/scalar.h"

namespace janus {

namespace {

using enum SocketType;

constexpr std::string_view kVector[] = {"Vector"};

// --- Mapping -------------------------------------------------------------------------------------

constexpr SocketDecl kMappingInputs[] = {{"Vector", Vector, 0.0f},
                                         {"Location", Vector, 0.0f},
                                         {"Rotation", Vector, 0.0f},
                                         {"Scale", Vector, 1.0f}};

vec3 map_point(vec3 v, vec3 location, vec3 angles, vec3 scale) {
  return euler_rotation(angles) * (v * scale) + location;
}
vec3 map_texture(vec3 v, vec3 location, vec3 angles, vec3 scale) {
  return safe_divide(glm::transpose(euler_rotation(angles)) * (v - location), scale);
}
vec3 map_vector(vec3 v, vec3, vec3 angles, vec3 scale) {
  return euler_rotation(angles) * (v * scale);
}
vec3 map_normal(vec3 v, vec3, vec3 angles, vec3 scale) {
  return safe_normalize(euler_rotation(angles) * safe_divide(v, scale));
}

void emit_mapping(NodeEmitter& e) {
  const std::string type = e.property("vector_type", "POINT");
  const Operation& operation = type == "TEXTURE"  ? pure<&map_texture>
                               : type == "VECTOR" ? pure<&map_vector>
                               : type == "NORMAL" ? pure<&map_normal>
                                                  : pure<&map_point>;
  // Cycles takes what is scaled to nothing for nothing, wherever it is moved.
  const Value scale = e.input("Scale");
  const bool nothing = e.is_constant(scale, vec3(0.0f));
  e.output("Vector", nothing ? e.constant(vec3(0.0f))
                             : e.emit(operation, {e.input("Vector"), e.input("Location"),
                                                  e.input("Rotation"), scale}));
}

// --- Vector Math ---------------------------------------------------------------------------------

constexpr SocketDecl kMathInputs[] = {{"Vector", Vector, 0.0f},
                                      {"Vector_001", Vector, 0.0f},
                                      {"Vector_002", Vector, 0.0f},
                                      {"Scale", Float, 1.0f}};
constexpr std::string_view kMathOutputs[] = {"Vector", "Value"};

template <auto F>
vec3 components1(vec3 a) {
  return vec3(F(a.x), F(a.y), F(a.z));
}
template <auto F>
vec3 components2(vec3 a, vec3 b) {
  return vec3(F(a.x, b.x), F(a.y, b.y), F(a.z, b.z));
}
template <auto F>
vec3 components3(vec3 a, vec3 b, vec3 c) {
  return vec3(F(a.x, b.x, c.x), F(a.y, b.y, c.y), F(a.z, b.z, c.z));
}

float sine(float x) { return std::sin(x); }
float cosine(float x) { return std::cos(x); }
float tangent(float x) { return std::tan(x); }
float snap(float a, float b) { return std::floor(safe_divide(a, b)) * b; }

vec3 project(vec3 a, vec3 b) {
  const float length = length2(b);
  return length != 0.0f ? dot(a, b) / length * b : vec3(0.0f);
}
vec3 reflect(vec3 a, vec3 b) {
  const vec3 n = safe_normalize(b);
  return a - 2.0f * dot(n, a) * n;
}
vec3 refract(vec3 a, vec3 b, float eta) {
  const vec3 n = safe_normalize(b);
  const float d = dot(n, a), k = 1.0f - eta * eta * (1.0f - d * d);
  return k < 0.0f ? vec3(0.0f) : eta * a - (eta * d + std::sqrt(k)) * n;
}

// What an operation takes: its vectors, in order, and the number Scale in the end.
struct VectorMode {
  std::string_view name;
  Operation operation;
  bool scale = false;
};
const VectorMode kVectorModes[] = {
    {"ADD", pure<[](vec3 a, vec3 b) { return a + b; }>},
    {"SUBTRACT", pure<[](vec3 a, vec3 b) { return a - b; }>},
    {"MULTIPLY", pure<[](vec3 a, vec3 b) { return a * b; }>},
    {"DIVIDE", pure<[](vec3 a, vec3 b) { return safe_divide(a, b); }>},
    {"MULTIPLY_ADD", pure<[](vec3 a, vec3 b, vec3 c) { return a * b + c; }>},
    {"CROSS_PRODUCT", pure<[](vec3 a, vec3 b) { return cross(a, b); }>},
    {"PROJECT", pure<&project>},
    {"REFLECT", pure<&reflect>},
    {"REFRACT", pure<&refract>, true},
    {"FACEFORWARD", pure<[](vec3 a, vec3 b, vec3 c) { return dot(b, c) < 0.0f ? a : -a; }>},
    {"DOT_PRODUCT", pure<[](vec3 a, vec3 b) { return dot(a, b); }>},
    {"DISTANCE", pure<[](vec3 a, vec3 b) { return glm::length(a - b); }>},
    {"LENGTH", pure<[](vec3 a) { return glm::length(a); }>},
    {"SCALE", pure<[](vec3 a, float s) { return a * s; }>, true},
    {"NORMALIZE", pure<&safe_normalize>},
    {"ABSOLUTE", pure<[](vec3 a) { return vec3(glm::abs(a)); }>},
    {"POWER", pure<&components2<&safe_power>>},
    {"SIGN", pure<[](vec3 a) { return vec3(glm::sign(a)); }>},
    {"MINIMUM", pure<&components2<&lower>>},
    {"MAXIMUM", pure<&components2<&upper>>},
    {"ROUND", pure<[](vec3 a) { return vec3(glm::floor(a + 0.5f)); }>},
    {"FLOOR", pure<[](vec3 a) { return vec3(glm::floor(a)); }>},
    {"CEIL", pure<[](vec3 a) { return vec3(glm::ceil(a)); }>},
    {"FRACTION", pure<[](vec3 a) { return vec3(a - glm::floor(a)); }>},
    {"MODULO", pure<&components2<&safe_modulo>>},
    {"WRAP", pure<&components3<&wrap>>},
    {"SNAP", pure<&components2<&snap>>},
    {"SINE", pure<&components1<&sine>>},
    {"COSINE", pure<&components1<&cosine>>},
    {"TANGENT", pure<&components1<&tangent>>},
};

void emit_vector_math(NodeEmitter& e) {
  const VectorMode& mode = find_mode(kVectorModes, e.property("operation", "ADD"));
  const int vectors = mode.operation.count - (mode.scale ? 1 : 0);
  const Value a = e.input("Vector"), b = vectors > 1 ? e.input("Vector_001") : a,
              c = vectors > 2 ? e.input("Vector_002") : a;
  const Value scale = mode.scale ? e.input("Scale") : a;
  const Value result = !mode.scale    ? e.emit(mode.operation, {a, b, c})
                       : vectors == 1 ? e.emit(mode.operation, {a, scale})
                                      : e.emit(mode.operation, {a, b, scale});
  e.output(result.type == Float ? "Value" : "Vector", result);
}

// --- Vector Rotate -------------------------------------------------------------------------------

constexpr SocketDecl kRotateInputs[] = {{"Vector", Vector, 0.0f},
                                        {"Center", Vector, 0.0f},
                                        {"Axis", Vector, vec3(0, 0, 1)},
                                        {"Angle", Float, 0.0f},
                                        {"Rotation", Vector, 0.0f}};

vec3 rotate_about(vec3 v, vec3 center, vec3 axis, float angle) {
  const float length = glm::length(axis);
  return length != 0.0f ? center + axis_rotation(axis / length, angle) * (v - center) : v;
}
vec3 rotate_euler(vec3 v, vec3 center, vec3 angles) {
  return center + euler_rotation(angles) * (v - center);
}
vec3 rotate_euler_back(vec3 v, vec3 center, vec3 angles) {
  return center + glm::transpose(euler_rotation(angles)) * (v - center);
}
constexpr Operation kNegate = pure<[](float x) { return -x; }>;

void emit_rotate(NodeEmitter& e) {
  const std::string type = e.property("rotation_type", "AXIS_ANGLE");
  const bool invert = e.flag("invert");
  const Value v = e.input("Vector"), center = e.input("Center");
  if (type == "EULER_XYZ") {
    const Value angles = e.input("Rotation");
    e.output("Vector", invert ? e.emit(pure<&rotate_euler_back>, {v, center, angles})
                              : e.emit(pure<&rotate_euler>, {v, center, angles}));
    return;
  }
  const Value axis = type == "X_AXIS"   ? e.constant(vec3(1, 0, 0))
                     : type == "Y_AXIS" ? e.constant(vec3(0, 1, 0))
                     : type == "Z_AXIS" ? e.constant(vec3(0, 0, 1))
                                        : e.input("Axis");
  const Value angle = e.input("Angle");
  e.output("Vector", e.emit(pure<&rotate_about>,
                            {v, center, axis, invert ? e.emit(kNegate, {angle}) : angle}));
}

// --- Vector Transform ----------------------------------------------------------------------------

constexpr SocketDecl kTransformInputs[] = {{"Vector", Vector, 0.5f}};

enum class Kind { Point, Vector, Normal };

template <Kind K>
vec3 transform(const mat4& m, const mat4& inverse, vec3 v) {
  if constexpr (K == Kind::Point) {
    return vec3(m * vec4(v, 1.0f));
  } else if constexpr (K == Kind::Vector) {
    return mat3(m) * v;
  } else {
    return safe_normalize(glm::transpose(mat3(inverse)) * v);
  }
}
template <Kind K>
vec3 object_to_world(const Context& c, vec3 v) {
  return transform<K>(c.point.object->to_world, c.point.object->to_object, v);
}
template <Kind K>
vec3 world_to_object(const Context& c, vec3 v) {
  return transform<K>(c.point.object->to_object, c.point.object->to_world, v);
}
template <Kind K>
vec3 camera_to_world(const Context& c, vec3 v) {
  return transform<K>(c.point.object->camera->to_world, c.point.object->camera->from_world, v);
}
template <Kind K>
vec3 world_to_camera(const Context& c, vec3 v) {
  return transform<K>(c.point.object->camera->from_world, c.point.object->camera->to_world, v);
}

template <Kind K>
Value transformed(NodeEmitter& e, Value v, const std::string& from, const std::string& to) {
  if (from == to) {
    return v;
  }
  if (from == "OBJECT") {
    v = e.emit(at_point<&object_to_world<K>>, {v});
  } else if (from == "CAMERA") {
    v = e.emit(at_point<&camera_to_world<K>>, {v});
  }
  if (to == "OBJECT") {
    v = e.emit(at_point<&world_to_object<K>>, {v});
  } else if (to == "CAMERA") {
    v = e.emit(at_point<&world_to_camera<K>>, {v});
  }
  return v;
}

void emit_transform(NodeEmitter& e) {
  const std::string type = e.property("vector_type", "VECTOR");
  const std::string from = e.property("convert_from", "WORLD");
  const std::string to = e.property("convert_to", "OBJECT");
  const Value v = e.input("Vector");
  e.output("Vector", type == "POINT"    ? transformed<Kind::Point>(e, v, from, to)
                     : type == "NORMAL" ? transformed<Kind::Normal>(e, v, from, to)
                                        : transformed<Kind::Vector>(e, v, from, to));
}

// --- Normal --------------------------------------------------------------------------------------

constexpr SocketDecl kNormalInputs[] = {{"Normal", Vector, vec3(0, 0, 1)}};
constexpr std::string_view kNormalOutputs[] = {"Normal", "Dot"};
constexpr Operation kDotNormalized =
    pure<[](vec3 a, vec3 b) { return dot(safe_normalize(a), safe_normalize(b)); }>;

// The direction is drawn in the node: Blender keeps it as the value of the output.
void emit_normal(NodeEmitter& e) {
  const std::vector<float>* drawn = e.list("direction");
  const vec3 direction =
      drawn && drawn->size() == 3 ? vec3((*drawn)[0], (*drawn)[1], (*drawn)[2]) : vec3(0, 0, 1);
  const Value n = e.constant(safe_normalize(direction));
  e.output("Normal", n);
  e.output("Dot", e.emit(kDotNormalized, {n, e.input("Normal")}));
}

}  // namespace

std::span<const NodeDecl> vector_nodes() {
  static const auto kOperations = names_of(kVectorModes);
  static constexpr std::string_view kMappings[] = {"POINT", "TEXTURE", "VECTOR", "NORMAL"},
                                    kRotations[] = {"AXIS_ANGLE", "X_AXIS", "Y_AXIS", "Z_AXIS",
                                                    "EULER_XYZ"},
                                    kKinds[] = {"VECTOR", "POINT", "NORMAL"},
                                    kSpaces[] = {"WORLD", "OBJECT", "CAMERA"};
  static const EnumDecl kMapping[] = {{"vector_type", kMappings}},
                        kMath[] = {{"operation", kOperations}},
                        kRotate[] = {{"rotation_type", kRotations}},
                        kTransform[] = {{"vector_type", kKinds},
                                        {"convert_from", kSpaces},
                                        {"convert_to", kSpaces}};
  static const NodeDecl kNodes[] = {
      {"MAPPING", kMappingInputs, kVector, &emit_mapping, nullptr, MixOp::None, kMapping},
      {"VECT_MATH", kMathInputs, kMathOutputs, &emit_vector_math, nullptr, MixOp::None, kMath},
      {"VECTOR_ROTATE", kRotateInputs, kVector, &emit_rotate, nullptr, MixOp::None, kRotate},
      {"VECT_TRANSFORM", kTransformInputs, kVector, &emit_transform, nullptr, MixOp::None,
       kTransform},
      {"NORMAL", kNormalInputs, kNormalOutputs, &emit_normal},
  };
  return kNodes;
}

}  // namespace janus
