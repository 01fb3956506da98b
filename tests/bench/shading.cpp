// SPDX-License-Identifier: GPL-3.0-or-later
//
// What it takes to shade a point: `janus_shading_bench` prints a JSON object of nanoseconds by
// material. Each evaluation is of a point and a view of its own, as in a render, on one thread.
#include <algorithm>
#include <chrono>
#include <cstdio>

#include "janus/math/hash.h"
#include "support/scene_kit.h"
#include "support/statistics.h"

namespace janus::test {
namespace {

constexpr int kPoints = 1 << 15, kRounds = 9;

Image noise(int size, uint32_t seed) {
  Image image(size, size, 4);
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    image.pixels[i] = static_cast<float>(hash32(seed + static_cast<uint32_t>(i)) >> 24) / 255.0f;
  }
  image.pack();
  return image;
}

NodeGraph principled() {
  return single("BSDF_PRINCIPLED",
                {{"Base Color", vec4(0.6f, 0.4f, 0.3f, 1)}, {"Roughness", 0.4f}});
}

// Base colour and roughness from pictures, the normal from another one.
NodeGraph textured() {
  NodeGraph graph = principled();
  const auto picture = [&](const std::string& name) {
    Node n = node(name, "TEX_IMAGE", {{"Vector", link("Where", "UV")}});
    n.properties = {{"image", name}, {"interpolation", std::string("Linear")}};
    graph.nodes.push_back(n);
  };
  graph.nodes[0].inputs["Base Color"] = link("colors", "Color");
  graph.nodes[0].inputs["Roughness"] = link("rough", "Color");
  graph.nodes[0].inputs["Normal"] = link("Bent", "Normal");
  picture("colors");
  picture("rough");
  picture("normals");
  graph.nodes.push_back(node("Where", "TEX_COORD", {}));
  graph.nodes.push_back(
      node("Bent", "NORMAL_MAP", {{"Strength", 1.0f}, {"Color", link("normals", "Color")}}));
  return graph;
}

// The tree of scenes/procedural.py, but for constants and colours.
NodeGraph procedural() {
  NodeGraph graph = principled();
  const auto add = [&](const char* name, const char* type, std::map<std::string, NodeInput> inputs,
                       std::map<std::string, NodeProperty> properties = {}) {
    Node n = node(name, type, std::move(inputs));
    n.properties = std::move(properties);
    graph.nodes.push_back(n);
  };
  const auto text = [](const char* s) { return std::string(s); };
  const auto ramp = [&](const char* name, const NodeInput& factor) {
    std::vector<float> table;
    for (int i = 0; i < 4 * 256; ++i) {
      table.push_back(static_cast<float>(i / 4) / 255.0f);
    }
    add(name, "VALTORGB", {{"Fac", factor}}, {{"table", table}, {"interpolation", text("LINEAR")}});
  };
  const auto mix = [&](const char* name, const NodeInput& factor, const NodeInput& a, vec4 b) {
    add(name, "MIX", {{"Factor_Float", factor}, {"A_Color", a}, {"B_Color", b}},
        {{"data_type", text("RGBA")}, {"blend_type", text("MIX")}, {"clamp_factor", true}});
  };
  const auto levels = [&](const char* name, const NodeInput& value, float low, float high) {
    add(name, "MAP_RANGE", {{"Value", value}, {"From Min", low}, {"From Max", high}},
        {{"clamp", true}, {"interpolation_type", text("LINEAR")}, {"data_type", text("FLOAT")}});
  };
  const auto vector = [&](const char* name, const char* operation, const NodeInput& a,
                          const NodeInput& b) {
    add(name, "VECT_MATH", {{"Vector", a}, {"Vector_001", b}}, {{"operation", text(operation)}});
  };
  const std::map<std::string, NodeProperty> fbm = {
      {"noise_dimensions", text("3D")}, {"noise_type", text("FBM")}, {"normalize", true}};
  const auto cells = [&](const char* name, const char* feature) {
    add(name, "TEX_VORONOI", {{"Vector", link("warped", "Vector")}, {"Scale", 2.5f}},
        {{"voronoi_dimensions", text("3D")},
         {"feature", text(feature)},
         {"distance", text("EUCLIDEAN")}});
  };
  add("where", "TEX_COORD", {});
  add("place", "MAPPING", {{"Vector", link("where", "Object")}, {"Scale", vec3(2.0f)}},
      {{"vector_type", text("POINT")}});
  add("away", "TEX_NOISE", {{"Vector", link("place", "Vector")}, {"Scale", 1.5f}, {"Detail", 2.0f}},
      fbm);
  vector("centred", "SUBTRACT", link("away", "Color"), vec3(0.5f));
  vector("scaled", "MULTIPLY", link("centred", "Vector"), vec3(0.4f));
  vector("warped", "ADD", link("place", "Vector"), link("scaled", "Vector"));
  add("clouds", "TEX_NOISE",
      {{"Vector", link("warped", "Vector")}, {"Scale", 1.2f}, {"Detail", 6.0f}}, fbm);
  add("ridges", "TEX_NOISE",
      {{"Vector", link("warped", "Vector")}, {"Scale", 2.0f}, {"Detail", 4.0f}},
      {{"noise_dimensions", text("3D")}, {"noise_type", text("RIDGED_MULTIFRACTAL")}});
  cells("cells", "F1");
  cells("edges", "DISTANCE_TO_EDGE");
  add("veins", "TEX_WAVE",
      {{"Vector", link("warped", "Vector")}, {"Scale", 1.1f}, {"Distortion", 3.0f}},
      {{"wave_type", text("BANDS")}, {"bands_direction", text("X")}});
  ramp("light", link("clouds", "Fac"));
  ramp("bands", link("veins", "Fac"));
  mix("plain", link("light", "Color"), vec4(0.2f, 0.1f, 0.06f, 1), vec4(0.6f, 0.3f, 0.2f, 1));
  mix("veined", link("bands", "Color"), link("plain", "Result_Color"), vec4(0.7f, 0.7f, 0.6f, 1));
  levels("crack", link("edges", "Distance"), 0.0f, 0.06f);
  mix("cracked", link("crack", "Result"), link("veined", "Result_Color"), vec4(0.05f));
  levels("hollow", link("ridges", "Fac"), 0.2f, 1.2f);
  add("facing", "LAYER_WEIGHT", {{"Blend", 0.3f}});
  add("dust", "MATH",
      {{"Value", link("hollow", "Result")}, {"Value_001", link("facing", "Facing")}},
      {{"operation", text("MULTIPLY")}});
  mix("dusty", link("dust", "Value"), link("cracked", "Result_Color"), vec4(0.5f));
  add("bright", "BRIGHTCONTRAST",
      {{"Color", link("dusty", "Result_Color")}, {"Bright", 0.02f}, {"Contrast", 0.05f}});
  add("tinted", "HUE_SAT", {{"Color", link("bright", "Color")}, {"Saturation", 0.9f}});
  levels("grain", link("cells", "Distance"), 0.0f, 0.8f);
  add("rough", "MATH", {{"Value", link("grain", "Result")}, {"Value_001", 0.35f}},
      {{"operation", text("MAXIMUM")}});
  add("height", "MATH",
      {{"Value", link("crack", "Result")},
       {"Value_001", 0.5f},
       {"Value_002", link("clouds", "Fac")}},
      {{"operation", text("MULTIPLY_ADD")}});
  add("displaced", "DISPLACEMENT", {{"Height", link("height", "Value")}, {"Scale", 0.05f}},
      {{"space", text("OBJECT")}});
  add("bumped", "BUMP",
      {{"Height", link("ridges", "Fac")}, {"Strength", 0.4f}, {"Distance", 0.02f}});
  graph.nodes[0].inputs["Base Color"] = link("tinted", "Color");
  graph.nodes[0].inputs["Roughness"] = link("rough", "Value");
  graph.nodes[0].inputs["Normal"] = link("bumped", "Normal");
  graph.displacement = NodeLink{"displaced", "Displacement"};
  return graph;
}

// Median over the rounds, nanoseconds.
double measure(const NodeGraph& material) {
  SceneKit kit;
  for (const char* name : {"colors", "rough", "normals"}) {
    kit.builder.set_image(name, {name, std::make_shared<Image>(noise(1024, name[0])), true});
  }
  MeshDesc mesh = ball(1.0f, 64, true);
  for (const char* key : {"uv:", "tangent:"}) {
    AttributeDesc attribute;
    attribute.key = key;
    attribute.channels = key[0] == 'u' ? 2 : 4;
    for (size_t i = 0; i < mesh.positions.size() * static_cast<size_t>(attribute.channels); ++i) {
      attribute.values.push_back(static_cast<float>(hash32(static_cast<uint32_t>(i)) >> 8) *
                                 0x1p-24f);
    }
    mesh.attributes.push_back(attribute);
  }
  kit.add("ball", mesh, material).camera({0, -4, 0}, {0, 0, 0});
  const auto scene = kit.build();
  for (const Diagnostic& d : scene->diagnostics) {
    std::fprintf(stderr, "%s: %s\n", d.node.c_str(), d.message.c_str());
  }
  std::vector<SurfaceInteraction> hits;
  std::vector<vec3> views;
  Random random(1);
  while (hits.size() < kPoints) {
    const vec3 d = random.direction();
    if (const auto hit = scene->intersect(Ray{3.0f * d, -d})) {
      hits.push_back(*hit);
      views.push_back(d);
    }
  }
  std::vector<double> times;
  float sum = 0.0f;  // so that nothing is left out
  ShadingResult result;
  for (int round = 0; round < kRounds; ++round) {
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < kPoints; ++i) {
      scene->shade(hits[i], views[i], result);
      sum += result.bsdf.albedo();
    }
    const std::chrono::duration<double, std::nano> taken = std::chrono::steady_clock::now() - start;
    times.push_back(taken.count() / kPoints);
  }
  std::sort(times.begin(), times.end());
  return sum > 0.0f ? times[kRounds / 2] : 0.0;
}

}  // namespace
}  // namespace janus::test

int main() {
  using namespace janus::test;
  auto flat = procedural();  // without the bumps
  flat.displacement.reset();
  flat.nodes[0].inputs.erase("Normal");
  std::printf("{\"constant\": %.1f, \"textured\": %.1f, \"procedural\": %.1f, \"flat\": %.1f}\n",
              measure(principled()), measure(textured()), measure(procedural()), measure(flat));
}
