// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a shader is told about the surface: attributes, geometry, tangents.
#include "janus/shading/node_emitter.h"
#include "janus/shading/nodes/families.h"
#include "janus/shading/point_reads.h"
#include "janus/shading/rotation.h"

namespace janus {

namespace {

using enum SocketType;

constexpr Operation kAttributeAlpha =
    at_point<[](const Context& c) { return c.point.attribute(c.data).w; }>;
constexpr Operation kAttributeFactor =
    at_point<[](const Context& c) { return c.point.attribute_factor(c.data); }>;

// --- Attributes ----------------------------------------------------------------------------------

constexpr std::string_view kUv[] = {"UV"}, kColorAlpha[] = {"Color", "Alpha"},
                           kAttributeOutputs[] = {"Color", "Vector", "Fac", "Alpha"};

void emit_uv_map(NodeEmitter& e) {
  const std::string key = e.flag("from_instancer") ? "dupli_uv" : "uv:" + e.property("uv_map");
  e.output("UV", e.emit(kAttribute, {}, e.attribute(key)));
}

// Some names mean what Cycles knows of a mesh, and not an attribute of that name.
std::string geometry_key(const std::string& name) {
  constexpr std::pair<std::string_view, std::string_view> kKnown[] = {
      {"N", "normal"},
      {"uv", "uv:"},
      {"generated", "generated"},
      {"tangent", "tangent:"},
      {"tangent_sign", "tangent_sign:"},
      {"vertex_color", "color:"},
      {"pointiness", "pointiness"},
      {"random_per_island", "random_per_island"},
  };
  for (const auto& [known, key] : kKnown) {
    if (name == known) {
      return std::string(key);
    }
  }
  for (const std::string kind : {"tangent", "tangent_sign"}) {
    if (name.ends_with("." + kind)) {
      return kind + ":" + name.substr(0, name.size() - kind.size() - 1);
    }
  }
  return "attribute:" + name;
}

// Constants, which whoever wrote the graph has looked up.
void emit_found(NodeEmitter& e, const std::vector<float>& value) {
  const vec3 rgb(value[0], value[1], value[2]);
  e.output("Color", e.convert(e.constant(rgb), Color));
  e.output("Vector", e.constant(rgb));
  e.output("Fac", e.constant(average(rgb)));
  e.output("Alpha", e.constant(value[3]));
}

constexpr std::string_view kKinds[] = {"GEOMETRY", "OBJECT", "INSTANCER", "VIEW_LAYER"};
constexpr EnumDecl kKind[] = {{"attribute_type", kKinds}};

// Normals of vertices, in world space where the graph says so: as Cycles has them from Blender 5.1
// on.
Value in_world(NodeEmitter& e, Value value, const std::string& key) {
  constexpr static Operation kToWorld = at_point<[](const Context& c, vec3 v) {
    return length(v) * safe_normalize(c.point.object->normal_to_world * v);
  }>;
  return key == "normal" && e.flag("world_normals") ? e.emit(kToWorld, {value}) : value;
}

void emit_attribute(NodeEmitter& e) {
  const std::string kind = e.property("attribute_type", "GEOMETRY");
  const std::string name = e.property("attribute_name");
  if (kind == "VIEW_LAYER") {
    const std::vector<float>* value = e.list("value");
    emit_found(e, value && value->size() == 4 ? *value : std::vector<float>(4, 0.0f));
    return;
  }
  const std::string key = kind == "OBJECT"      ? "object:" + name
                          : kind == "INSTANCER" ? "instancer:" + name
                                                : geometry_key(name);
  const uint32_t slot = e.attribute(key);
  const Value value = in_world(e, e.emit(kAttribute, {}, slot), key);
  e.output("Color", e.convert(value, Color));
  e.output("Vector", value);
  e.output("Fac", key == "normal" ? e.convert(value, Float) : e.emit(kAttributeFactor, {}, slot));
  // The handedness of a tangent is no alpha.
  const bool tangent = key.starts_with("tangent:");
  e.output("Alpha", tangent ? e.constant(1.0f) : e.emit(kAttributeAlpha, {}, slot));
}

void emit_color_attribute(NodeEmitter& e) {
  const std::string name = e.property("layer_name");
  const std::string key = name.empty() ? "color:" : geometry_key(name);
  const uint32_t slot = e.attribute(key);
  e.output("Color", e.convert(in_world(e, e.emit(kAttribute, {}, slot), key), Color));
  e.output("Alpha", e.emit(kAttributeAlpha, {}, slot));
}

// --- Geometry ------------------------------------------------------------------------------------

constexpr std::string_view kGeometry[] = {"Position",    "Normal",     "Tangent",
                                          "True Normal", "Incoming",   "Parametric",
                                          "Backfacing",  "Pointiness", "Random Per Island"};
constexpr Operation kTrueNormal =
    by_side<[](const Context& c) { return c.point.facing(c.point.ng); }>;
constexpr Operation kIncoming = by_view<[](const Context& c) { return c.point.view; }>;
constexpr Operation kBackfacing =
    by_side<[](const Context& c) { return c.point.backfacing() ? 1.0f : 0.0f; }>;

constexpr Operation kTangentOnSurface = by_side<&read_on_surface>;

Value radial_tangent(NodeEmitter& e, int axis) {
  NodeEmitter here = e.unshifted();
  return here.emit(kRadialTangent[axis], {here.emit(kAttribute, {}, e.attribute("generated"))});
}

void emit_geometry(NodeEmitter& e) {
  e.output("Position", e.emit(kPosition, {}));
  e.output("Normal", e.emit(kFacingNormal, {}));
  e.output("Tangent", radial_tangent(e, 2));
  e.output("True Normal", e.emit(kTrueNormal, {}));
  e.output("Incoming", e.emit(kIncoming, {}));
  e.output("Parametric", e.emit(kParametric, {}));
  e.output("Backfacing", e.emit(kBackfacing, {}));
  for (const auto& [output, key] : {std::pair("Pointiness", "pointiness"),
                                    std::pair("Random Per Island", "random_per_island")}) {
    if (e.output_linked(output)) {  // they take a while to compute
      e.output(output, e.emit(kAttributeFactor, {}, e.attribute(key)));
    }
  }
}

// --- Wireframe -----------------------------------------------------------------------------------

constexpr SocketDecl kWireframeInputs[] = {{"Size", Float, 0.01f}};
constexpr std::string_view kWireframe[] = {"Fac"};

// Is a side of the triangle at most half of `size` away? `offset`: how far from the point one looks
// from. `data`: 1, sizes are pixels, by what the viewer sees of the pixel's sides.
float wireframe(const Context& c, float size, vec3 offset) {
  const ShadingPoint& point = c.point;
  if (point.on_curve) {
    return 0.0f;
  }
  float half = 0.5f * size;
  if (c.data != 0) {
    const auto seen = [&](vec3 side) {
      return glm::length(side - dot(side, point.view) * point.view);
    };
    half *= 0.5f * (seen(point.step(0)) + seen(point.step(1)));
  }
  const vec3 corners[] = {vec3(0.0f), point.edge_u, point.edge_v};
  const vec3 p = point.barycentric.x * point.edge_u + point.barycentric.y * point.edge_v + offset;
  for (int i = 0; i < 3; ++i) {
    const vec3 side = corners[i] - corners[(i + 2) % 3];
    if (length2(cross(side, p - corners[i])) < length2(side) * half * half) {
      return 1.0f;
    }
  }
  return 0.0f;
}

void emit_wireframe(NodeEmitter& e) {
  if (e.seen().of != SeenTree::Of::Surface) {
    e.output("Fac", e.constant(0.0f));
    return;
  }
  e.use_edges();
  NodeEmitter here = e.unshifted();
  const Value offset = e.emit(pure<[](vec3 a, vec3 b) { return a - b; }>,
                              {e.emit(kPosition, {}), here.emit(kPosition, {})});
  const bool pixels = e.flag("use_pixel_size");
  e.output("Fac", here.emit(pixels ? by_view<&wireframe> : at_point<&wireframe>,
                            {e.input("Size"), e.shifted() ? offset : e.constant(vec3(0.0f))},
                            pixels ? 1 : 0));
}

// --- Tangent -------------------------------------------------------------------------------------

constexpr std::string_view kTangent[] = {"Tangent"};

constexpr std::string_view kDirections[] = {"RADIAL", "UV_MAP"}, kAxes[] = {"Z", "X", "Y"};
constexpr EnumDecl kDirection[] = {{"direction_type", kDirections}, {"axis", kAxes}};

void emit_tangent(NodeEmitter& e) {
  if (e.property("direction_type", "RADIAL") == "UV_MAP") {
    const uint32_t slot = e.attribute("tangent:" + e.property("uv_map"));
    NodeEmitter here = e.unshifted();
    e.output("Tangent", here.emit(kTangentOnSurface, {here.emit(kAttribute, {}, slot)}));
    return;
  }
  const std::string axis = e.property("axis", "Z");
  e.output("Tangent", radial_tangent(e, axis == "X" ? 0 : axis == "Y" ? 1 : 2));
}

// --- Curves Info ---------------------------------------------------------------------------------

constexpr std::string_view kCurvesInfo[] = {"Is Strand", "Intercept",      "Length",
                                            "Thickness", "Tangent Normal", "Random"};

// To the viewer, across the curve.
constexpr Operation kTangentNormal = by_view<[](const Context& c) {
  const vec3 along = c.point.edge_u, view = c.point.view;
  const float length2 = dot(along, along);
  if (!c.point.on_curve || !(length2 > 0.0f)) {
    return vec3(0.0f);
  }
  const vec3 across = view - along * (dot(along, view) / length2);
  const float length = glm::length(across);
  return length == 0.0f ? vec3(0.0f) : across / length;
}>;
// By the mean size of the object: a length along the diagonal.
constexpr Operation kThickness = at_point<[](const Context& c) {
  const vec3 diagonal(2.0f * c.point.attribute(c.data).x / std::sqrt(3.0f));
  return c.point.object ? glm::length(mat3(c.point.object->to_world) * diagonal) : 0.0f;
}>;

void emit_curves_info(NodeEmitter& e) {
  e.output("Is Strand", e.emit(kOnCurve, {}));
  e.output("Random", e.emit(kStrand, {e.constant(0.0f)}));
  e.output("Tangent Normal", e.emit(kTangentNormal, {}));
  for (const auto& [output, key] :
       {std::pair("Intercept", "curve_intercept"), std::pair("Length", "curve_length"),
        std::pair("Thickness", "curve_radius")}) {
    if (e.output_linked(output)) {
      const bool thickness = std::string_view(output) == "Thickness";
      e.output(output, e.emit(thickness ? kThickness : kAttributeFactor, {}, e.attribute(key)));
    }
  }
}

// --- Point Info, Particle Info -------------------------------------------------------------------

constexpr std::string_view kPointInfo[] = {"Position", "Radius", "Random"};

constexpr Operation kCentre = at_point<[](const Context& c) { return c.point.centre(); }>;
constexpr Operation kBallRadius = at_point<[](const Context& c) {
  const vec3 diagonal(c.point.attribute(c.data).x / std::sqrt(3.0f));
  return glm::length(mat3(c.point.object->to_world) * diagonal);
}>;
constexpr Operation kBallRandom = at_point<[](const Context& c) {
  return c.point.on_ball ? jenkins_number(std::array{c.point.triangle.face, 0U}) : 0.0f;
}>;

void emit_point_info(NodeEmitter& e) {
  e.output("Position", e.emit(kCentre, {}));
  if (e.output_linked("Radius")) {
    e.output("Radius", e.emit(kBallRadius, {}, e.attribute("point_radius")));
  }
  e.output("Random", e.emit(kBallRandom, {}));
}

constexpr std::string_view kParticleInfo[] = {"Index",    "Random", "Age",      "Lifetime",
                                              "Location", "Size",   "Velocity", "Angular Velocity"};

// What is no instance of a particle has noughts, as the first particle would.
constexpr Operation kHashed =
    pure<[](float index) { return jenkins_number(std::array{static_cast<uint32_t>(index), 0U}); }>;

void emit_particle_info(NodeEmitter& e) {
  const auto read = [&](const char* key) { return e.emit(kAttribute, {}, e.attribute(key)); };
  const auto part = [&](Value v, int i) {
    constexpr static Operation kPart = pure<[](vec3 v, float i) { return v[static_cast<int>(i)]; }>;
    return e.emit(kPart, {v, e.constant(static_cast<float>(i))});
  };
  if (e.output_linked("Index") || e.output_linked("Random") || e.output_linked("Age")) {
    const Value times = read("particle:times");
    e.output("Index", part(times, 0));
    e.output("Random", e.emit(kHashed, {part(times, 0)}));
    e.output("Age", part(times, 1));
  }
  for (const auto& [output, key] :
       {std::pair("Lifetime", "particle:lifetime"), std::pair("Size", "particle:size"),
        std::pair("Location", "particle:location"), std::pair("Velocity", "particle:velocity"),
        std::pair("Angular Velocity", "particle:angular_velocity")}) {
    if (e.output_linked(output)) {
      const Value value = read(key);
      const bool number =
          output == std::string_view("Lifetime") || output == std::string_view("Size");
      e.output(output, number ? part(value, 0) : value);
    }
  }
}

}  // namespace

std::span<const NodeDecl> geometry_nodes() {
  static const NodeDecl kNodes[] = {
      {"UVMAP", {}, kUv, &emit_uv_map},
      {"ATTRIBUTE", {}, kAttributeOutputs, &emit_attribute, nullptr, MixOp::None, kKind},
      {"VERTEX_COLOR", {}, kColorAlpha, &emit_color_attribute},
      {"NEW_GEOMETRY", {}, kGeometry, &emit_geometry},
      {"WIREFRAME", kWireframeInputs, kWireframe, &emit_wireframe},
      {"HAIR_INFO", {}, kCurvesInfo, &emit_curves_info},
      {"POINT_INFO", {}, kPointInfo, &emit_point_info},
      {"PARTICLE_INFO", {}, kParticleInfo, &emit_particle_info},
      {"TANGENT", {}, kTangent, &emit_tangent, nullptr, MixOp::None, kDirection},
  };
  return kNodes;
}

}  // namespace janus
