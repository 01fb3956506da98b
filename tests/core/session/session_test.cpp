// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/session/session.h"

#include "janus/util/error.h"
#include "support/pictures.h"
#include "support/scene_kit.h"

namespace janus::test {
namespace {

std::shared_ptr<const Scene> scene() {
  return open_box()
      .add("ball", ball(0.4f, 16, true), glass(Rgb(1), 1.5f))
      .light("l", area_light({0, 0, 0.9f}, {0, 0, 0}, 0.5f, 20))
      .build();
}

RenderSettings endless() {
  RenderSettings s = small_picture(IntegratorType::Bdpt, 1 << 20);
  s.width = s.height = 200;
  return s;
}

class Threads : public ::testing::TestWithParam<IntegratorType> {};

TEST_P(Threads, SameImageBitForBit) {
  RenderSettings settings = small_picture(GetParam(), 5);
  settings.width = 61;  // not a multiple of anything
  settings.height = 37;
  settings.filter = FilterType::BlackmanHarris;
  settings.filter_width = 1.5f;
  settings.cache_bytes = 1 << 19;  // several waves
  settings.threads = 1;
  const Image one = render(scene(), settings);
  for (const int threads : {2, 3, 7}) {
    settings.threads = threads;
    EXPECT_EQ(one.pixels, render(scene(), settings).pixels) << threads << " threads";
  }
  settings.seed = 1;
  EXPECT_NE(one.pixels, render(scene(), settings).pixels);
}

INSTANTIATE_TEST_SUITE_P(Integrators, Threads,
                         ::testing::Values(IntegratorType::Bdpt, IntegratorType::PathTracer,
                                           IntegratorType::LightTracer));

TEST(Crop, ShowsTheSameSamples) {
  RenderSettings settings = small_picture(IntegratorType::PathTracer, 3);
  const Image full = render(scene(), settings);
  settings.crop = FilmRect{3, 5, 12, 9};
  const Image crop = render(scene(), settings);
  ASSERT_EQ(crop.width, 9);
  ASSERT_EQ(crop.height, 4);
  for (int y = 0; y < 4; ++y) {
    for (int i = 0; i < 9 * 4; ++i) {
      EXPECT_EQ(crop.pixels[y * 36 + i], full.pixels[((y + 5) * 16 + 3) * 4 + i]);
    }
  }
}

TEST(Session, CancelKeepsWholePasses) {
  RenderSession session(scene(), endless());
  EXPECT_EQ(session.progress().state, Progress::State::Waiting);
  session.start();
  while (session.progress().samples < 2) {
    EXPECT_FALSE(session.wait(0.01));
  }
  session.cancel();
  session.finish();  // no error
  EXPECT_EQ(session.progress().state, Progress::State::Cancelled);
  const int samples = session.statistics().samples;
  EXPECT_GE(samples, 2);

  RenderSettings same = endless();
  same.samples = samples;
  EXPECT_EQ(session.snapshot().pixels, render(scene(), same).pixels);
}

TEST(Session, CanBeDroppedWhileItRuns) {
  RenderSession session(scene(), endless());
  session.start();
}

TEST(Session, BlackBeforeTheFirstPass) {
  RenderSession session(scene(), small_picture(IntegratorType::Bdpt, 1));
  const Image image = session.snapshot();
  EXPECT_EQ(image.pixels, std::vector<float>(16 * 16 * 4, 0.0f));
}

TEST(Session, StartsOnce) {
  RenderSession session(scene(), small_picture(IntegratorType::Bdpt, 1));
  session.start();
  EXPECT_THROW(session.start(), Error);
}

TEST(Session, TimeLimit) {
  RenderSettings settings = endless();
  settings.seconds = 0.3;
  RenderSession session(scene(), settings);
  session.start();
  session.finish();
  EXPECT_EQ(session.progress().state, Progress::State::Done);
  EXPECT_GE(session.statistics().samples, 1);
  EXPECT_LT(session.statistics().samples, settings.samples);
}

TEST(Session, CountsWhatItDid) {
  RenderSettings settings = small_picture(IntegratorType::Bdpt, 4);
  settings.light_paths = 2.0f;
  RenderSession session(scene(), settings);
  session.start();
  session.finish();
  const Counters c = session.statistics().counters;
  EXPECT_EQ(c.camera_paths, 4u * 256);
  EXPECT_EQ(c.light_paths, 4u * 512);
  EXPECT_GT(c.camera_rays, c.camera_paths);
  EXPECT_GT(c.light_rays, c.light_paths);
  EXPECT_GT(c.nee_rays, 0u);
  EXPECT_GT(c.connection_rays, 0u);
  EXPECT_GT(c.splat_rays, 0u);
  EXPECT_EQ(c.dropped, 0u);
}

TEST(Session, UnusedTechniquesCostNothing) {
  RenderSettings settings = small_picture(IntegratorType::Bdpt, 4);
  settings.light_paths = 0.0f;
  RenderSession session(scene(), settings);
  session.start();
  session.finish();
  const Counters c = session.statistics().counters;
  EXPECT_EQ(c.light_paths + c.light_rays + c.connection_rays + c.splat_rays, 0u);
}

TEST(Settings, ErrorsNameTheSetting) {
  const auto path_of = [](auto change) {
    RenderSettings settings;
    change(settings);
    try {
      settings.validate();
    } catch (const SceneError& e) {
      EXPECT_EQ(e.key, "settings");
      return e.path;
    }
    return std::string();
  };
  EXPECT_EQ(path_of([](RenderSettings&) {}), "");
  EXPECT_EQ(path_of([](RenderSettings& s) { s.width = 0; }), "width");
  EXPECT_EQ(path_of([](RenderSettings& s) { s.samples = 0; }), "samples");
  EXPECT_EQ(path_of([](RenderSettings& s) { s.seconds = NAN; }), "seconds");
  EXPECT_EQ(path_of([](RenderSettings& s) { s.max_bounces = -1; }), "max_bounces");
  EXPECT_EQ(path_of([](RenderSettings& s) { s.light_paths = INFINITY; }), "light_paths");
  EXPECT_EQ(path_of([](RenderSettings& s) { s.crop = FilmRect{5, 5, 5, 9}; }), "crop");
}

}  // namespace
}  // namespace janus::test
