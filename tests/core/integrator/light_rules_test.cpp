// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lights that cast no shadows, that light short paths only, or that nobody looks for: rules of the
// whole path, the same in every technique.
#include "support/pictures.h"
#include "support/scene_kit.h"

namespace janus::test {
namespace {

constexpr IntegratorType kIntegrators[] = {IntegratorType::Bdpt, IntegratorType::PathTracer,
                                           IntegratorType::LightTracer};

// A lamp, large enough to be hit, over a screen and a block that scatter in all ways.
SceneKit under_screen(const LightDesc& lamp) {
  const NodeGraph surface =
      combine("ADD_SHADER", diffuse(Rgb(0.5f, 0.4f, 0.3f)),
              single("BSDF_GLASS", {{"Color", vec4(0.4f, 0.4f, 0.4f, 1)}, {"Roughness", 0.6f}}));
  return SceneKit()
      .add("floor", plane(3, 3), diffuse(Rgb(0.6f)), translation({0, 0, -0.6f}))
      .add("wall", plane(3, 2), diffuse(Rgb(0.7f, 0.5f, 0.4f)),
           translation({0, 1.4f, 0.4f}) * rotation({1, 0, 0}, 0.5f * kPi))
      .add("screen", plane(1.2f, 1.2f), surface, translation({0.3f, 0, 0.4f}))
      .add("block", cuboid({-0.3f, -0.3f, -0.55f}, {0.3f, 0.3f, 0}), surface)
      .light("l", lamp)
      .camera({0, -2.6f, 1}, {0, 0, -0.2f}, 0.3f);
}
LightDesc lamp() { return area_light({0.5f, -0.5f, 1.3f}, {0.2f, 0, -0.3f}, 0.9f, 40); }

std::vector<Mean> picture(const std::shared_ptr<const Scene>& scene, IntegratorType integrator,
                          int count, int max_bounces) {
  RenderSettings settings = small_picture(integrator, samples(count));
  settings.max_bounces = max_bounces;
  return quarters(scene, settings);
}

// --- Shadows
// --------------------------------------------------------------------------------------

// A world of one colour, which needs no next event estimation, is there as well where lights have
// shadow rays of their own.
TEST(LightRules, LightsWithoutShadowsLeaveTheWorldAlone) {
  LightDesc light = point_light({0, 0, 9}, 1e-6f);
  light.cast_shadow = false;
  const auto scene = SceneKit()
                         .add("floor", plane(2, 2), diffuse(Rgb(0.6f)))
                         .light("l", light)
                         .world(Rgb(1))
                         .camera({0, 0, 1}, {0, 0, 0})
                         .build();
  for (const IntegratorType integrator : kIntegrators) {
    const Mean found = picture(scene, integrator, 64, 0)[0];
    EXPECT_NEAR(found.mean(), 0.6, 5 * found.error() + 1e-4) << static_cast<int>(integrator);
  }
}

// A light without shadows lights the floor through an opaque plate.
TEST(LightRules, NothingIsInTheWayOfALightWithoutShadows) {
  for (const IntegratorType integrator : kIntegrators) {
    const auto floor = [&](bool plate, bool shadows, float radius) {
      LightDesc light = radius < 0.0f ? area_light({0, 0, 2}, {0, 0, 0}, 0.5f, 20)
                                      : point_light({0, 0, 2}, 40, radius);
      light.cast_shadow = shadows;
      SceneKit kit;
      kit.add("floor", plane(2, 2), diffuse(Rgb(0.6f))).light("l", light);
      kit.camera({0, 0, 1}, {0, 0, 0});
      if (plate) {
        kit.add("plate", plane(9, 9), diffuse(Rgb(0.0f)), translation({0, 0, 1.5f}));
      }
      return picture(kit.build(), integrator, 32, 2)[0];
    };
    for (const float radius : {-1.0f, 0.0f, 0.3f}) {
      SCOPED_TRACE(::testing::Message()
                   << "integrator " << static_cast<int>(integrator) << ", radius " << radius);
      const Mean open = floor(false, true, radius), through = floor(true, false, radius);
      EXPECT_NEAR(floor(true, true, radius).mean(), 0.0, 1e-4 * open.mean());
      EXPECT_TRUE(agree(through, open, 4.8));
      EXPECT_LT(through.error(), 0.05 * open.mean());  // light walks pass the floor, too
    }
  }
}

TEST(LightRules, IntegratorsAgreeWithoutShadows) {
  LightDesc light = lamp();
  light.cast_shadow = false;
  const auto scene = under_screen(light).build();
  const auto bdpt = picture(scene, IntegratorType::Bdpt, 24, 4);
  expect_agreement(bdpt, picture(scene, IntegratorType::PathTracer, 64, 4), 0.015);
  expect_agreement(bdpt, picture(scene, IntegratorType::LightTracer, 160, 4), 0.025);
  const auto plain = picture(under_screen(lamp()).build(), IntegratorType::Bdpt, 24, 4);
  EXPECT_GT(z_score(bdpt[0], plain[0]), 6.0);
}

// --- Bounces
// --------------------------------------------------------------------------------------

// Where it is the only light and nothing is smooth, its limit is that of all.
TEST(LightRules, ALimitOfBounces) {
  const auto plain = under_screen(lamp()).build();
  for (const int limit : {0, 1}) {
    LightDesc light = lamp();
    light.max_bounces = limit;
    const auto scene = under_screen(light).build();
    for (const IntegratorType integrator : kIntegrators) {
      SCOPED_TRACE(::testing::Message()
                   << "limit " << limit << ", integrator " << static_cast<int>(integrator));
      const int count = integrator == IntegratorType::Bdpt ? 24 : 64;
      expect_agreement(picture(scene, integrator, count, 4),
                       picture(plain, IntegratorType::Bdpt, 25, limit), 0.02);
    }
  }
}

// Mirrors do not ask: no shadow ray could have found the light, and Cycles' limit is theirs.
TEST(LightRules, MirrorsShowALightBeyondItsLimit) {
  LightDesc light = area_light({0, 0, 3}, {0, 0, 0}, 20.0f, 1);
  light.max_bounces = 0;
  light.normalize = false;
  SceneKit kit;
  kit.add("mirror", plane(9, 9), mirror(Rgb(1))).light("l", light);
  kit.add("pane", plane(9, 9), single("BSDF_REFRACTION", {{"Roughness", 0.0f}, {"IOR", 1.0f}}),
          translation({0, 0, 0.5f}));
  kit.camera({0, 0, 1}, {0, 0, 0}, 0.1f);
  const auto scene = kit.build();
  for (const IntegratorType integrator : {IntegratorType::Bdpt, IntegratorType::PathTracer}) {
    EXPECT_GT(picture(scene, integrator, 2, 4)[0].mean(), 0.0);
  }
}

// --- Sampling
// -------------------------------------------------------------------------------------

TEST(LightRules, EmittersThatNobodyLooksForAreFoundByChance) {
  const auto make = [](bool sampled) {
    SceneKit kit = open_box();
    MaterialDesc glow{"glow", emission(Rgb(1, 0.8f, 0.6f), 3), sampled};
    kit.add("lamp", plane(1.2f, 1.2f), emission(Rgb(1), 1), translation({0, 0, 0.9f}));
    kit.builder.set_material("lamp", glow);
    return kit.build();
  };
  const auto reference = picture(make(true), IntegratorType::Bdpt, 16, 3);
  for (const IntegratorType integrator : {IntegratorType::Bdpt, IntegratorType::PathTracer}) {
    expect_agreement(picture(make(false), integrator, 96, 3), reference);
  }
  RenderSession session(make(false), small_picture(IntegratorType::Bdpt, 2));
  session.start();
  session.finish();
  EXPECT_EQ(session.statistics().counters.light_paths, 0u);
  EXPECT_EQ(session.statistics().counters.nee_samples, 0u);
}

}  // namespace
}  // namespace janus::test
