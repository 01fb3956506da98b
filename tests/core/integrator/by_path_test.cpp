// SPDX-License-Identifier: GPL-3.0-or-later
//
// What Light Path says of the path: materials, emitters, worlds and what is transparent, all of
// which may depend on the camera's side of it. Light paths know nothing of that, and so end there.
#include "support/by_path.h"
#include "support/pictures.h"

namespace janus::test {
namespace {

struct ByPathScene {
  std::string name;
  SceneKit (*make)();
};
std::ostream& operator<<(std::ostream& out, const ByPathScene& s) { return out << s.name; }

const ByPathScene kScenes[] = {
    {"surfaces", &surfaces_by_path},
    {"emitters", &emitters_by_path},
    {"crossings", &crossings_by_path},
    {"hidden_crossings",  // and other objects for other rays
     [] {
       return crossings_by_path().add("ghost", ball(0.25f, 10),
                                      plastic(Rgb(0.9f, 0.3f, 0.2f), 0.5f),
                                      translation({0.3f, -0.5f, 0.4f}),
                                      kAllRays & static_cast<RayMask>(~ray_bit(RayType::Shadow)));
     }},
    {"lamps",
     [] { return lamp_by_path(lamp_by_path(room(), "Ray Depth", 1.5f), "Glossy Depth", 0.5f); }},
    {"world", [] { return world_by_path(room()); }},
};

class ByPath : public ::testing::TestWithParam<ByPathScene> {};

TEST_P(ByPath, IntegratorsAgree) {
  const auto scene = GetParam().make().build();
  EXPECT_TRUE(scene->diagnostics.empty());
  EXPECT_TRUE(scene->has_by_path);
  const auto pt = quarters(scene, small_picture(IntegratorType::PathTracer, samples(96)));
  for (const bool classic : {false, true}) {
    RenderSettings settings = small_picture(IntegratorType::Bdpt, samples(classic ? 24 : 32));
    settings.adaptive_counts = false;
    settings.connection_mode = classic ? ConnectionMode::Classic : ConnectionMode::Cache;
    SCOPED_TRACE(classic ? "classic" : "cache");
    expect_agreement(quarters(scene, settings), pt, 0.03);
  }
}

// Where light may end on what asks, merging is none there.
TEST(ByPathMerging, IntegratorsAgree) {
  const auto scene =
      surfaces_by_path()
          .add("wax", ball(0.3f, 10, true),
               by_count("Ray Depth", 0.5f, subsurface(Rgb(0.9f, 0.5f, 0.3f)), diffuse(Rgb(0.6f))),
               translation({-0.3f, -0.5f, 0.3f}))
          .build();
  RenderSettings settings = small_picture(IntegratorType::Bdpt, samples(48));
  settings.adaptive_counts = false;
  settings.merge_radius = 0.02f;
  expect_agreement(quarters(scene, settings),
                   quarters(scene, small_picture(IntegratorType::PathTracer, samples(128))), 0.03);
}

INSTANTIATE_TEST_SUITE_P(Scenes, ByPath, ::testing::ValuesIn(kScenes),
                         [](const auto& info) { return info.param.name; });

// --- Known answers, which are Cycles'
// --------------------------------------------------------------

constexpr IntegratorType kIntegrators[] = {IntegratorType::Bdpt, IntegratorType::PathTracer};

NodeGraph shows(const std::string& output) {
  NodeGraph g = emission(Rgb(1), 0);
  g.nodes.push_back(node("Path", "LIGHT_PATH", {}));
  g.nodes.front().inputs["Strength"] = link("Path", output);
  return g;
}

double seen(SceneKit& kit, IntegratorType integrator, int count = 4) {
  return quarters(kit.build(), small_picture(integrator, samples(count)), 4)[0].mean();
}

// An emitter over two panes, behind a mirror, and the same over something diffuse.
TEST(ByPathAnswers, OfEmitters) {
  struct Answer {
    const char* output;
    double direct, mirrored, looked_for, by_chance;
  };
  const double length = 3.0 - 0.01;  // the camera clips what is nearer
  for (const Answer& a : {Answer{"Ray Length", length, 2.0, 2.0, 2.0},
                          {"Ray Depth", 0, 1, 1, 1},
                          {"Diffuse Depth", 0, 0, 0, 1},
                          {"Glossy Depth", 0, 1, 0, 0},
                          {"Transparent Depth", 2, 1, 1, 1},
                          {"Transmission Depth", 0, 0, 0, 0},
                          {"Portal Depth", 0, 0, 0, 0}}) {
    SCOPED_TRACE(a.output);
    const NodeGraph pane = single("BSDF_TRANSPARENT", {{"Color", vec4(1)}});
    for (const IntegratorType integrator : kIntegrators) {
      SceneKit direct;
      direct.add("lamp", plane(4, 4), shows(a.output)).camera({0, 0, 3}, {0, 0, 0}, 0.02f);
      for (const float z : {1.0f, 1.5f}) {
        direct.add("pane" + std::to_string(z), plane(4, 4), pane, translation({0, 0, z}));
      }
      EXPECT_NEAR(seen(direct, integrator), a.direct, 1e-3);
      const auto reflected = [&](const NodeGraph& floor, bool look, const NodeGraph& lamp) {
        SceneKit kit;
        kit.add("floor", plane(0.1f, 0.1f), floor)
            .add("pane", plane(4, 4), pane, translation({0, 0, 1.9f}))
            .add("lamp", ball(2.0f, 64, true), lamp)
            .camera({0, 0, 1}, {0, 0, 0}, 0.02f);
        kit.builder.set_material("lamp", MaterialDesc{"lamp", lamp, look});
        return seen(kit, integrator, look ? 64 : 4);
      };
      EXPECT_NEAR(reflected(mirror(Rgb(1)), true, shows(a.output)), a.mirrored, 0.02);
      // The lamp is all around: what it adds is a mean over the directions.
      const double all = reflected(diffuse(Rgb(1)), true, emission(Rgb(1), 1));
      if (std::string(a.output) != "Transparent Depth") {  // the pane is not all around
        EXPECT_NEAR(reflected(diffuse(Rgb(1)), true, shows(a.output)), a.looked_for * all, 0.03);
        EXPECT_NEAR(reflected(diffuse(Rgb(1)), false, shows(a.output)), a.by_chance * all, 0.03);
      }
    }
  }
}

// Worlds count the vertex that they light.
TEST(ByPathAnswers, OfWorlds) {
  struct Answer {
    const char* output;
    double direct, mirrored, diffused;
  };
  for (const Answer& a : {Answer{"Ray Depth", 1, 2, 2},
                          {"Diffuse Depth", 0, 0, 1},
                          {"Glossy Depth", 0, 1, 0},
                          {"Transmission Depth", 0, 0, 0}}) {
    SCOPED_TRACE(a.output);
    for (const IntegratorType integrator : kIntegrators) {
      const auto kit = [&] {
        SceneKit kit;
        NodeGraph sky = single("BACKGROUND", {{"Color", vec4(1)}});
        sky.nodes.push_back(node("Path", "LIGHT_PATH", {}));
        sky.nodes.front().inputs["Strength"] = link("Path", a.output);
        sky.surface = NodeLink{"Shader", "Background"};
        kit.builder.set_world({"World", sky});
        return kit.camera({0, 0, 1}, {0, 0, 0}, 0.02f);
      };
      SceneKit direct = kit(), mirrored = kit(), diffused = kit();
      EXPECT_NEAR(seen(direct, integrator), a.direct, 1e-4);
      mirrored.add("floor", plane(1, 1), mirror(Rgb(1)));
      EXPECT_NEAR(seen(mirrored, integrator), a.mirrored, 1e-3);
      diffused.add("floor", plane(1, 1), diffuse(Rgb(1)));
      EXPECT_NEAR(seen(diffused, integrator, 64), a.diffused, 0.02);
    }
  }
}

}  // namespace
}  // namespace janus::test
