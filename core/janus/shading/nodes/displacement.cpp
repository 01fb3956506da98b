// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the output's Displacement takes: by how much a point of the surface is moved, in the world.
#include "janus/shading/node_emitter.h"
#include "janus/shading/nodes/families.h"
#include "janus/shading/point_reads.h"

namespace janus {

namespace {

using enum SocketType;

constexpr std::string_view kDisplacement[] = {"Displacement"};

constexpr SocketDecl kInputs[] = {{"Height", Float, 0.0f},
                                  {"Midlevel", Float, 0.5f},
                                  {"Scale", Float, 1.0f},
                                  {"Normal", Vector, Implicit::Normal}};
constexpr std::string_view kSpaces[] = {"OBJECT", "WORLD"};
constexpr EnumDecl kSettings[] = {{"space", kSpaces}};

constexpr Operation kAlongNormal = pure<[](float height, float midlevel, float scale, vec3 n) {
  return (height - midlevel) * scale * n;
}>;

// Metres of the object, straight up from its surface.
vec3 object_displacement(const Context& c, float height, float midlevel, float scale, vec3 n) {
  const mat3 linear(c.point.object->to_world);
  const vec3 up = safe_normalize(glm::transpose(linear) * n);
  return linear * ((height - midlevel) * scale * up);
}

void emit_displacement(NodeEmitter& e) {
  const Operation& operation =
      e.property("space", "OBJECT") == "OBJECT" ? at_point<&object_displacement> : kAlongNormal;
  e.output("Displacement", e.emit(operation, {e.input("Height"), e.input("Midlevel"),
                                              e.input("Scale"), e.input("Normal")}));
}

constexpr SocketDecl kVectorInputs[] = {
    {"Vector", Color, 0.0f}, {"Midlevel", Float, 0.0f}, {"Scale", Float, 1.0f}};
constexpr std::string_view kVectorSpaces[] = {"TANGENT", "OBJECT", "WORLD"};
constexpr EnumDecl kVectorSettings[] = {{"space", kVectorSpaces}};

constexpr Operation kScaled =
    pure<[](vec3 v, float midlevel, float scale) { return (v - midlevel) * scale; }>;
constexpr Operation kFromObject =
    at_point<[](const Context& c, vec3 v) { return mat3(c.point.object->to_world) * v; }>;

// `data`: the slot of the tangents. Green is up.
vec3 from_tangents(const Context& c, vec3 v) {
  const mat3 linear(c.point.object->to_world);
  const vec3 n = safe_normalize(glm::transpose(linear) * c.point.facing(c.point.ns));
  const vec4 tangent = c.point.attribute(c.data);
  const vec3 beside = tangent.w * safe_normalize(cross(n, vec3(tangent)));
  return linear * (v.x * vec3(tangent) + v.y * n + v.z * beside);
}

void emit_vector_displacement(NodeEmitter& e) {
  const std::string space = e.property("space", "TANGENT");
  const Value v = e.emit(kScaled, {e.input("Vector"), e.input("Midlevel"), e.input("Scale")});
  e.output("Displacement", space == "WORLD"    ? v
                           : space == "OBJECT" ? e.emit(kFromObject, {v})
                                               : e.unshifted().emit(by_side<&from_tangents>, {v},
                                                                    e.attribute("tangent:")));
}

}  // namespace

std::span<const NodeDecl> displacement_nodes() {
  static const NodeDecl kNodes[] = {
      {"DISPLACEMENT", kInputs, kDisplacement, &emit_displacement, nullptr, MixOp::None, kSettings},
      {"VECTOR_DISPLACEMENT", kVectorInputs, kDisplacement, &emit_vector_displacement, nullptr,
       MixOp::None, kVectorSettings},
  };
  return kNodes;
}

}  // namespace janus
