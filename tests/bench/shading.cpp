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

constexpr int kPoints = 1 << 16, kRounds = 9;

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
  std::printf("{\"constant\": %.1f, \"textured\": %.1f}\n", measure(principled()),
              measure(textured()));
}
