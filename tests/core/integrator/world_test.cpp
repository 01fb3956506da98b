// SPDX-License-Identifier: GPL-3.0-or-later
//
// Path tracing, light tracing and BDPT agree under a world that is not the same to every ray. What
// it shines is a function of the direction and of the label of z_1.
#include "light/light_cases.h"
#include "support/pictures.h"

namespace janus::test {
namespace {

// Diffuse, rough glossy and rough glass, in the open.
SceneKit things() {
  const auto rough = [](const char* type) { return single(type, {{"Roughness", 0.5f}}); };
  const NodeGraph plastic =
      combine("ADD_SHADER", diffuse(Rgb(0.4f, 0.3f, 0.3f)),
              single("BSDF_GLOSSY", {{"Color", vec4(0.4f, 0.4f, 0.3f, 1)}, {"Roughness", 0.5f}}));
  return SceneKit()
      .add("floor", plane(2.4f, 2.4f), plastic, translation({0, 0, -0.6f}))
      .add("ball", ball(0.4f, 12), rough("BSDF_GLASS"), translation({-0.5f, 0, -0.1f}))
      .add("wall", plane(1, 1), rough("BSDF_GLOSSY"),
           translation({0.6f, 0.4f, 0}) * rotation({1, 0.3f, 0}, 0.45f * kPi))
      .camera({0, -3, 0.9f}, {0, 0, -0.2f}, 0.35f);
}

// The world of nodes, with something else where Light Path says so.
SceneKit seen_by(const std::string& output, NodeGraph other = single("BACKGROUND", {})) {
  SceneKit kit = things();
  Image calm = sky();  // without its sun, which light tracing seldom finds
  for (float& x : calm.pixels) {
    x = std::min(x, 2.0f);
  }
  kit.builder.set_image("image", {"Sky", std::make_shared<Image>(calm), false});
  NodeGraph graph = sky_of_nodes(0.5f);
  other.nodes.front().name = "Other";
  graph.nodes.push_back(other.nodes.front());
  graph.nodes.push_back(node("Path", "LIGHT_PATH", {}));
  graph.nodes.push_back(node(
      "Top", "MIX_SHADER",
      {{"Fac", link("Path", output)}, {"Shader", link("Shader")}, {"Shader_001", link("Other")}}));
  graph.surface = NodeLink{"Top", "Shader"};
  kit.builder.set_world({"World", graph});
  return kit;
}

// The sky of Sky Texture and its sun, which is a light of its own.
TEST(WorldOfSky, IntegratorsAgree) {
  SceneKit kit = things();
  kit.builder.set_world(
      {"World", sky_texture("MULTIPLE_SCATTERING", {{"sun_size", 0.3f}, {"sun_rotation", 2.5f}})});
  const auto scene = kit.build();
  EXPECT_TRUE(scene->diagnostics.empty());
  EXPECT_EQ(scene->lights.size(), 2u);
  const auto picture = [&](IntegratorType integrator, int count) {
    return quarters(scene, small_picture(integrator, samples(count)));
  };
  const auto bdpt = picture(IntegratorType::Bdpt, 96);
  expect_agreement(bdpt, picture(IntegratorType::PathTracer, 192));
  expect_agreement(bdpt, picture(IntegratorType::LightTracer, 256), 0.05);
}

class WorldByRay : public ::testing::TestWithParam<std::string> {};

TEST_P(WorldByRay, IntegratorsAgree) {
  const auto scene = seen_by(GetParam()).build();
  EXPECT_TRUE(scene->diagnostics.empty());
  EXPECT_EQ(scene->lights.size(), 2u);
  const auto picture = [&](IntegratorType integrator, int count) {
    return quarters(scene, small_picture(integrator, samples(count)));
  };
  const auto bdpt = picture(IntegratorType::Bdpt, 96);
  expect_agreement(bdpt, picture(IntegratorType::PathTracer, 192));
  // Most light paths miss so few things.
  expect_agreement(bdpt, picture(IntegratorType::LightTracer, 256), 0.05);
}

INSTANTIATE_TEST_SUITE_P(Outputs, WorldByRay,
                         ::testing::Values("Is Camera Ray", "Is Diffuse Ray", "Is Glossy Ray",
                                           "Is Transmission Ray"),
                         [](const auto& info) {
                           std::string name = info.param;
                           std::erase(name, ' ');
                           return name;
                         });

}  // namespace
}  // namespace janus::test
