// SPDX-License-Identifier: GPL-3.0-or-later
//
// What must not change the picture: settings that only decide how the light is looked for, the part
// of the frame, its resolution, and the number of threads.
#include <functional>

#include "support/pictures.h"
#include "support/scene_kit.h"

namespace janus::test {
namespace {

// --- Subsets of the techniques, on a scene where all of them matter ------------------------------

struct Variant {
  std::string name;
  std::function<void(RenderSettings&)> change;
};

const Variant kVariants[] = {
    {"Defaults", [](RenderSettings&) {}},
    {"WithoutLightPaths", [](RenderSettings& s) { s.light_paths = 0.0f; }},
    {"FewLightPaths", [](RenderSettings& s) { s.light_paths = 0.3f; }},
    {"ManyLightPaths", [](RenderSettings& s) { s.light_paths = 2.0f; }},
    {"WithoutConnections", [](RenderSettings& s) { s.connections = 0.0f; }},
    {"ManyConnections", [](RenderSettings& s) { s.connections = 3.5f; }},
    {"NeitherLightPathsNorConnections",
     [](RenderSettings& s) { s.light_paths = s.connections = 0.0f; }},
    {"PowerHeuristic", [](RenderSettings& s) { s.heuristic = Heuristic::Power; }},
    {"PowerHeuristicOfManyKinds",
     [](RenderSettings& s) {
       s.heuristic = Heuristic::Power;
       s.connections = 0.4f;
       s.light_paths = 1.7f;
     }},
    {"AdaptiveCounts", [](RenderSettings& s) { s.adaptive_counts = true; }},
    {"WithoutRoulette", [](RenderSettings& s) { s.roulette = false; }},
    {"PathTracerWithPowerHeuristic",
     [](RenderSettings& s) {
       s.integrator = IntegratorType::PathTracer;
       s.heuristic = Heuristic::Power;
       s.samples *= 2;
       s.seed = 500;
     }},
    {"PathTracerWithoutRoulette",
     [](RenderSettings& s) {
       s.integrator = IntegratorType::PathTracer;
       s.roulette = false;
       s.samples *= 2;
       s.seed = 500;
     }},
    {"ManyWaves",  // a cache too small for a pass
     [](RenderSettings& s) {
       s.width = s.height = 64;
       s.samples /= 10;
       s.cache_bytes = 1 << 16;
     }},
};

std::ostream& operator<<(std::ostream& out, const Variant& v) { return out << v.name; }

class Techniques : public ::testing::Test {
 protected:
  void expect_same(const RenderSettings& settings) {
    RenderSettings reference = small_picture(IntegratorType::PathTracer, samples(96));
    reference.max_bounces = settings.max_bounces;
    expect_agreement(quarters(scene_, settings), quarters(scene_, reference));
  }
  const std::shared_ptr<const Scene> scene_ =
      room()
          .add("glass", ball(0.3f, 16, true), glass(Rgb(1), 1.5f), translation({0.5f, 0, 0.2f}))
          .light("l", area_light({0, 0, 0.95f}, {0, 0, 0}, 0.9f, 20))
          .build();
  RenderSettings bdpt_ = small_picture(IntegratorType::Bdpt, samples(64));
};

class Invariance : public Techniques, public ::testing::WithParamInterface<Variant> {};

TEST_P(Invariance, SameExpectation) {
  GetParam().change(bdpt_);
  expect_same(bdpt_);
}

INSTANTIATE_TEST_SUITE_P(Techniques, Invariance, ::testing::ValuesIn(kVariants),
                         [](const auto& info) { return info.param.name; });

TEST_F(Techniques, PathLengths) {
  for (const int bounces : {0, 1, 2}) {
    bdpt_.max_bounces = bounces;
    expect_same(bdpt_);
  }
}
TEST_F(Techniques, WideFilter) {  // splats and camera samples see the same filter
  bdpt_.filter = FilterType::BlackmanHarris;
  bdpt_.filter_width = 4.0f;
  RenderSettings reference = bdpt_;
  reference.integrator = IntegratorType::PathTracer;
  reference.samples = samples(96);
  expect_agreement(quarters(scene_, bdpt_), quarters(scene_, reference));
}
TEST_F(Techniques, CacheKeepsToItsLimit) {
  bdpt_.width = bdpt_.height = 256;
  bdpt_.samples = 1;
  for (const size_t limit : {size_t{1} << 20, size_t{4} << 20}) {
    bdpt_.cache_bytes = limit;
    RenderSession session(scene_, bdpt_);
    session.start();
    session.finish();
    EXPECT_LE(session.statistics().cache_bytes, limit);
    EXPECT_GT(session.statistics().cache_bytes, limit / 2);
  }
}
TEST_F(Techniques, WeightsOfTheRendererFollowTheDefinition) {
  bdpt_.check_weights = true;
  bdpt_.samples = 2;
  RenderSession session(scene_, bdpt_);
  session.start();
  session.finish();
  EXPECT_GT(session.statistics().weight_error, 0.0);  // rounding: something was compared
  EXPECT_LT(session.statistics().weight_error, 1e-4);
}

// --- Frames
// ---------------------------------------------------------------------------------------

class Frames : public ::testing::TestWithParam<IntegratorType> {
 protected:
  // Luminance over `part` of the frame, which the render must contain.
  Mean mean(RenderSettings settings, const FilmRect& part) const {
    Mean out;
    const FilmRect rect = settings.rect();
    settings.seed += 1000;
    for (int i = 0; i < 12; ++i, ++settings.seed) {
      const Image image = render(scene_, settings);
      double sum = 0.0;
      for (int y = part.y0; y < part.y1; ++y) {
        for (int x = part.x0; x < part.x1; ++x) {
          const size_t pixel = static_cast<size_t>(y - rect.y0) * image.width + (x - rect.x0);
          const float* p = &image.pixels[4 * pixel];
          sum += luminance(Rgb(p[0], p[1], p[2]));
        }
      }
      out.add(sum / static_cast<double>(part.pixels()));
    }
    return out;
  }
  RenderSettings settings(int count) const {
    const bool light = GetParam() == IntegratorType::LightTracer;
    return small_picture(GetParam(), samples(light ? 3 * count : count));
  }
  const std::shared_ptr<const Scene> scene_ =
      room().light("l", area_light({0, 0, 0.95f}, {0, 0, 0}, 0.9f, 20)).build();
};

// A crop has fewer light paths, and splats around it fall upon its border.
TEST_P(Frames, CropShowsThePartOfTheFrame) {
  RenderSettings whole = settings(48);
  whole.filter = FilterType::BlackmanHarris;
  whole.filter_width = 3.0f;
  RenderSettings part = whole;
  part.crop = FilmRect{3, 6, 11, 15};
  part.samples *= 3;
  part.seed = 50;
  const Mean a = mean(whole, *part.crop), b = mean(part, *part.crop);
  EXPECT_TRUE(close(a, b, 0.01));
  EXPECT_TRUE(agree(a, b, 4.8));
  // Of its lowest row, most of the filter's reach lies outside.
  const FilmRect row{3, 6, 11, 7};
  EXPECT_TRUE(close(mean(whole, row), mean(part, row), 0.02));
}

TEST_P(Frames, ResolutionDoesNotChangeTheMean) {
  const RenderSettings coarse = settings(72);
  RenderSettings fine = settings(8);
  fine.width = fine.height = 48;
  fine.seed = 50;
  const Mean a = mean(coarse, {0, 0, 16, 16}), b = mean(fine, {0, 0, 48, 48});
  EXPECT_TRUE(close(a, b, 0.01));
  EXPECT_TRUE(agree(a, b, 4.8));
  // Pixels that are not square: a window of twice the width in half the columns.
  RenderSettings narrow = settings(72);
  narrow.width = 8;
  narrow.height = 32;
  narrow.seed = 100;
  EXPECT_TRUE(close(a, mean(narrow, {0, 0, 8, 32}), 0.01));
}

TEST_P(Frames, RouletteDoesNotChangeTheMean) {
  const RenderSettings with = settings(48);
  RenderSettings without = with;
  without.roulette = false;
  EXPECT_NE(render(scene_, with).pixels, render(scene_, without).pixels);  // it plays at all
  without.seed = 50;
  const Mean a = mean(with, {0, 0, 16, 16}), b = mean(without, {0, 0, 16, 16});
  EXPECT_TRUE(close(a, b, 0.01));
  EXPECT_TRUE(agree(a, b, 4.8));
}

// Everything at once: a light tree, each kind of lobe, crossings, a lens, several waves.
TEST_P(Frames, SameImageBitForBitWithAnyNumberOfThreads) {
  SceneKit kit =
      room()
          .add("glass", ball(0.3f, 12, true), glass(Rgb(1), 1.5f), translation({0.5f, 0, 0.2f}))
          .add("rough", ball(0.25f, 10), single("BSDF_GLASS", {{"Roughness", 0.3f}, {"IOR", 1.4f}}),
               translation({-0.5f, -0.3f, 0.4f}))
          .add("pane", plane(0.8f, 0.8f),
               single("BSDF_PRINCIPLED", {{"Alpha", 0.5f}, {"Emission Strength", 0.3f}}),
               translation({0.1f, -0.4f, 0}) * rotation({1, 0, 0}, 1.3f))
          .add("metal", ball(0.2f, 10), single("BSDF_PRINCIPLED", {{"Metallic", 1.0f}}),
               translation({0.1f, 0.2f, 0.6f}))
          .light("area", area_light({0, 0, 0.95f}, {0, 0, 0}, 0.9f, 20, 2.0f))
          .light("spot", spot_light({0.5f, -0.5f, 0.9f}, {0, 0, 0}, 20, 1, 0.2f, 0.1f))
          .light("sun", sun_light({0.2f, -1, 0.5f}, 1, 0.1f))
          .world(Rgb(0.2f, 0.3f, 0.4f));
  CameraDesc camera = kit.build()->camera;
  camera.aperture_radius = 0.1f;
  camera.focus_distance = 3;
  kit.builder.set_camera(camera);
  const auto scene = kit.build();
  RenderSettings s = small_picture(GetParam(), 3);
  s.filter = FilterType::BlackmanHarris;
  s.filter_width = 1.5f;
  s.width = 80;
  s.height = 60;
  s.cache_bytes = 1 << 19;
  s.adaptive_counts = true;
  s.threads = 1;
  const Image one = render(scene, s);
  for (const int threads : {2, 3, 5}) {
    s.threads = threads;
    EXPECT_EQ(one.pixels, render(scene, s).pixels) << threads << " threads";
  }
}

std::string integrator_name(const ::testing::TestParamInfo<IntegratorType>& info) {
  constexpr const char* kNames[] = {"bdpt", "pt", "lt"};
  return kNames[static_cast<int>(info.param)];
}

INSTANTIATE_TEST_SUITE_P(Integrators, Frames,
                         ::testing::Values(IntegratorType::Bdpt, IntegratorType::PathTracer,
                                           IntegratorType::LightTracer),
                         integrator_name);

}  // namespace
}  // namespace janus::test
