// SPDX-License-Identifier: GPL-3.0-or-later
//
// Scenes whose picture is known: agreement alone would not notice a factor that all share.
#include "support/pictures.h"
#include "support/scene_kit.h"

namespace janus::test {
namespace {

class KnownAnswer : public ::testing::TestWithParam<IntegratorType> {
 protected:
  // Mean of the picture over seeds.
  Mean mean(const SceneKit& kit, int bounces, int count) {
    const bool light = GetParam() == IntegratorType::LightTracer;  // sees less of its paths
    RenderSettings settings = small_picture(GetParam(), samples(light ? 8 * count : count));
    settings.max_bounces = bounces;
    return quarters(kit.build(), settings)[0];
  }
};

void expect_value(const Mean& mean, double expected, double tolerance = 0.003) {
  EXPECT_NEAR(mean.mean(), expected, tolerance * expected);
  EXPECT_LT(mean.error(), 0.5 * tolerance * expected);
}

// Looks straight down at a point of a large diffuse floor through a narrow window.
SceneKit floor_below() {
  SceneKit kit;
  kit.add("floor", plane(200, 200), diffuse(Rgb(0.6f)));
  kit.camera({0, 0, 0.5f}, {0, 0, 0}, 0.002f);
  return kit;
}

TEST_P(KnownAnswer, PointLight) {  // I = P / 4 pi, E = I / d^2, L = albedo E / pi
  if (GetParam() == IntegratorType::LightTracer) {
    GTEST_SKIP() << "hardly any light path ends in so narrow a view";
  }
  const double expected = 0.6 / kPi * (50.0 / (4 * kPi)) / 4.0;
  expect_value(mean(floor_below().light("l", point_light({0, 0, 2}, 50)), 0, 8), expected);
}

TEST_P(KnownAnswer, AreaLight) {  // L = P / (pi A); small and far: E = L A / d^2
  if (GetParam() == IntegratorType::LightTracer) {
    GTEST_SKIP() << "hardly any light path ends in so narrow a view";
  }
  const double expected = 0.6 / kPi * (50.0 / kPi) / 16.0;
  expect_value(mean(floor_below().light("l", area_light({0, 0, 4}, {0, 0, 0}, 0.1f, 50)), 0, 8),
               expected);
}

TEST_P(KnownAnswer, WorldOverAPlane) {  // L = albedo * world
  if (GetParam() == IntegratorType::LightTracer) {
    GTEST_SKIP() << "hardly any light path ends in so narrow a view";
  }
  expect_value(mean(floor_below().world(Rgb(0.7f)), 0, 32), 0.6 * 0.7);
}

TEST_P(KnownAnswer, WhiteFurnace) {  // everything that reflects all light vanishes in it
  SceneKit kit;
  kit.add("ball", ball(0.8f, 16), diffuse(Rgb(1.0f)))
      .add("block", cuboid({0.5f, -0.9f, -1}, {1, -0.4f, 0.3f}), diffuse(Rgb(1.0f)));
  expect_value(mean(kit.world(Rgb(1.0f)), 200, 64), 1.0);
}

TEST_P(KnownAnswer, GlassFurnace) {
  if (GetParam() == IntegratorType::LightTracer) {
    GTEST_SKIP() << "light tracing does not see through glass";
  }
  SceneKit kit;
  kit.add("ball", ball(0.8f, 32, true), glass(Rgb(1.0f), 1.5f));
  expect_value(mean(kit.world(Rgb(1.0f)), 200, 16), 1.0);
}

// Emission and albedo in a closed box: L = e / (1 - a), for any shape.
TEST_P(KnownAnswer, GlowingBox) {
  SceneKit kit;
  kit.add("box", cuboid(vec3(-1), vec3(1)),
          combine("ADD_SHADER", diffuse(Rgb(0.5f)), emission(Rgb(1), 1)));
  kit.camera({0, -0.9f, 0}, {0, 0, 0});
  expect_value(mean(kit, 60, 96), 2.0);
}

std::string integrator_name(const ::testing::TestParamInfo<IntegratorType>& info) {
  constexpr const char* kNames[] = {"bdpt", "pt", "lt"};
  return kNames[static_cast<int>(info.param)];
}

INSTANTIATE_TEST_SUITE_P(Integrators, KnownAnswer,
                         ::testing::Values(IntegratorType::Bdpt, IntegratorType::PathTracer,
                                           IntegratorType::LightTracer),
                         integrator_name);

}  // namespace
}  // namespace janus::test
