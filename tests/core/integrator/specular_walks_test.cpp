// SPDX-License-Identifier: GPL-3.0-or-later
//
// Additional walks over deltas: they change no expectation, calm what chance alone finds, and are
// made where it pays.
#include <algorithm>

#include "janus/integrator/adaptive_counts.h"
#include "support/pictures.h"

namespace janus::test {
namespace {

// A lamp that the camera does not see is seen in a ball of chrome and through one of glass, in a
// box that is nearly black.
SceneKit glints(float size = 0.3f, Rgb box = Rgb(0.02f)) {
  SceneKit kit = open_box(box);
  LightDesc lamp = area_light({0, -0.2f, 0.9f}, {0, 0, 0}, size, 20);
  lamp.visibility &= ~ray_bit(RayType::Camera);
  kit.add("chrome", ball(0.15f, 32, true), mirror(Rgb(0.9f)), translation({0.4f, 0, 0.4f}))
      .add("glass", ball(0.15f, 32, true), glass(Rgb(0.9f, 1, 1), 1.5f),
           translation({-0.4f, 0, -0.4f}))
      .light("l", lamp);
  return kit;
}

RenderSettings bdpt(int count) { return small_picture(IntegratorType::Bdpt, count); }

Counters work(const SceneKit& kit, int count = 32) {
  RenderSession session(kit.build(), bdpt(count));
  session.start();
  session.finish();
  return session.statistics().counters;
}

TEST(SpecularWalks, ChangeNoExpectation) {
  expect_as_path_traced(glints(0.3f, Rgb(0.5f)), bdpt(samples(64)), 192);
}

// A clamp sees each walk's light as it is, not the mean.
TEST(SpecularWalks, AreClampedOneByOne) {
  RenderSettings settings = bdpt(samples(64));
  settings.clamp_direct = settings.clamp_indirect = 1.0f;
  settings.max_bounces = 1;
  expect_as_path_traced(glints(0.5f), settings, 192);
}

TEST(SpecularWalks, DimNoDirectView) {
  SceneKit kit = glints();
  kit.light("seen", area_light({0, -1.0f, 0}, {0, -4, 0}, 0.4f, 0.5f));
  expect_as_path_traced(kit, bdpt(samples(64)), 192);
}

// Nearly all that a ball with a rough layer, too, shows of a large lamp is found by hits: those
// stay with the camera's walk.
TEST(SpecularWalks, LeaveRoughHitsAlone) {
  SceneKit kit = open_box(Rgb(0.02f));
  kit.add("ball", ball(0.4f, 32, true),
          combine("ADD_SHADER", mirror(Rgb(0.2f)),
                  single("BSDF_GLOSSY", {{"Color", vec4(0.7f)}, {"Roughness", 0.2f}})))
      .light("l", area_light({0, -0.2f, 0.9f}, {0, 0, 0}, 1.2f, 20));
  expect_as_path_traced(kit, bdpt(samples(64)), 192);
}

TEST(SpecularWalks, CalmGlints) {
  const auto scene = glints(0.1f).build();
  RenderSettings pt = bdpt(64);
  pt.integrator = IntegratorType::PathTracer;
  const auto error = [&](const RenderSettings& settings) {
    double worst = 0.0;
    for (const Mean& quarter : quarters(scene, settings, 24)) {
      worst = std::max(worst, quarter.error());
    }
    return worst;
  };
  EXPECT_LT(error(bdpt(64)), 0.6 * error(pt));
}

// Walks of their own are counted by whole passes: threads change nothing.
TEST(SpecularWalks, DoNotDependOnThreads) {
  const auto scene = glints().build();
  RenderSettings settings = bdpt(16);
  settings.threads = 1;
  const Image one = render(scene, settings);
  settings.threads = 3;
  EXPECT_EQ(one.pixels, render(scene, settings).pixels);
}

TEST(SpecularWalks, CostAQuarter) {
  const Counters c = work(glints());
  EXPECT_GT(c.specular_walks, 0u);
  const double share = static_cast<double>(c.specular_rays) / AdaptiveCounts::cost(c);
  EXPECT_GT(share, 0.1);
  EXPECT_LT(share, 0.4);
}

TEST(SpecularWalks, AreMadeWhereTheyFindSomething) {
  const auto kit = [](const NodeGraph& material) {
    return open_box().add("ball", ball(0.2f), material);
  };
  const LightDesc lamp = area_light({0, 0, 0.9f}, {0, 0, 0}, 0.3f, 20);
  const LightDesc point = point_light({0, 0, 0.9f}, 20);
  EXPECT_GT(work(kit(mirror(Rgb(0.9f))).light("l", lamp)).specular_walks, 0u);
  EXPECT_EQ(work(kit(diffuse(Rgb(0.9f))).light("l", lamp)).specular_walks, 0u);
  EXPECT_EQ(work(kit(mirror(Rgb(0.9f))).light("l", point)).specular_walks, 0u);
}

// A mirror all over the picture would need more walks than there is time for.
TEST(SpecularWalks, AreNotMadeForWholePictures) {
  SceneKit kit;
  kit.add("floor", plane(4, 4), mirror(Rgb(0.9f))).camera({0, -1, 1}, {0, 0, 0});
  kit.light("l", area_light({0, 0, 1.5f}, {0, 0, 0}, 0.3f, 20));
  EXPECT_EQ(work(kit).specular_walks, 0u);
}

}  // namespace
}  // namespace janus::test
