// SPDX-License-Identifier: GPL-3.0-or-later
//
// Path tracing, light tracing and BDPT agree on surfaces that vary: with their normals, with the
// side and with the direction from which they are looked at. A value is that of the camera's side,
// whichever walk made the path; each walk's density is that of where it came from. The table of
// what a material can be, to 0.3 %, is tests/images/test_agreement.py; here are the corners that no
// light path sees, and mirrors.
#include "support/pictures.h"
#include "support/scene_kit.h"

namespace janus::test {
namespace {

Node with(Node n, const std::string& property, const std::string& value) {
  n.properties[property] = value;
  return n;
}

// A graph whose top is its last node.
NodeGraph graph(std::vector<Node> nodes, const std::string& output) {
  NodeGraph g;
  g.nodes = std::move(nodes);
  g.surface = NodeLink{g.nodes.back().name, output};
  return g;
}

Node mix(const NodeInput& factor) {
  return node("Mix", "MIX_SHADER",
              {{"Fac", factor}, {"Shader", link("A")}, {"Shader_001", link("B")}});
}
Node plain(const std::string& name, Rgb color) {
  return node(name, "BSDF_DIFFUSE", {{"Color", vec4(color, 1)}});
}
Node rough(const std::string& name, Rgb color, float roughness) {
  return node(name, "BSDF_GLOSSY", {{"Color", vec4(color, 1)}, {"Roughness", roughness}});
}

// A rough coat that grows towards grazing angles over a diffuse ground.
NodeGraph coated(float roughness) {
  return graph(
      {node("Weight", "LAYER_WEIGHT", {{"Blend", 0.7f}}), plain("A", Rgb(0.8f, 0.3f, 0.2f)),
       rough("B", Rgb(0.9f), roughness), mix(link("Weight", "Facing"))},
      "Shader");
}

// Dark from behind, and bright glass where one looks straight at it.
NodeGraph two_faced() {
  return graph({node("Geometry", "NEW_GEOMETRY", {}), plain("A", Rgb(0.8f)),
                node("B", "BSDF_TRANSLUCENT", {{"Color", vec4(0.7f, 0.8f, 0.2f, 1)}}),
                mix(link("Geometry", "Backfacing"))},
               "Shader");
}
NodeGraph rimmed_glass(float roughness) {
  return graph(
      {node("Fresnel", "FRESNEL", {{"IOR", 1.6f}}),
       node("A", "BSDF_GLASS", {{"Color", vec4(1)}, {"Roughness", roughness}, {"IOR", 1.3f}}),
       plain("B", Rgb(0.2f, 0.5f, 0.8f)), mix(link("Fresnel", "Fac"))},
      "Shader");
}

// Glows at the rim only; one looks through where it is seen from straight above.
NodeGraph glowing_rim() {
  return graph({node("Weight", "LAYER_WEIGHT", {{"Blend", 0.3f}}),
                node("A", "BSDF_DIFFUSE", {{"Color", vec4(0.5f)}}),
                node("B", "EMISSION", {{"Color", vec4(1, 0.6f, 0.3f, 1)}, {"Strength", 4.0f}}),
                mix(link("Weight", "Facing"))},
               "Shader");
}
NodeGraph veil() {
  return graph({node("Weight", "LAYER_WEIGHT", {{"Blend", 0.5f}}),
                node("A", "BSDF_TRANSPARENT", {{"Color", vec4(0.9f, 0.9f, 0.6f, 1)}}),
                plain("B", Rgb(0.3f, 0.6f, 0.8f)), mix(link("Weight", "Facing"))},
               "Shader");
}

// Not there from in front.
NodeGraph one_way_veil() {
  return graph(
      {node("Geometry", "NEW_GEOMETRY", {}), node("A", "BSDF_TRANSPARENT", {{"Color", vec4(1)}}),
       plain("B", Rgb(0.7f)), mix(link("Geometry", "Backfacing"))},
      "Shader");
}

// Waves of height.
NodeGraph bumped() {
  return graph({node("Geometry", "NEW_GEOMETRY", {}),
                node("Split", "SEPXYZ", {{"Vector", link("Geometry", "Position")}}),
                with(node("Wide", "MATH", {{"Value", link("Split", "Z")}, {"Value_001", 20.0f}}),
                     "operation", "MULTIPLY"),
                with(node("Wave", "MATH", {{"Value", link("Wide", "Value")}}), "operation", "SINE"),
                node("Bump", "BUMP", {{"Height", link("Wave", "Value")}, {"Distance", 0.03f}}),
                node("Shader", "BSDF_PRINCIPLED",
                     {{"Base Color", vec4(0.8f, 0.7f, 0.6f, 1)},
                      {"Roughness", 0.4f},
                      {"Normal", link("Bump", "Normal")}})},
               "BSDF");
}

// A closure with bumps.
NodeGraph waved(const char* type, std::map<std::string, NodeInput> inputs, const char* setting = "",
                const char* value = "") {
  NodeGraph waves = bumped();
  Node shader = node("Shader", type, std::move(inputs));
  shader.inputs["Normal"] = link("Bump", "Normal");
  if (*setting) {
    shader = with(shader, setting, value);
  }
  waves.nodes.back() = shader;
  return waves;
}
NodeGraph covered() {
  return waved("BSDF_PRINCIPLED", {{"Base Color", vec4(0.8f, 0.3f, 0.2f, 1)},
                                   {"Coat Weight", 0.8f},
                                   {"Coat Roughness", 0.35f},
                                   {"Coat Tint", vec4(0.5f, 0.7f, 0.9f, 1)},
                                   {"Sheen Weight", 0.6f},
                                   {"Metallic", 0.3f},
                                   {"Specular Tint", vec4(0.9f, 0.5f, 0.7f, 1)},
                                   {"Emission Strength", 0.3f}});
}

NodeGraph thin_wall(std::map<std::string, NodeInput> inputs) {
  inputs.insert({{"Thin Wall", 1.0f},
                 {"Transmission Weight", 0.8f},
                 {"Base Color", vec4(0.9f, 0.7f, 0.4f, 1)}});
  return single("BSDF_PRINCIPLED", std::move(inputs));
}

// Displaced by the same waves, as bump, and bumped across.
NodeGraph displaced() {
  NodeGraph g = waved("BSDF_PRINCIPLED", {{"Base Color", vec4(0.8f, 0.5f, 0.2f, 1)},
                                          {"Roughness", 0.4f},
                                          {"Transmission Weight", 0.2f}});
  Node up = node("Up", "DISPLACEMENT", {{"Scale", 0.02f}});
  for (const Node& n : g.nodes) {
    if (n.name == "Bump") {
      up.inputs["Height"] = n.inputs.at("Height");
    }
  }
  g.nodes.push_back(up);
  g.displacement = NodeLink{"Up", "Displacement"};
  return g;
}

struct ShaderScene {
  std::string name;
  NodeGraph (*make)();
  bool light_tracing;
  int samples = 32;
};

const ShaderScene kScenes[] = {
    {"bumped", &bumped, true, 64},
    {"displaced", &displaced, false, 64},
    {"covered", &covered, true, 64},
    {"polished",  // what covers is smooth: no light path shows it
     [] {
       return single("BSDF_PRINCIPLED", {{"Coat Weight", 1.0f},
                                         {"Coat Roughness", 0.0f},
                                         {"Coat Tint", vec4(0.9f, 0.5f, 0.2f, 1)},
                                         {"Roughness", 0.5f}});
     },
     false, 64},
    {"sheen", [] { return waved("BSDF_SHEEN", {{"Roughness", 0.4f}}); }, true, 64},
    {"velvet",
     [] { return waved("BSDF_SHEEN", {{"Roughness", 0.6f}}, "distribution", "ASHIKHMIN"); }, true,
     64},
    {"toon", [] { return waved("BSDF_TOON", {{"Size", 0.6f}, {"Smooth", 0.3f}}); }, true, 64},
    {"glossy_toon",
     [] { return waved("BSDF_TOON", {{"Size", 0.4f}, {"Smooth", 0.3f}}, "component", "GLOSSY"); },
     true, 64},
    {"brushed", [] { return waved("BSDF_METALLIC", {{"Roughness", 0.5f}, {"Anisotropy", 0.7f}}); },
     true, 64},
    {"ashikhmin_shirley",
     [] {
       return waved("BSDF_GLOSSY", {{"Roughness", 0.5f}, {"Anisotropy", 0.5f}}, "distribution",
                    "ASHIKHMIN_SHIRLEY");
     },
     true, 64},
    {"coated", [] { return coated(0.4f); }, true},
    {"mirror_coated", [] { return coated(0.0f); }, false, 64},
    // A light walk goes on as the surface looks from where it comes; what the surface lets through
    // for another side only, light paths alone never find.
    {"two_faced", &two_faced, false},
    // Beyond the critical angle the glass is hidden from within, too.
    {"rimmed_rough_glass", [] { return rimmed_glass(0.5f); }, false, 64},
    {"rimmed_glass", [] { return rimmed_glass(0.0f); }, false, 64},
    {"glowing_rim", &glowing_rim, true},
    {"veil", &veil, true},
    {"one_way_veil", &one_way_veil, true},
    {"thin_glass", [] { return thin_wall({{"Roughness", 0.0f}}); }, false, 64},  // and a mirror
    {"rough_thin_glass", [] { return thin_wall({{"Roughness", 0.5f}}); }, true, 64},
    {"coated_thin_glass",
     [] {
       return thin_wall({{"Roughness", 0.4f},
                         {"Coat Weight", 0.7f},
                         {"Coat Roughness", 0.4f},
                         {"Thin Film Thickness", 400.0f}});
     },
     true, 64},
    {"leaf",
     [] {
       return thin_wall({{"Transmission Weight", 0.0f},
                         {"Subsurface Weight", 1.0f},
                         {"Diffuse Roughness", 0.7f}});
     },
     true, 64},
    {"bumped_thin_glass",
     [] {
       return waved("BSDF_PRINCIPLED", {{"Thin Wall", 1.0f},
                                        {"Transmission Weight", 0.8f},
                                        {"Subsurface Weight", 0.7f},
                                        {"Roughness", 0.5f}});
     },
     true, 64},
};

std::ostream& operator<<(std::ostream& out, const ShaderScene& s) { return out << s.name; }

class ShaderAgreement : public ::testing::TestWithParam<ShaderScene> {};

TEST_P(ShaderAgreement, AllIntegrators) {
  const auto& [name, make, light_tracing, count] = GetParam();
  const auto scene = room()
                         .add("ball", ball(0.4f, 24, true), make(), translation({0.3f, 0.1f, 0.1f}))
                         .add("pane", plane(0.7f, 0.7f), make(),
                              translation({-0.45f, 0.1f, 0.2f}) * rotation({0, 1, 0}, 1.2f))
                         .add("floor", plane(1.7f, 1.7f), make(), translation({0, 0, -0.8f}))
                         .add("curtain", plane(0.6f, 0.6f), make(),
                              translation({0.5f, -0.8f, 0.5f}) * rotation({1, 0, 0}, 0.5f * kPi))
                         .light("l", area_light({0, 0, 0.95f}, {0, 0, 0}, 0.9f, 20))
                         .build();
  EXPECT_TRUE(scene->diagnostics.empty());
  expect_integrators_agree(scene, count, light_tracing);
}

INSTANTIATE_TEST_SUITE_P(Scenes, ShaderAgreement, ::testing::ValuesIn(kScenes),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace janus::test
