// SPDX-License-Identifier: GPL-3.0-or-later
//
// Scenes that ask for the path (PathSoFar), for the tests of pictures and of weights.
#pragma once

#include "support/scene_kit.h"

namespace janus::test {

// `a`, or `b` where an output of Light Path is above a limit; each a graph of one node.
inline NodeGraph by_count(const std::string& output, float limit, const NodeGraph& a,
                          const NodeGraph& b) {
  NodeGraph graph = combine("MIX_SHADER", a, b);
  graph.nodes.push_back(node("Path", "LIGHT_PATH", {}));
  graph.nodes.push_back(
      node("Above", "MATH", {{"Value", link("Path", output)}, {"Value_001", limit}}));
  graph.nodes.back().properties["operation"] = std::string("GREATER_THAN");
  graph.nodes[2].inputs["Fac"] = link("Above", "Value");
  return graph;
}

inline NodeGraph glossy(Rgb color, float roughness) {
  return single("BSDF_GLOSSY", {{"Color", vec4(color, 1)}, {"Roughness", roughness}});
}

// Nodes at the far end of Light Falloff: how bright something is by its distance.
inline NodeGraph by_falloff(const std::string& output, float strength) {
  NodeGraph graph = diffuse(Rgb(0.5f));
  graph.nodes.push_back(
      node("Falloff", "LIGHT_FALLOFF", {{"Strength", strength}, {"Smooth", 0.3f}}));
  graph.nodes.front().inputs["Color"] = link("Falloff", output);
  return graph;
}

inline LightDesc lamp_of_paths() { return area_light({0, 0, 0.9f}, {0, 0, 0}, 0.5f, 20); }

// A room where each surface is another one to each kind of path.
inline SceneKit surfaces_by_path() {
  return open_box()
      .add("deep", plane(1.9f, 1.9f),
           by_count("Ray Depth", 0.5f, diffuse(Rgb(0.8f, 0.3f, 0.2f)),
                    diffuse(Rgb(0.2f, 0.3f, 0.8f))),
           translation({0, 0, -0.98f}))
      .add("diffused", cuboid({-0.7f, -0.2f, -0.95f}, {-0.2f, 0.4f, 0.1f}),
           by_count("Diffuse Depth", 0.5f, glossy(Rgb(0.8f), 0.4f), diffuse(Rgb(0.7f, 0.8f, 0.3f))))
      .add("mirrored", cuboid({0.2f, -0.6f, -0.95f}, {0.7f, 0.0f, -0.4f}),
           by_count("Glossy Depth", 0.5f, diffuse(Rgb(0.2f, 0.7f, 0.7f)), glossy(Rgb(0.9f), 0.5f)))
      .add("far", plane(0.9f, 0.9f), by_falloff("Linear", 0.3f),
           translation({0.5f, 0.9f, 0.3f}) * rotation({1, 0, 0}, 1.4f))
      .add("glass", ball(0.25f, 10, true), single("BSDF_GLASS", {{"Roughness", 0.4f}}),
           translation({-0.2f, -0.5f, -0.5f}))
      .add("through", plane(0.8f, 0.8f),
           by_count("Transmission Depth", 0.5f, diffuse(Rgb(0.6f)),
                    glossy(Rgb(0.9f, 0.4f, 0.6f), 0.6f)),
           translation({-0.5f, 0.8f, 0.2f}) * rotation({1, 0, 0}, 1.5f))
      .add("mirror", plane(0.6f, 1.2f), mirror(Rgb(0.9f)),
           translation({0.95f, 0.1f, 0}) * rotation({0, 1, 0}, -1.5f))
      .light("lamp", lamp_of_paths());
}

// A lamp that glows otherwise to each, and a plain one that light paths start on.
inline SceneKit emitters_by_path() {
  const auto glow = [](Rgb color, float strength) { return emission(color, strength); };
  return room()
      .add("deep", plane(0.6f, 0.4f),
           by_count("Ray Depth", 1.5f, glow(Rgb(1, 0.7f, 0.5f), 4), glow(Rgb(0.3f, 0.5f, 1), 9)),
           translation({0.3f, 0.2f, 0.8f}))
      .add("diffused", plane(0.4f, 0.4f),
           by_count("Diffuse Depth", 0.5f, glow(Rgb(1), 5), glow(Rgb(0.1f, 1, 0.2f), 8)),
           translation({-0.5f, 0.3f, 0.7f}) * rotation({0, 1, 0}, 0.4f))
      .add("mirrored", plane(0.5f, 0.3f),
           by_count("Glossy Depth", 0.5f, glow(Rgb(1), 1), glow(Rgb(1, 0.1f, 0.2f), 8)),
           translation({0.5f, 0.6f, 0.2f}) * rotation({1, 0, 0}, 1.2f))
      .add("metal", ball(0.3f, 10, true), glossy(Rgb(0.9f), 0.4f), translation({0, -0.2f, 0.3f}))
      .light("lamp", point_light({0.2f, -0.5f, 0.5f}, 5, 0.15f));
}

// Leaves of which the second is opaque, and veils that thin out with the distance.
inline SceneKit crossings_by_path() {
  const NodeGraph clear = single("BSDF_TRANSPARENT", {{"Color", vec4(0.9f, 0.8f, 0.6f, 1)}});
  const NodeGraph leaf = by_count("Transparent Depth", 0.5f, clear, diffuse(Rgb(0.3f, 0.8f, 0.4f)));
  SceneKit kit = room();
  for (int i = 0; i < 3; ++i) {
    const auto shift = static_cast<float>(i);
    kit.add("leaf" + std::to_string(i), plane(0.9f, 0.9f), leaf,
            translation({0.3f - 0.3f * shift, 0, 0.35f + 0.15f * shift}));
  }
  return kit
      .add("near", plane(0.7f, 0.9f), by_count("Ray Length", 1.3f, clear, glossy(Rgb(0.8f), 0.5f)),
           translation({-0.4f, -0.7f, -0.2f}) * rotation({1, 0, 0}, 1.4f))
      .add("deep", plane(0.7f, 0.7f),
           by_count("Ray Depth", 1.5f, diffuse(Rgb(0.8f, 0.4f, 0.3f)), clear),
           translation({0.5f, -0.6f, -0.1f}) * rotation({1, 0, 0}, 1.2f))
      .add(
          "glow", plane(0.4f, 0.4f),
          by_count("Transparent Depth", 0.5f, emission(Rgb(1), 2), emission(Rgb(1, 0.2f, 0.1f), 6)),
          translation({-0.6f, 0.5f, 0.2f}) * rotation({1, 0, 0}, 1.2f))
      .light("lamp", lamp_of_paths());
}

inline SceneKit lamp_by_path(SceneKit kit, const std::string& output, float limit) {
  LightDesc lamp = area_light({0.3f, -0.2f, 0.9f}, {0, 0, 0}, 0.4f, 10);
  lamp.graph =
      by_count(output, limit, emission(Rgb(1, 0.8f, 0.6f), 1), emission(Rgb(0.2f, 0.4f, 1), 3));
  return kit.light(output, lamp);
}

inline SceneKit world_by_path(SceneKit kit) {
  const auto sky = [](Rgb color) {
    NodeGraph g = single("BACKGROUND", {{"Color", vec4(color, 1)}});
    g.surface = NodeLink{"Shader", "Background"};
    return g;
  };
  kit.builder.set_world(
      {"World", by_count("Diffuse Depth", 1.5f, sky(Rgb(0.5f, 0.7f, 1)), sky(Rgb(2, 1, 0.5f)))});
  return kit;
}

}  // namespace janus::test
