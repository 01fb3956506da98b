// SPDX-License-Identifier: GPL-3.0-or-later
//
// Scenes and settings in which mistakes show that the other tests were seen to miss (tests/mutation
// makes them): few light paths in a pass, crossings of transparent surfaces, many lights, small
// sizes.
#include "support/pictures.h"
#include "support/scene_kit.h"

namespace janus::test {
namespace {

SceneKit lit_box() { return open_box().light("l", area_light({0, 0, 0.9f}, {0, 0, 0}, 0.5f, 20)); }

// The number of cached vertices varies by half of itself from pass to pass; weights must not.
TEST(Mistakes, AHandfulOfLightPathsPerPass) {
  RenderSettings settings = small_picture(IntegratorType::Bdpt, samples(256));
  settings.light_paths = 2.0f / 256.0f;
  settings.connections = 4.0f;
  expect_as_path_traced(lit_box(), settings, 160);
}

// Two cells with a lamp each, and one pixel that sees both. What the camera path and the light path
// have in common shows in full: were the choice of the lamp that of the cell, the joins between
// them would count twice, or never.
TEST(Mistakes, OneLightPathAndOneCameraPath) {
  SceneKit kit = open_box();
  kit.add("wall", cuboid({-0.05f, -1, -1}, {0.05f, 1, 1}), diffuse(Rgb(0.5f)));
  for (const float x : {-0.5f, 0.5f}) {
    kit.light(x < 0 ? "a" : "b", area_light({x, 0, 0.9f}, {x, 0, 0}, 0.2f, 20));
  }
  RenderSettings settings = small_picture(IntegratorType::Bdpt, samples(8192));
  settings.width = settings.height = settings.threads = 1;
  settings.connections = 8.0f;
  expect_as_path_traced(kit, settings, 16384, 0.05);
}

// Walls, floor and ceiling 10 cm apart: short connections count as much as long ones.
TEST(Mistakes, ADollsHouse) {
  const auto size = scaling(vec3(0.05f));
  SceneKit kit;
  kit.add("box", cuboid(vec3(-1), vec3(1), true), diffuse(Rgb(0.8f)), size)
      .add("lamp", plane(0.5f, 0.5f), emission(Rgb(1), 5), size * translation({0, 0, 0.8f}))
      .camera({0, -0.16f, 0}, {0, 0, 0}, 0.42f);
  expect_as_path_traced(kit, small_picture(IntegratorType::Bdpt, samples(32)), 96);
}

// Panes that let a part of the light pass, across all kinds of edges of the paths.
SceneKit panes() {
  const NodeGraph pane =
      combine("MIX_SHADER", diffuse(Rgb(0.7f)),
              single("BSDF_TRANSPARENT", {{"Color", vec4(1, 0.9f, 0.8f, 1)}}), 0.7f);
  return lit_box()
      .add("low", plane(1.8f, 1.8f), pane, translation({0, 0, -0.5f}))
      .add("high", plane(1.8f, 1.8f), pane, translation({0, 0, 0.5f}))
      .add("upright", plane(1.8f, 1.8f), pane, rotation({0, 1, 0}, 1.4f));
}

TEST(Mistakes, Crossings) {
  expect_as_path_traced(panes(), small_picture(IntegratorType::Bdpt, samples(48)), 160);
}

TEST(Mistakes, CrossingsAreLimitedAlongTheWholePath) {
  RenderSettings settings = small_picture(IntegratorType::Bdpt, samples(48));
  settings.transparent_max_bounces = 1;
  expect_as_path_traced(panes(), settings, 160);
}

// Large lamps at different places: hits and next event estimation matter alike, and the choice of
// the light depends on where it is made.
TEST(Mistakes, ManyLargeLights) {
  SceneKit kit = open_box();
  int i = 0;
  for (const vec3 p : {vec3(-0.6f, 0.3f, -0.5f), vec3(0.6f, 0.4f, 0.5f), vec3(0.5f, -0.4f, -0.6f),
                       vec3(-0.5f, -0.2f, 0.6f)}) {
    const auto strength = static_cast<float>(1 << i);
    kit.add("lamp" + std::to_string(i++), ball(0.3f, 6), emission(Rgb(1), strength),
            translation(p));
  }
  expect_as_path_traced(kit, small_picture(IntegratorType::Bdpt, samples(32)), 96);
}

// Lamps of no size on both sides of a leaf: the path tracer has next event estimation alone to see
// those behind it, so the choice of the lamp must not leave them out.
TEST(Mistakes, LampsBehindALeaf) {
  SceneKit kit;
  kit.add("leaf", plane(0.9f, 0.9f), single("BSDF_TRANSLUCENT", {}), rotation({1, 0, 0}, 1.5708f))
      .light("before", point_light({0.3f, -0.8f, 0.2f}, 10))
      .light("behind", point_light({-0.3f, 0.6f, 0.1f}, 20))
      .camera({0, -2, 0}, {0, 0, 0}, 0.4f);
  expect_as_path_traced(kit, small_picture(IntegratorType::Bdpt, samples(32)), 96);
}

}  // namespace
}  // namespace janus::test
