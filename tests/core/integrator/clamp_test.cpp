// SPDX-License-Identifier: GPL-3.0-or-later
//
// Clamping: what a contribution may add to a sample of a pixel.
#include "janus/integrator/clamp.h"

#include "support/pictures.h"
#include "support/scene_kit.h"

namespace janus::test {
namespace {

TEST(Clamp, LimitsTheMeanOfTheChannels) {
  const Clamp clamp(2.0f, 0.5f);
  EXPECT_EQ(clamp(Rgb(1, 2, 3), 2), Rgb(1, 2, 3));  // the mean is 2
  EXPECT_EQ(clamp(Rgb(4, 0, 8), 1), Rgb(2, 0, 4));
  EXPECT_EQ(clamp(Rgb(4, 0, 8), 2), Rgb(2, 0, 4));
  EXPECT_EQ(clamp(Rgb(4, 0, 8), 3), Rgb(0.5f, 0, 1));
  const Clamp off(0.0f, 0.0f);
  EXPECT_EQ(off(Rgb(1e30f), 2), Rgb(1e30f));
  EXPECT_EQ(off(Rgb(1e30f), 3), Rgb(1e30f));
}

SceneKit lit_box() { return open_box().light("l", area_light({0, 0, 0.9f}, {0, 0, 0}, 0.5f, 60)); }

// No sample holds more than the limit for each of its contributions: here one per path length.
TEST(Clamp, BoundsEveryIntegrator) {
  const auto scene = lit_box().build();
  for (const IntegratorType integrator :
       {IntegratorType::PathTracer, IntegratorType::LightTracer, IntegratorType::Bdpt}) {
    SCOPED_TRACE(::testing::Message() << "integrator " << static_cast<int>(integrator));
    RenderSettings settings = small_picture(integrator, samples(16));
    settings.max_bounces = 1;
    const double all = quarters(scene, settings)[0].mean();
    settings.clamp_indirect = 0.02f;
    const auto indirect = quarters(scene, settings);
    settings.max_bounces = 0;
    const double direct = quarters(scene, settings)[0].mean();
    EXPECT_LT(indirect[0].mean(), all - 0.5 * (all - direct));  // cut
    EXPECT_GT(indirect[0].mean(), 0.98 * direct);               // and nothing but indirect light
    settings.clamp_direct = 0.1f;
    const double clamped = quarters(scene, settings)[0].mean();
    EXPECT_LT(clamped, 0.7 * direct);
    EXPECT_GT(clamped, 0.01 * direct);
  }
}

// With weights, no contribution is larger than the lamp seen by way of surfaces that reflect less
// than they get: a limit of its radiance, P / (pi A), cuts nothing. Single techniques know no
// bounds. (Roulette makes contributions larger.)
TEST(Clamp, ActsOnWeightedContributions) {
  constexpr float kSize = 1.8f, kWatts = 60.0f;
  const auto scene =
      open_box().light("l", area_light({0, 0, 0.9f}, {0, 0, 0}, kSize, kWatts)).build();
  RenderSettings settings = small_picture(IntegratorType::Bdpt, samples(4));
  settings.roulette = false;
  const Image open = render(scene, settings);
  settings.clamp_direct = settings.clamp_indirect = 1.001f * kWatts / (kPi * kSize * kSize);
  EXPECT_EQ(open.pixels, render(scene, settings).pixels);
  settings.strategies = Technique{2, 2};
  const Image cut = render(scene, settings);
  settings.clamp_direct = settings.clamp_indirect = 0.0f;
  EXPECT_NE(cut.pixels, render(scene, settings).pixels);
}

TEST(Clamp, BoundsEveryTechnique) {
  const auto scene = lit_box().build();
  for (const int edges : {2, 3}) {
    for (int s = 0; s <= edges; ++s) {
      SCOPED_TRACE(::testing::Message() << "s = " << s << ", t = " << edges + 1 - s);
      RenderSettings settings = small_picture(IntegratorType::Bdpt, samples(4));
      settings.strategies = Technique{s, edges + 1 - s};
      const double open = quarters(scene, settings)[0].mean();
      (edges == 2 ? settings.clamp_direct : settings.clamp_indirect) = 1e-4f;
      const double cut = quarters(scene, settings)[0].mean();
      EXPECT_LT(cut, 0.1 * open);
      EXPECT_GT(cut, 0.0);
    }
  }
}

// Roulette on contributions makes fewer of them larger, but not what a limit leaves of them. The
// limit is half of what they are made, a tenth of the picture, and many connections are smaller
// than that. (Up to three edges walks play none.)
TEST(Clamp, RouletteOnContributionsChangesNoExpectation) {
  LightDesc lamp = area_light({0, 0, 0.9f}, {0, 0, 0}, 0.5f, 60);
  lamp.visibility = kLabels;
  const auto scene = open_box().light("l", lamp).build();
  RenderSettings settings = small_picture(IntegratorType::Bdpt, samples(32));
  settings.max_bounces = 1;
  settings.connections = 16.0f;
  settings.clamp_indirect = static_cast<float>(0.05 * quarters(scene, settings, 2)[0].mean());
  RenderSettings without = settings;
  without.roulette = false;
  without.seed = 50;
  expect_agreement(quarters(scene, settings), quarters(scene, without), 0.01);
}

// A path tracer's sample with one contribution: min(value, limit) on average.
TEST(Clamp, OneContributionIsCutToTheLimit) {
  SceneKit kit;
  kit.add("wall", plane(9, 9), emission(Rgb(3), 1)).camera({0, 0, 3}, {0, 0, 0}, 0.1f);
  const auto scene = kit.build();
  for (const IntegratorType integrator :
       {IntegratorType::PathTracer, IntegratorType::LightTracer, IntegratorType::Bdpt}) {
    RenderSettings settings = small_picture(integrator, 2);
    settings.clamp_direct = 1.25f;
    EXPECT_NEAR(quarters(scene, settings, 2)[0].mean(), 1.25, 1e-5);
    settings.clamp_direct = 5.0f;
    settings.clamp_indirect = 0.01f;
    EXPECT_NEAR(quarters(scene, settings, 2)[0].mean(), 3.0, 1e-5);
  }
}

}  // namespace
}  // namespace janus::test
