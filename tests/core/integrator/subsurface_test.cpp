// SPDX-License-Identifier: GPL-3.0-or-later
//
// Light that goes below surfaces: path tracing, light tracing and BDPT agree, whichever end a walk
// comes from.
#include "support/pictures.h"
#include "support/scene_kit.h"

namespace janus::test {
namespace {

NodeGraph skin(std::map<std::string, NodeInput> inputs) {
  inputs.insert({{"Base Color", vec4(0.9f, 0.6f, 0.4f, 1)},
                 {"Subsurface Weight", 1.0f},
                 {"Subsurface Scale", 0.6f},
                 {"Roughness", 0.5f}});
  return single("BSDF_PRINCIPLED", std::move(inputs));
}

struct SubsurfaceScene {
  const char* name;
  NodeGraph (*make)();
  bool light_tracing = true;
};

const SubsurfaceScene kScenes[] = {
    {"wax", [] { return subsurface(Rgb(0.9f, 0.6f, 0.3f)); }},
    {"legacy", [] { return subsurface(Rgb(0.9f, 0.6f, 0.3f), {}, "RANDOM_WALK_LEGACY"); }},
    {"skin", [] { return subsurface(Rgb(0.9f, 0.6f, 0.3f), {}, "RANDOM_WALK_SKIN"); }},
    {"bright", [] { return subsurface(Rgb(0.94f), {{"Roughness", 0.7f}}); }},
    {"principled", [] { return skin({}); }},
    {"covered", [] { return skin({{"Coat Weight", 1.0f}, {"Coat Roughness", 0.4f}}); }},
    {"mixed", [] { return combine("MIX_SHADER", subsurface(Rgb(0.8f)), diffuse(Rgb(0.5f))); }},
    // What light walks cannot pass: they see nothing of it, and need not.
    {"smooth", [] { return subsurface(Rgb(0.9f), {{"Roughness", 0.0f}}); }, false},
    {"forward",
     [] {
       return subsurface(Rgb(0.9f, 0.6f, 0.3f), {{"Anisotropy", 0.8f}, {"Roughness", 0.6f}},
                         "RANDOM_WALK_LEGACY");
     },
     false},
    // Each end has a medium of its own, and walks from there have other densities: light walks
    // alone find this by few bright samples.
    {"varying",
     [] {
       NodeGraph graph = subsurface(Rgb(0.8f, 0.7f, 0.6f), {{"Radius", vec3(1)}});
       graph.nodes.push_back(node("Place", "NEW_GEOMETRY", {}));
       graph.nodes.push_back(node("Pattern", "TEX_CHECKER",
                                  {{"Vector", link("Place", "Position")},
                                   {"Color1", vec4(3)},
                                   {"Color2", vec4(0.3f)},
                                   {"Scale", 5.0f}}));
       graph.nodes.front().inputs["Scale"] = link("Pattern", "Color");
       return graph;
     },
     false},
    {"twofold",
     [] { return combine("MIX_SHADER", subsurface(Rgb(0.8f)), subsurface(Rgb(0.2f, 0.5f, 0.8f))); },
     false},
    {"seen_from_everywhere",
     [] {
       NodeGraph graph = combine("MIX_SHADER", subsurface(Rgb(0.8f)), diffuse(Rgb(0.2f)));
       graph.nodes.push_back(node("Weight", "LAYER_WEIGHT", {{"Blend", 0.6f}}));
       graph.nodes[2].inputs["Fac"] = link("Weight", "Facing");
       return graph;
     },
     false},
};

std::ostream& operator<<(std::ostream& out, const SubsurfaceScene& s) { return out << s.name; }

class SubsurfaceAgreement : public ::testing::TestWithParam<SubsurfaceScene> {};

TEST_P(SubsurfaceAgreement, AllIntegrators) {
  const auto& [name, make, light_tracing] = GetParam();
  const auto scene = room()
                         .add("ball", ball(0.4f, 24, true), make(), translation({0.3f, 0.1f, 0.1f}))
                         .add("slab", cuboid({-0.4f, -0.4f, -0.04f}, {0.4f, 0.4f, 0.04f}), make(),
                              translation({-0.45f, -0.1f, 0.4f}) * rotation({0, 1, 0}, 1.2f))
                         .light("l", area_light({0, 0, 0.95f}, {0, 0, 0}, 0.9f, 20))
                         .build();
  EXPECT_TRUE(scene->diagnostics.empty());
  expect_integrators_agree(scene, 96, light_tracing);
}

// All that the camera sees has come through.
TEST(SubsurfaceAgreementBelow, ThroughASlab) {
  const auto scene = SceneKit()
                         .add("slab", cuboid({-2, -2, -0.05f}, {2, 2, 0.05f}),
                              subsurface(Rgb(0.8f), {{"Scale", 0.4f}, {"Radius", vec3(1)}}))
                         .light("below", area_light({0, 0, -0.8f}, {0, 0, 0}, 0.8f, 40))
                         .camera({0, -0.5f, 1.5f}, {0, 0, 0}, 0.3f)
                         .build();
  const auto lt = quarters(scene, small_picture(IntegratorType::LightTracer, samples(128)));
  const auto pt = quarters(scene, small_picture(IntegratorType::PathTracer, samples(64)));
  expect_agreement(lt, pt, 0.05);
  const auto bdpt = quarters(scene, small_picture(IntegratorType::Bdpt, samples(48)));
  expect_agreement(bdpt, pt, 0.03);
}

INSTANTIATE_TEST_SUITE_P(Scenes, SubsurfaceAgreement, ::testing::ValuesIn(kScenes),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace janus::test
