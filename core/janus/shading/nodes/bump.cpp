// SPDX-License-Identifier: GPL-3.0-or-later
//
// Normals from pictures: Normal Map, Bump. Results look at the viewer, as Cycles' normals do.
#include <algorithm>
#include <cmath>

#include "janus/shading/node_emitter.h"
#include "janus/shading/nodes/bump.h"
#include "janus/shading/nodes/families.h"
#include "janus/shading/point_reads.h"
#include "janus/shading/rotation.h"

namespace janus {

namespace {

using enum SocketType;

constexpr std::string_view kNormal[] = {"Normal"};

// --- Normal Map ----------------------------------------------------------------------------------

constexpr SocketDecl kMapInputs[] = {{"Strength", Float, 1.0f},
                                     {"Color", Color, vec3(0.5f, 0.5f, 1.0f)}};

vec3 decoded(vec3 color) { return 2.0f * (color - 0.5f); }

// On the viewer's side, and never nothing.
vec3 usable(const ShadingPoint& point, vec3 front) {
  const vec3 n = point.facing(safe_normalize(front));
  return is_black(n) || !is_finite(n) ? point.facing(point.ns) : n;
}

vec3 weaken(const ShadingPoint& point, vec3 n, float strength) {
  if (strength == 1.0f) {
    return n;
  }
  const vec3 plain = point.facing(point.ns);
  const vec3 mixed = safe_normalize(plain + (n - plain) * std::max(strength, 0.0f));
  return is_black(mixed) ? plain : mixed;
}

// `data`: the slot of the tangents. Their fourth channel is the handedness.
vec3 tangent_map(const Context& c, float strength, vec3 color) {
  vec3 m = decoded(color);
  m.x *= strength;
  m.y *= strength;
  m.z += (1.0f - std::clamp(strength, 0.0f, 1.0f)) * (1.0f - m.z);
  const vec4 tangent = c.point.attribute(c.data);
  const vec3 n = c.point.object_normal;  // in object space: that is where the map was made
  const vec3 b = tangent.w * cross(n, vec3(tangent));
  const vec3 mapped = safe_normalize(m.x * vec3(tangent) + m.y * b + m.z * n);
  return usable(c.point, c.point.object->normal_to_world * mapped);
}
vec3 object_map(const Context& c, float strength, vec3 color) {
  const vec3 n = c.point.object->normal_to_world * decoded(color);
  return weaken(c.point, usable(c.point, n), strength);
}
vec3 blender_object_map(const Context& c, float strength, vec3 color) {
  const vec3 n = c.point.object->normal_to_world * (decoded(color) * vec3(1, -1, -1));
  return weaken(c.point, usable(c.point, n), strength);
}
vec3 world_map(const Context& c, float strength, vec3 color) {
  return weaken(c.point, usable(c.point, decoded(color)), strength);
}
vec3 blender_world_map(const Context& c, float strength, vec3 color) {
  return weaken(c.point, usable(c.point, decoded(color) * vec3(1, -1, -1)), strength);
}

constexpr std::string_view kSpaces[] = {"TANGENT", "OBJECT", "WORLD", "BLENDER_OBJECT",
                                        "BLENDER_WORLD"};
// DirectX has green point down. What is displaced is not there yet: the bases are the same.
constexpr std::string_view kConventions[] = {"OPENGL", "DIRECTX"},
                           kBases[] = {"ORIGINAL", "DISPLACED"};
constexpr EnumDecl kMapSettings[] = {
    {"space", kSpaces}, {"convention", kConventions}, {"base", kBases}};

constexpr Operation kFlipGreen =
    pure<[](vec3 color) { return vec3(color.x, 1.0f - color.y, color.z); }>;

void emit_normal_map(NodeEmitter& e) {
  const std::string space = e.property("space", "TANGENT");
  const Value strength = e.input("Strength");
  Value color = e.input("Color");
  if (e.property("convention", "OPENGL") == "DIRECTX") {
    color = e.emit(kFlipGreen, {color});
  }
  const bool tangent = space == "TANGENT";
  const Operation& operation = tangent                     ? by_side<&tangent_map>
                               : space == "OBJECT"         ? by_side<&object_map>
                               : space == "BLENDER_OBJECT" ? by_side<&blender_object_map>
                               : space == "WORLD"          ? by_side<&world_map>
                                                           : by_side<&blender_world_map>;
  const uint32_t slot = tangent ? e.attribute("tangent:" + e.property("uv_map")) : 0;
  e.output("Normal", e.unshifted().emit(operation, {strength, color}, slot));
}

// --- Bump ----------------------------------------------------------------------------------------

constexpr SocketDecl kBumpInputs[] = {{"Strength", Float, 1.0f},
                                      {"Distance", Float, 1.0f},
                                      {"Filter Width", Float, 0.1f},
                                      {"Height", Float, 1.0f, true},
                                      {"Normal", Vector, Implicit::Normal}};

// Perturbed by the slope of a height (M. Mikkelsen, Bump Mapping Unparametrized Surfaces on the
// GPU): the height here and `width` pixels away along two tangents. `data`: 1, the height is a
// depth.
vec3 bump(const Context& c, float strength, float distance, float width, float height,
          float height_x, float height_y, vec3 normal) {
  const vec3 n = c.point.facing(normal);  // a hill is a hill from behind too
  const vec3 dx = c.point.step(0), dy = c.point.step(1);
  const vec3 rx = cross(dy, n), ry = cross(n, dx);
  const float det = dot(dx, rx);
  const vec3 slope = (height_x - height) * rx + (height_y - height) * ry;
  distance = c.data ? -distance : distance;
  const vec3 turned =
      safe_normalize(width * std::abs(det) * n - distance * (det < 0.0f ? -1.0f : 1.0f) * slope);
  strength = std::max(strength, 0.0f);
  const vec3 mixed = safe_normalize(strength * turned + (1.0f - strength) * n);
  return is_black(mixed) || !is_finite(mixed) ? normal : c.point.facing(mixed);
}

void emit_bump(NodeEmitter& e) {
  const Value n = e.input("Normal");
  // Then Cycles leaves the node out: the normal stays as long as it is, but for a constant one.
  if (e.is_constant(e.input("Height"), nullptr)) {
    e.output("Normal", e.is_constant(n, nullptr) ? e.emit(kFacingNormal, {}) : n);
    return;
  }
  // In what displaces the surface Cycles finds no slope: it looks three times at one point.
  if (e.displaces()) {
    constexpr static Operation kUnit = pure<&safe_normalize>;
    e.output("Normal", e.emit(kUnit, {n}));
    return;
  }
  if (e.shifted()) {
    e.warn("a bump in the height of another bump is left out there");
    e.output("Normal", n);
    return;
  }
  const auto at = e.shifted_points();
  if (!at) {
    e.warn("more than " + std::to_string(kMaxFilterWidths) +
           " filter widths in a shader; this bump is left out");
    e.output("Normal", n);
    return;
  }
  e.output("Normal",
           e.emit(kBump,
                  {e.input("Strength"), e.input("Distance"), e.constant(e.filter_width()),
                   e.input("Height"), e.input("Height", *at), e.input("Height", *at + 1), n},
                  e.flag("invert") ? 1 : 0));
}

}  // namespace

constinit const Operation kBump = by_side<&bump>;

std::span<const NodeDecl> normal_nodes() {
  static const NodeDecl kNodes[] = {
      {"NORMAL_MAP", kMapInputs, kNormal, &emit_normal_map, nullptr, MixOp::None, kMapSettings},
      {"BUMP", kBumpInputs, kNormal, &emit_bump},
  };
  return kNodes;
}

}  // namespace janus
