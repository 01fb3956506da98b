// SPDX-License-Identifier: GPL-3.0-or-later
//
// AOVs by Cycles' rule: sums over surfaces that are looked through.
#include <gtest/gtest.h>

#include "janus/session/session.h"
#include "support/scene_kit.h"

namespace janus::test {
namespace {

using Inputs = std::map<std::string, NodeInput>;

Node aov(const std::string& name, Inputs inputs) {
  Node result = node("AOV " + name, "OUTPUT_AOV", std::move(inputs));
  result.properties["aov_name"] = name;
  return result;
}
NodeGraph writes(vec3 color, float value) {
  return {{aov("Color", {{"Color", vec4(color, 1)}}), aov("Value", {{"Value", value}})}, {}, {}};
}

// `alpha` of a colour.
NodeGraph thin(float alpha, Rgb color = Rgb(0.8f)) {
  return combine("MIX_SHADER", single("BSDF_TRANSPARENT", {}), diffuse(color), alpha);
}

// Planes before a camera that looks down, the first of them nearest; then the world.
struct Layer {
  NodeGraph surface, aovs;
  bool holdout = false;
};
SceneKit stack(const std::vector<Layer>& layers, const NodeGraph& world = {}) {
  SceneKit kit;
  for (size_t i = 0; i < layers.size(); ++i) {
    const std::string name(1, static_cast<char>('a' + i));
    const auto place = translation({0, 0, -static_cast<float>(i)});
    kit.add(name, plane(8, 8), layers[i].surface, place, kAllRays, layers[i].holdout);
    kit.builder.set_material(name, {name, layers[i].surface, true, 0.0f, layers[i].aovs});
  }
  WorldDesc background{"World", single("BACKGROUND", {})};
  background.aovs = world;
  kit.builder.set_world(background);
  kit.camera({0, 0, 3}, {0, 0, 0}, 1e-4f);
  return kit;
}

struct Seen {
  std::vector<float> color, value;
};
Seen look(const SceneKit& kit, RenderSettings settings = {}) {
  settings.width = settings.height = 1;
  settings.samples = 4;
  settings.threads = 1;
  settings.integrator = IntegratorType::PathTracer;
  settings.data.aovs = {{"Color", true}, {"Value", false}, {"Other", true}};
  RenderSession session(kit.build(), settings);
  session.start();
  session.finish();
  EXPECT_EQ(session.snapshot("AOV Other").pixels, std::vector<float>(4, 0.0f));
  return {session.snapshot("AOV Color").pixels, session.snapshot("AOV Value").pixels};
}
void expect(const Seen& seen, vec4 color, float value) {
  ASSERT_EQ(seen.color.size(), 4u);
  ASSERT_EQ(seen.value.size(), 1u);
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(seen.color[i], color[i], 1e-4f) << i;
  }
  EXPECT_NEAR(seen.value[0], value, 1e-4f);
}

const vec3 kA(0.1f, -0.2f, 3.0f), kB(1, 0, 0);

TEST(Aovs, AreWrittenByTheFirstSurface) {
  expect(look(stack({{mirror(Rgb(1)), writes(kA, -4)}, {diffuse(Rgb(1)), writes(kB, 2)}})),
         vec4(kA, 1), -4);
  expect(look(stack({{diffuse(Rgb(1)), {}}, {diffuse(Rgb(1)), writes(kB, 2)}})), vec4(0), 0);
  expect(look(stack({})), vec4(0), 0);
}

TEST(Aovs, LookThroughWhatHasLittleAlpha) {
  const float chance = 0.7f / (0.7f + 0.3f * 0.8f);
  const auto kit = stack({{thin(0.3f), writes(kA, 1)}, {diffuse(Rgb(1)), writes(kB, 2)}});
  expect(look(kit), vec4(kA, 1) + chance * vec4(kB, 1), 1 + 2 * chance);
  RenderSettings settings;
  settings.data_settings.alpha_threshold = 0.3f;
  expect(look(kit, settings), vec4(kA, 1), 1);
  const auto thick = stack({{thin(0.6f), writes(kA, 1)}, {diffuse(Rgb(1)), writes(kB, 2)}});
  expect(look(thick), vec4(kA, 1), 1);
}

// Cycles ends some of its paths from the third surface on.
TEST(Aovs, CountRoulette) {
  const float chance = 0.7f / 0.94f, kept = std::sqrt(0.94f * 0.94f);
  const Layer pane{thin(0.3f), writes(kB, 1)};
  expect(look(stack({pane, pane, pane})), vec4(kB, 1) * (1 + chance + chance * chance * kept),
         1 + chance + chance * chance * kept);
  // Not before what emits; but behind it.
  const Layer light{
      combine("MIX_SHADER", single("BSDF_TRANSPARENT", {}), emission(Rgb(1), 1), 0.3f),
      writes(kB, 1)};
  const float first = chance * chance, second = first * kept * std::sqrt(0.94f * 0.7f);
  expect(look(stack({pane, pane, light, pane})), vec4(kB, 1) * (1 + chance + first + second),
         1 + chance + first + second);
  RenderSettings settings;
  settings.transparent_max_bounces = 1;
  expect(look(stack({pane, pane, pane}), settings), vec4(kB, 1) * (1 + chance), 1 + chance);
}

TEST(Aovs, OfHoldoutsAreTheLast) {
  const Layer behind{diffuse(Rgb(1)), writes(kB, 2)};
  expect(look(stack({{diffuse(Rgb(1)), writes(kA, 1), true}, behind})), vec4(kA, 1), 1);
  expect(look(stack({{thin(0.2f), writes(kA, 1), true}, behind})), vec4(kA, 1), 1);
  expect(look(stack({{single("HOLDOUT", {}), writes(kA, 1)}, behind})), vec4(kA, 1), 1);
}

TEST(Aovs, OfTheWorldAreBehindAll) {
  const float chance = 0.7f / (0.7f + 0.3f * 0.8f);
  const auto kit = stack({{thin(0.3f), writes(kA, 1)}}, writes(kB, 2));
  expect(look(kit), vec4(kA, 1) + chance * vec4(kB, 1), 1 + 2 * chance);
  expect(look(stack({}, writes(kB, 2))), vec4(kB, 1), 2);
  expect(look(stack({{diffuse(Rgb(1)), {}}}, writes(kB, 2))), vec4(0), 0);
  RenderSettings transparent;
  transparent.film_transparent = true;
  expect(look(kit, transparent), vec4(kA, 1), 1);
  SceneKit hidden = stack({});
  WorldDesc world{"World", single("BACKGROUND", {})};
  world.aovs = writes(kB, 2);
  world.visibility = kAllRays & ~ray_bit(RayType::Camera);
  hidden.builder.set_world(world);
  expect(look(hidden), vec4(0), 0);
}

// Where is it, which side is seen, who asks, what is on the mesh?
TEST(Aovs, AreProgramsOfTheirOwn) {
  NodeGraph graph;
  graph.nodes = {aov("Color", {{"Color", link("Geometry", "Position")}}),
                 aov("Value", {{"Value", link("Path", "Is Camera Ray")}}),
                 node("Geometry", "NEW_GEOMETRY", {}), node("Path", "LIGHT_PATH", {})};
  const auto kit = stack({{diffuse(Rgb(1)), {}, false}, {diffuse(Rgb(1)), {}, false}});
  SceneKit lifted = kit;
  lifted.builder.set_material("a", {"a", diffuse(Rgb(1)), true, 0.0f, graph});
  lifted.add("b", plane(8, 8), diffuse(Rgb(1)), translation({0, 0, -2}));
  expect(look(lifted), vec4(0, 0, 0, 1), 1);
  SceneKit with_map = kit;
  MeshDesc mesh = plane(8, 8);
  mesh.attributes.push_back({"uv:Map", AttributeDomain::Mesh, 2, {0.25f, 0.75f}});
  with_map.builder.set_mesh("a", mesh);
  Node map = node("Map", "UVMAP", {});
  map.properties["uv_map"] = std::string("Map");
  graph.nodes = {aov("Color", {{"Color", link("Map", "UV")}}), map};
  with_map.builder.set_material("a", {"a", diffuse(Rgb(1)), true, 0.0f, graph});
  expect(look(with_map), vec4(0.25f, 0.75f, 0, 1), 0);
}

// The camera sees another surface than light does, and its AOVs are those of the tree.
TEST(Aovs, OfTreesThatAskWhoLooks) {
  NodeGraph asks = combine("MIX_SHADER", diffuse(Rgb(1)), single("BSDF_TRANSPARENT", {}));
  asks.nodes.push_back(node("Path", "LIGHT_PATH", {}));
  for (const char* who : {"Is Camera Ray", "Is Shadow Ray", "Is Diffuse Ray"}) {
    asks.nodes[2].inputs["Fac"] = link("Path", who);
    const auto kit = stack({{asks, writes(kA, 1)}, {diffuse(Rgb(1)), writes(kB, 2)}});
    const bool through = std::string(who) == "Is Camera Ray";
    expect(look(kit), through ? vec4(kA + kB, 2) : vec4(kA, 1), through ? 3 : 1);
  }
}

TEST(Aovs, OfOneNameAddUp) {
  NodeGraph graph = writes(kA, 1);
  graph.nodes.push_back(aov("Color", {{"Color", vec4(kB, 1)}}));
  graph.nodes.back().name = "Another";
  expect(look(stack({{diffuse(Rgb(1)), graph}})), vec4(kA + kB, 2), 1);
}

TEST(Aovs, ChangeNoOtherPicture) {
  const auto combined = [](const NodeGraph& aovs, bool wanted) {
    RenderSettings settings;
    settings.width = settings.height = 4;
    settings.samples = 2;
    settings.threads = 1;
    if (wanted) {
      settings.data.aovs = {{"Color", true}};
    }
    RenderSession session(stack({{thin(0.3f), aovs}, {mirror(Rgb(0.5f)), {}}}).build(), settings);
    session.start();
    session.finish();
    return session.snapshot().pixels;
  };
  const auto plain = combined({}, false);
  EXPECT_EQ(plain, combined(writes(kA, 1), false));
  EXPECT_EQ(plain, combined(writes(kA, 1), true));
}

TEST(Aovs, OfOneNameAreRefused) {
  RenderSettings settings;
  settings.data.aovs = {{"Mask", true}, {"Mask", false}};
  EXPECT_THROW(settings.validate(), SceneError);
}

}  // namespace
}  // namespace janus::test
