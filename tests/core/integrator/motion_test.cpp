// SPDX-License-Identifier: GPL-3.0-or-later
//
// A blurred picture is the mean of the pictures of all times, whichever integrator makes it.
#include <numeric>

#include "janus/render/time_slice.h"
#include "support/pictures.h"

namespace janus::test {
namespace {

// All that may move, moves: a block, a lamp of triangles, a ball that changes its form, the camera.
SceneKit moving_room() {
  MeshDesc form = ball(0.3f, 12, true);
  MeshKey round{form.positions, form.corner_normals}, flat = round;
  for (size_t i = 0; i < form.positions.size(); ++i) {
    flat.positions[i] *= vec3(1.5f, 1, 0.3f);
    flat.normals[i] = normalize(flat.normals[i] / vec3(1.5f, 1, 0.3f));
  }
  form.motion = {round, flat};
  SceneKit kit = open_box();
  kit.add("form", form, plastic(Rgb(0.3f, 0.6f, 0.2f), 0.3f), translation({0.4f, 0, -0.4f}));
  kit.add("block", cuboid({-0.3f, -0.3f, -0.4f}, {0.3f, 0.3f, 0.4f}), diffuse(Rgb(0.7f)));
  kit.builder.set_instance_motion("block",
                                  {translation({-0.6f, 0, -0.5f}),
                                   translation({-0.3f, 0.3f, 0.2f}) * rotation({0, 1, 1}, 1.5f)});
  kit.add("lamp", plane(0.4f, 0.4f), emission(Rgb(1, 0.9f, 0.7f), 6));
  kit.builder.set_instance_motion(
      "lamp", {translation({-0.5f, 0, 0.8f}),
               translation({0.6f, 0.2f, 0.6f}) * rotation({0, 1, 0}, 0.8f) * scaling(vec3(1.5f))});
  kit.builder.set_camera_motion({{look_at({0, -3.2f, 0}, {0, 0, 0}), -0.42f, 0.42f, -0.42f, 0.42f},
                                 {look_at({0.3f, -3, 0.2f}, {0, 0, 0}), -0.4f, 0.4f, -0.4f, 0.4f}});
  return kit;
}

TEST(MotionBlur, IsTheSameByAllIntegrators) {
  const auto scene = moving_room().build();
  EXPECT_TRUE(scene->diagnostics.empty());
  expect_integrators_agree(scene, 48, true);
}

// A lamp that moves through a pattern of light: where to look for it is known from one time alone.
TEST(MotionBlur, IsTheSameOfLightThatVaries) {
  NodeGraph pattern = emission(Rgb(1), 6);
  pattern.nodes.push_back(node("Place", "NEW_GEOMETRY", {}));
  pattern.nodes.push_back(node("Pattern", "TEX_CHECKER",
                               {{"Vector", link("Place", "Position")},
                                {"Color1", vec4(1, 0.9f, 0.7f, 1)},
                                {"Color2", vec4(0.4f)},
                                {"Scale", 6.0f}}));
  pattern.nodes.front().inputs["Color"] = link("Pattern", "Color");
  SceneKit kit = room();
  kit.add("lamp", plane(0.5f, 0.5f), pattern);
  kit.builder.set_instance_motion("lamp",
                                  {translation({-0.4f, 0, 0.8f}), translation({0.5f, 0.2f, 0.7f})});
  const auto scene = kit.build();
  EXPECT_TRUE(scene->diagnostics.empty());
  expect_integrators_agree(scene, 192, true);
}

TEST(MotionBlur, IsTheSameByClassicBdpt) {
  RenderSettings settings = small_picture(IntegratorType::Bdpt, samples(72));
  settings.connection_mode = ConnectionMode::Classic;
  expect_as_path_traced(moving_room(), settings, 288);
}

// Small caches make parts of each wave.
TEST(MotionBlur, IsTheSameInPartsOfWaves) {
  RenderSettings settings = small_picture(IntegratorType::Bdpt, samples(24));
  settings.width = settings.height = 160;
  settings.cache_bytes = 1 << 18;
  settings.samples = samples(2);
  expect_as_path_traced(moving_room(), settings, 6);
}

TEST(MotionBlur, IsTheMeanOfAllTimes) {
  const auto scene = moving_room().build();
  const auto blurred = quarters(scene, small_picture(IntegratorType::PathTracer, samples(96)));
  std::vector<Mean> mean(5);
  for (int k = 0, count = seeds(); k < count; ++k) {
    // An estimate by itself: one time of each twelfth, at random.
    std::vector<double> sums(5);
    constexpr int kTimes = 12;
    for (int i = 0; i < kTimes; ++i) {
      const float jitter = glm::fract(0.618034f * static_cast<float>(i * 12 + k));
      const auto slice = at_time(scene, (static_cast<float>(i) + jitter) / kTimes, {});
      RenderSettings settings = small_picture(IntegratorType::PathTracer, samples(16));
      settings.seed = static_cast<uint32_t>(100 * k + i);
      const auto found = quarters(slice, settings, 1);
      for (size_t q = 0; q < 5; ++q) {
        sums[q] += found[q].mean() / kTimes;
      }
    }
    for (size_t q = 0; q < 5; ++q) {
      mean[q].add(sums[q]);
    }
  }
  expect_agreement(blurred, mean);
}

// Light paths from far away start around all that there is at any time.
TEST(MotionBlur, SunAndSkyReachWhatMovesAway) {
  SceneKit kit;
  kit.add("floor", plane(1, 1), diffuse(Rgb(0.6f)));
  kit.add("plate", plane(1, 1), diffuse(Rgb(0.7f)));
  kit.builder.set_instance_motion("plate", {translation({0, 0, 0.1f}), translation({3, 0, 1}),
                                            translation({6, 1, 0.5f}) * rotation({1, 0, 0}, 1)});
  kit.light("sun", sun_light({0.2f, 0.1f, 1}, 2, 0.1f)).world(Rgb(0.3f));
  kit.camera({3, 0, 9}, {3, 0, 0}, 0.45f);
  expect_integrators_agree(kit.build(), 64, true);
}

TEST(MotionBlur, DoesNotDependOnThreads) {
  const auto scene = moving_room().build();
  RenderSettings settings = small_picture(IntegratorType::Bdpt, 3);
  settings.threads = 1;
  const Image one = render(scene, settings);
  settings.threads = 5;
  EXPECT_EQ(render(scene, settings).pixels, one.pixels);
  settings.motion_blur = false;
  EXPECT_NE(render(scene, settings).pixels, one.pixels);
}

// A plate at 3 metres moves by 0.4 to the right and 0.2 down in two frames, and the window is one
// metre wide there: by a fifth of the picture's ten pixels from frame to frame.
TEST(MotionBlur, IsSaidByThePassVector) {
  SceneKit kit;
  const mat4 upright = rotation({1, 0, 0}, 0.5f * kPi);
  kit.add("plate", plane(0.4f, 0.4f), diffuse(Rgb(0.5f)), upright);
  kit.builder.set_instance_motion("plate", {translation({-0.2f, 0, 0.1f}) * upright, upright,
                                            translation({0.2f, 0, -0.1f}) * upright});
  kit.camera({0, -3, 0}, {0, 0, 0}, 0.5f / 3);
  RenderSettings settings = small_picture(IntegratorType::PathTracer, 4);
  settings.width = settings.height = 10;
  settings.motion_blur = false;
  settings.data.passes[static_cast<size_t>(DataPass::Vector)] = true;
  RenderSession session(kit.build(), settings);
  session.start();
  session.finish();
  const Image vector = session.snapshot("Vector");
  ASSERT_EQ(vector.channels, 4);
  const float* middle = &vector.pixels[4 * (5 * 10 + 5)];
  EXPECT_NEAR(middle[0], -2, 1e-4f);
  EXPECT_NEAR(middle[1], 1, 1e-4f);
  EXPECT_NEAR(middle[2], -2, 1e-4f);
  EXPECT_NEAR(middle[3], 1, 1e-4f);
  EXPECT_EQ(vector.pixels[0], 0.0f);  // the world does not move
}

}  // namespace
}  // namespace janus::test
