// SPDX-License-Identifier: GPL-3.0-or-later
//
// Counts that are chosen: from known integrals, and for scenes whose best technique is known.
#include "janus/integrator/adaptive_counts.h"

#include <algorithm>
#include <random>

#include "support/pictures.h"
#include "support/scene_kit.h"

namespace janus::test {
namespace {

constexpr size_t index_of(Effort effort) {
  return static_cast<size_t>(std::ranges::find(AdaptiveCounts::kCandidates, effort) -
                             AdaptiveCounts::kCandidates.begin());
}
constexpr size_t kInsurance = index_of({AdaptiveCounts::kInsurance, 0}),
                 kAsMeasured = index_of({1, 1}), kTwice = index_of({2, 1});

constexpr Effort kLeast{AdaptiveCounts::kInsurance, 0};

// Two techniques for the integral of x over [0, 1): uniform (as next event estimation) and with
// density 2 x (as splats), which has no noise of its own. From samples with counts 1 and n, the
// second moment with any other counts m is the integral of x^2 / (1 + 2 m x).
TEST(AdaptiveCountsMoments, PredictOtherCounts) {
  constexpr int kSamples = 200000;
  const float n = 1.5f;
  const AdaptiveCounts meter(SampleCounts{0.0f, 1.0f, 0.0f, n});
  AdaptiveCounts::Moments moments;
  AdaptiveCounts::Gauge gauge(&meter, moments, 1.0f);
  std::mt19937 random(7);
  std::uniform_real_distribution<float> uniform(0.001f, 1.0f);
  std::bernoulli_distribution half(0.5);
  for (int i = 0; i < kSamples; ++i) {
    const float a = uniform(random), b = std::sqrt(uniform(random));
    gauge.add(Rgb(a / (1 + 2 * n * a)), {0, {0, 1, 0, 2 * a}});
    for (int k = 0; k < 1 + half(random); ++k) {  // n samples in the mean
      gauge.add(Rgb(b / (1 + 2 * n * b)), {0, {0, 1 / (2 * b), 0, 1}});
    }
  }
  const auto expected = [](double m) {
    double sum = 0;
    for (int i = 0; i < 1000; ++i) {
      const double x = (i + 0.5) / 1000;
      sum += x * x / (1 + 2 * m * x) / 1000;
    }
    return sum;
  };
  const double insurance = expected(n * AdaptiveCounts::kInsurance);
  EXPECT_NEAR(moments.second[kInsurance] / kSamples, insurance, 0.01 * insurance);
  EXPECT_NEAR(moments.second[kAsMeasured] / kSamples, expected(n), 0.01 * expected(n));
  EXPECT_NEAR(moments.second[kTwice] / kSamples, expected(2 * n), 0.01 * expected(2 * n));
}

// A technique that always gives the same has a second moment, and no noise.
TEST(AdaptiveCountsMoments, WhatRecursIsNoNoise) {
  const AdaptiveCounts meter(SampleCounts{1.0f, 1.0f, 1.0f, 1.0f});
  AdaptiveCounts::Moments moments;
  AdaptiveCounts::Gauge previous;
  for (int i = 0; i < 1000; ++i) {
    AdaptiveCounts::Gauge gauge(&meter, moments, 2.0f);
    gauge.add_single(Rgb(1.0f), {1, {0, 1, 0, 1}}, 2, true);
    gauge.pair(previous);
    previous = gauge;
  }
  // Relative to 2, and half the weight of the path is another technique's.
  EXPECT_NEAR(moments.second[kAsMeasured], 1000 * 0.25, 1e-3);
  EXPECT_NEAR(moments.steady[kAsMeasured], 999 * 0.25, 1e-3);
  EXPECT_NEAR(moments.steady[kInsurance], 999.0 / sqr(1.0 + AdaptiveCounts::kInsurance), 1e-3);
}

TEST(AdaptiveCountsChoice, WeighsNoiseAgainstRays) {
  Counters work;
  work.camera_rays = work.light_rays = work.splat_rays = work.connections = 1000;
  AdaptiveCounts::Moments moments;
  moments.second.fill(1.0);
  EXPECT_EQ(AdaptiveCounts::choose(moments, work, false), kLeast);  // nothing gained
  EXPECT_GT(AdaptiveCounts::choose(moments, work, true).connections, 0);
  moments.second[kTwice] = 0.01;
  EXPECT_EQ(AdaptiveCounts::choose(moments, work, false), (Effort{2, 1}));
  work.light_rays = 1000000;
  moments.second[kTwice] = 0.1;  // ten times less noise at a thousand times the price
  EXPECT_EQ(AdaptiveCounts::choose(moments, work, false), kLeast);
}

// --- Scenes --------------------------------------------------------------------------------------

Effort chosen(const SceneKit& kit) {
  RenderSettings settings = small_picture(IntegratorType::Bdpt, 3);
  settings.width = settings.height = 64;
  settings.adaptive_counts = true;
  RenderSession session(kit.build(), settings);
  session.start();
  session.finish();
  return session.statistics().effort;
}

TEST(AdaptiveCounts, LampOverAFloorNeedsHardlyAnyLightPaths) {
  SceneKit kit;
  kit.add("floor", plane(2, 2), diffuse(Rgb(0.5f)), rotation({1, 0, 0}, 0.5f));
  EXPECT_EQ(chosen(kit.light("l", point_light({0, -0.5f, 1}, 50))), kLeast);
}

TEST(AdaptiveCounts, WorldOverABallNeedsHardlyAnyLightPaths) {
  SceneKit kit;
  kit.add("ball", ball(0.8f), diffuse(Rgb(0.5f)));
  EXPECT_EQ(chosen(kit.world(Rgb(1.0f))), kLeast);
}

// A lamp in a shade that is open to the ceiling: all of the light is indirect.
SceneKit hidden_light() {
  return room()
      .add("shade", cuboid({-0.15f, -0.15f, 0.55f}, {0.15f, 0.15f, 0.57f}), diffuse(Rgb(0.5f)))
      .light("l", area_light({0, 0, 0.58f}, {0, 0, 1}, 0.2f, 20));
}

TEST(AdaptiveCounts, HiddenLightNeedsLightPaths) {
  EXPECT_GT(chosen(hidden_light()).light_paths, AdaptiveCounts::kInsurance);
}

// Weights and estimates follow the counts together.
TEST(AdaptiveCounts, ChangeNoExpectation) {
  const SceneKit kit = hidden_light();
  const Effort effort = chosen(kit);
  EXPECT_NE(effort.light_paths, 1.0f);
  EXPECT_NE(effort, kLeast);
  const auto scene = kit.build();
  RenderSettings settings = small_picture(IntegratorType::Bdpt, samples(64));
  RenderSettings adaptive = settings;
  adaptive.adaptive_counts = true;
  adaptive.seed = 100;
  expect_agreement(quarters(scene, settings), quarters(scene, adaptive));
}

TEST(AdaptiveCounts, CausticOfAPointIsNeverGivenUp) {
  // Camera walks cannot make the path lamp - mirror - floor, however little of the light it is.
  SceneKit kit;
  kit.add("floor", plane(2, 2), diffuse(Rgb(0.5f)), rotation({1, 0, 0}, 0.5f));
  kit.add("mirror", plane(0.01f, 0.01f), mirror(Rgb(0.9f)), translation({5, 5, 0}));
  const Effort effort = chosen(kit.light("l", point_light({0, -0.5f, 1}, 50)));
  EXPECT_GT(effort.connections, 0);
}

}  // namespace
}  // namespace janus::test
