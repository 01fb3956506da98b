// SPDX-License-Identifier: GPL-3.0-or-later
//
// Adaptive sampling: renders that end early, and pixels that get fewer samples than others.
#include <algorithm>

#include "support/pictures.h"

namespace janus::test {
namespace {

RenderSettings adaptive(IntegratorType integrator, float threshold, int most) {
  RenderSettings settings = small_picture(integrator, most);
  settings.noise_threshold = threshold;
  settings.data.passes[static_cast<size_t>(DataPass::SampleCount)] = true;
  return settings;
}

TEST(Adaptive, EndsWhenAllPixelsAreGood) {
  const auto scene = SceneKit().world(Rgb(0.5f)).build();
  for (const auto& [threshold, least, expected] :
       {std::tuple(0.1f, 0, 32), {0.01f, 0, 64}, {0.01f, 5, 16}, {0.01f, 90, 96}}) {
    RenderSettings settings = adaptive(IntegratorType::PathTracer, threshold, 1000);
    settings.min_samples = least;
    RenderSession session(scene, settings);
    session.start();
    session.finish();
    EXPECT_EQ(session.statistics().samples, expected);
    EXPECT_EQ(session.progress().state, Progress::State::Done);
    const Image counts = session.snapshot("Debug Sample Count");
    EXPECT_EQ(counts.pixels, std::vector<float>(256, static_cast<float>(expected)));
    EXPECT_EQ(session.snapshot().pixels[0], 0.5f);
  }
}

// A lit wall with a dark, noisy niche: where it is quiet pixels stop, and the picture is right.
TEST(Adaptive, GivesNoisyPixelsMoreSamples) {
  SceneKit kit = open_box().light("l", area_light({0, 0, 0.9f}, {0, 0, 0}, 0.5f, 20));
  kit.add("lamp", plane(0.8f, 0.8f), emission(Rgb(1), 2),
          translation({-0.5f, -0.9f, 0.5f}) * rotation({1, 0, 0}, 0.5f * kPi));
  const auto scene = kit.build();
  for (const auto& [integrator, mode] :
       {std::pair(IntegratorType::PathTracer, ConnectionMode::Cache),
        {IntegratorType::LightTracer, ConnectionMode::Cache},
        {IntegratorType::Bdpt, ConnectionMode::Cache},
        {IntegratorType::Bdpt, ConnectionMode::Classic}}) {
    SCOPED_TRACE(::testing::Message() << static_cast<int>(integrator) << static_cast<int>(mode));
    RenderSettings settings = adaptive(integrator, 0.02f, 400);
    settings.connection_mode = mode;
    RenderSession session(scene, settings);
    session.start();
    session.finish();
    const Image counts = session.snapshot("Debug Sample Count");
    const auto [least, most] = std::ranges::minmax(counts.pixels);
    EXPECT_GE(least, 52.0f);
    EXPECT_LT(least, integrator == IntegratorType::LightTracer ? 400.0f : 0.6f * most);
    settings.noise_threshold = 0.0f;
    const Image reference = render(scene, settings), image = session.snapshot();
    double sum = 0.0, off = 0.0;
    for (size_t i = 0; i < image.pixels.size(); ++i) {
      sum += reference.pixels[i];
      off += image.pixels[i] - reference.pixels[i];
    }
    EXPECT_NEAR(off / sum, 0.0, 0.01);
  }
}

TEST(Adaptive, DoesNotDependOnThreads) {
  const auto scene = room().light("l", point_light({0.1f, 0, 0.6f}, 20, 0.1f)).build();
  RenderSettings settings = adaptive(IntegratorType::Bdpt, 0.05f, 120);
  settings.threads = 1;
  const Image one = render(scene, settings);
  settings.threads = 3;
  EXPECT_EQ(render(scene, settings).pixels, one.pixels);
  settings.noise_threshold = -1.0f;
  EXPECT_THROW(RenderSession(scene, settings), SceneError);
}

}  // namespace
}  // namespace janus::test
