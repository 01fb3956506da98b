// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every way to make a path, as an integrator or an option, against path tracing or a known answer.
#include "support/pictures.h"
#include "support/scene_kit.h"

namespace janus::test {
namespace {

std::string complaint(const std::string& text) {
  try {
    Strategies::parse(text);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(LectureStrategies, AreChosenByNumbers) {
  const Strategies all = Strategies::parse("");
  EXPECT_FLOAT_EQ(all.weight(0, 2), 1.0f);  // direct: s=1, t=1 is no strategy
  EXPECT_FLOAT_EQ(all.weight(2, 2), 0.25f);
  const Strategies some = Strategies::parse("0,*  2,3 (*,1)");
  EXPECT_FLOAT_EQ(some.weight(0, 5), 1.0f / 3);
  EXPECT_FLOAT_EQ(some.weight(2, 3), 1.0f / 3);
  EXPECT_FLOAT_EQ(some.weight(4, 1), 1.0f / 3);
  EXPECT_FLOAT_EQ(some.weight(3, 2), 0.0f);
  EXPECT_FLOAT_EQ(some.weight(0, 3), 0.5f);
  EXPECT_EQ(some.text(), "0,*  2,3 (*,1)");
  EXPECT_EQ(Strategies(Technique{2, 3}).text(), "2,3");
}

TEST(LectureStrategies, SayWhatIsImpossible) {
  const std::pair<const char*, const char*> cases[] = {
      {"2", "no strategy"},     {"2,", "no strategy"},         {"a,2", "no strategy"},
      {"-1,2", "no strategy"},  {"2,2,2", "no strategy"},      {"3,0", "t=0"},
      {"*,0", "t=0"},           {"0,1", "two vertices"},       {"1,1", "never used"},
      {"1e9,2", "no strategy"}, {"99999,2", "is no strategy"},
  };
  for (const auto& [text, message] : cases) {
    EXPECT_NE(complaint(text).find(message), std::string::npos)
        << text << ": \"" << complaint(text) << "\"";
  }
}

TEST(LectureStrategies, AreAveragedOverThoseThatAreMade) {
  Strategies some = Strategies::parse("1,* 2,*");
  EXPECT_FLOAT_EQ(some.weight(2, 2), 0.5f);
  some.limit(false, true, true);
  EXPECT_FLOAT_EQ(some.weight(1, 3), 0.0f);
  EXPECT_FLOAT_EQ(some.weight(2, 2), 1.0f);
  some.limit(false, false, true);
  EXPECT_FLOAT_EQ(some.weight(2, 2), 0.0f);
  EXPECT_FLOAT_EQ(some.weight(2, 1), 1.0f);
  EXPECT_TRUE(some.any());
  some.limit(false, false, false);
  EXPECT_FALSE(some.any());
  EXPECT_TRUE(Strategies::parse("9,9").any());

  const auto scene = room().light("l", point_light({0, 0, 0.5f}, 5, 0.1f)).build();
  RenderSettings settings = small_picture(IntegratorType::Bdpt, 1);
  settings.strategies = Strategies::parse("1,*");
  settings.next_event = false;
  EXPECT_THROW(RenderSession(scene, settings), SceneError);
}

// --- Options that leave the picture as it is
// ------------------------------------------------------

// A room with glass in it and a lamp that can be hit.
SceneKit glass_room() {
  return room()
      .add("glass", ball(0.3f, 12), glass(Rgb(0.95f), 1.5f), translation({0.1f, -0.5f, 0.2f}))
      .light("key", area_light({0.2f, -0.4f, 0.9f}, {0, 0, -1}, 1.0f, 20));
}

TEST(LectureClassic, IsUnbiased) {
  RenderSettings settings = small_picture(IntegratorType::Bdpt, samples(48));
  settings.connection_mode = ConnectionMode::Classic;
  for (const Heuristic heuristic : {Heuristic::Balance, Heuristic::Power}) {
    settings.heuristic = heuristic;
    expect_as_path_traced(room().light("l", point_light({0.1f, -0.5f, 0.6f}, 10)), settings, 96);
    expect_as_path_traced(glass_room(), settings, 400, 0.03);
  }
  settings.crop = FilmRect{4, 2, 12, 13};  // fewer light paths, and a picture that is not square
  RenderSettings whole = settings;
  whole.crop.reset();
  const auto scene = room().light("l", point_light({0.1f, -0.5f, 0.6f}, 10)).build();
  Mean part, all;
  for (int i = 0, count = seeds(); i < count; ++i, ++settings.seed, ++whole.seed) {
    const Image cut = render(scene, settings), full = render(scene, whole);
    double sums[2] = {};
    for (int y = 2; y < 13; ++y) {
      for (int x = 4; x < 12; ++x) {
        sums[0] += cut.pixels[4 * (static_cast<size_t>(y - 2) * 8 + (x - 4))];
        sums[1] += full.pixels[4 * (static_cast<size_t>(y) * 16 + x)];
      }
    }
    part.add(sums[0]);
    all.add(sums[1]);
  }
  EXPECT_TRUE(agree(part, all, 4.8));
}

// In its pairs, each vertex of a light path is joined once with each camera vertex.
TEST(LectureClassic, JoinsAllPairs) {
  const auto scene = open_box().light("l", point_light({0, 0, 0.2f}, 10)).build();
  RenderSettings settings = small_picture(IntegratorType::Bdpt, 8);
  settings.connection_mode = ConnectionMode::Classic;
  settings.roulette = false;
  settings.max_bounces = 2;  // up to 4 edges: pairs of 1 + 1, 1 + 2, 2 + 1
  RenderSession session(scene, settings);
  session.start();
  session.finish();
  const Counters counters = session.statistics().counters;
  EXPECT_EQ(counters.light_paths, 8u * 256);
  EXPECT_EQ(counters.camera_paths, 8u * 256);
  EXPECT_GT(counters.connections, 8u * 256);
  EXPECT_LE(counters.connections, 9u * 8 * 256);
}

TEST(LectureNextEvent, CanBeLeftOut) {
  RenderSettings settings = small_picture(IntegratorType::PathTracer, samples(200));
  settings.next_event = false;
  expect_as_path_traced(glass_room(), settings, 200, 0.04);
  settings.integrator = IntegratorType::Bdpt;
  settings.samples = samples(48);
  RenderSession session(glass_room().build(), settings);
  session.start();
  session.finish();
  EXPECT_EQ(session.statistics().counters.nee_rays, 0u);
}

// What is left without next event estimation is made of the other techniques alone.
TEST(LectureNextEvent, IsOneOfManyInBdpt) {
  RenderSettings settings = small_picture(IntegratorType::Bdpt, samples(64));
  settings.next_event = false;
  const auto scene = room().light("l", point_light({0.1f, -0.5f, 0.6f}, 10)).build();
  RenderSettings pt = small_picture(IntegratorType::PathTracer, samples(96));
  expect_agreement(quarters(scene, settings), quarters(scene, pt), 0.03);
}

// --- Light paths that hit the lens
// ----------------------------------------------------------------

SceneKit with_lens(SceneKit kit, int blades = 0, float ratio = 1.0f, float radius = 0.35f) {
  CameraDesc desc;
  desc.name = "Camera";
  desc.transform = look_at({0.1f, -3.0f, 0.2f}, {0, 0, 0});
  desc.left = -0.5f;
  desc.right = 0.4f;
  desc.bottom = -0.35f;
  desc.top = 0.45f;
  desc.clip_start = 0.5f;
  desc.aperture_radius = radius;
  desc.focus_distance = 2.4f;
  desc.aperture_blades = blades;
  desc.aperture_rotation = 0.3f;
  desc.aperture_ratio = ratio;
  kit.builder.set_camera(desc);
  return kit;
}

TEST(LectureLens, IsHitAsItSees) {
  struct Case {
    const char* name;
    SceneKit kit;
  };
  const LightDesc key = area_light({0.2f, -0.4f, 0.9f}, {0, 0, -1}, 1.0f, 20);
  LightDesc hidden = key;
  hidden.visibility = static_cast<RayMask>(kLabels);  // the camera does not see it
  const NodeGraph pane = single("BSDF_TRANSPARENT", {{"Color", vec4(0.9f, 0.7f, 0.5f, 1)}});
  const Case cases[] = {
      {"disk", with_lens(room().light("l", key))},
      {"pentagon", with_lens(room().light("l", key), 5, 2.0f)},
      {"glass", with_lens(glass_room())},
      {"rules", with_lens(room().light("l", hidden))},
      {"pane",
       with_lens(room().light("l", key).add(
           "pane", plane(3, 3), pane, translation({0, -1.5f, 0}) * rotation({1, 0, 0}, 1.5f)))},
      {"unseen", with_lens(room().light("l", key).add(
                     "ghost", plane(0.8f, 0.8f), diffuse(Rgb(0.8f)),
                     translation({0, -1.1f, 0}) * rotation({1, 0, 0}, 1.5f),
                     static_cast<RayMask>(kAllRays & ~ray_bit(RayType::Camera))))},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.name);
    const auto scene = c.kit.build();
    RenderSettings lens = small_picture(IntegratorType::LightTracer, samples(40));
    lens.next_event = false;
    lens.light_paths = 32;
    const RenderSettings pt = small_picture(IntegratorType::PathTracer, samples(150));
    expect_agreement(quarters(scene, lens), quarters(scene, pt), 0.08);
  }
}

// What goes to the eye from glass: light tracing with next event estimation is blind to it.
TEST(LectureLens, SeesTheGlassThatLightTracingDoesNot) {
  const auto scene = with_lens(glass_room()).build();
  RenderSettings settings = small_picture(IntegratorType::LightTracer, samples(60));
  settings.light_paths = 16;
  settings.expressions = {{"glass", "L.*SE"}, {"caustic", "LS+DE"}};
  const auto total = [&](const std::string& name) {
    RenderSession session(scene, settings);
    session.start();
    session.finish();
    double sum = 0.0;
    for (const float x : session.snapshot(name).pixels) {
      sum += x;
    }
    return sum;
  };
  EXPECT_EQ(total("glass"), 0.0);
  EXPECT_GT(total("caustic"), 0.0);
  settings.next_event = false;
  EXPECT_GT(total("glass"), 0.0);
}

TEST(LectureLens, IsRefusedWhereThereIsNone) {
  RenderSettings settings = small_picture(IntegratorType::LightTracer, 1);
  settings.next_event = false;
  try {
    RenderSession session(glass_room().build(), settings);
    ADD_FAILURE() << "a pinhole was hit";
  } catch (const SceneError& error) {
    EXPECT_NE(error.message.find("t=0"), std::string::npos);
    EXPECT_EQ(error.key, "Camera");
  }
}

TEST(LectureStrategies, NeedWhatCanBeHit) {
  const auto scene = room().light("Bulb", point_light({0, 0, 0.5f}, 5)).build();
  RenderSettings settings = small_picture(IntegratorType::PathTracer, 1);
  settings.next_event = false;
  EXPECT_THROW(RenderSession(scene, settings), SceneError);
  settings = small_picture(IntegratorType::Bdpt, 1);
  settings.strategies = Strategies::parse("0,*");
  EXPECT_THROW(RenderSession(scene, settings), SceneError);
  const auto both = room()
                        .light("Bulb", point_light({0, 0, 0.5f}, 5))
                        .light("Panel", area_light({0.2f, -0.4f, 0.9f}, {0, 0, -1}, 1.0f, 20))
                        .build();
  RenderSession session(both, settings);
  ASSERT_EQ(session.diagnostics().size(), 1u);
  EXPECT_EQ(session.diagnostics()[0].object, "Bulb");
}

// --- Averages instead of weights
// ------------------------------------------------------------------

SceneKit plates() {
  return SceneKit()
      .add("floor", plane(4, 4), diffuse(Rgb(0.8f, 0.7f, 0.6f)), translation({0, 0, -1}))
      .add("ceiling", plane(4, 4), diffuse(Rgb(0.6f, 0.7f, 0.8f)),
           translation({0.1f, 0, 1.2f}) * rotation({1, 0, 0}, 3.0f))
      .camera({0, -2.6f, 0.8f}, {0, 0.2f, -0.9f}, 0.7f);
}

// Of paths with two edges, the strategies are s = 0, 1, 2: if one of them cannot find the light, a
// third is missing.
TEST(LectureAverages, AreRightWhereAllStrategiesAre) {
  const auto light = [](bool hittable) {
    return plates()
        .light("l", hittable ? area_light({1.6f, 0, 0.4f}, {0, 0, -0.6f}, 1.0f, 30)
                             : point_light({1.6f, 0.2f, 0.3f}, 30))
        .build();
  };
  RenderSettings average = small_picture(IntegratorType::Bdpt, samples(200));
  average.strategies.emplace();
  average.expressions = {{"short", "L.E"}, {"long", "L..E"}};
  average.max_bounces = 1;
  RenderSettings pt = average;
  pt.integrator = IntegratorType::PathTracer;
  pt.strategies.reset();
  const auto passes = [](const std::shared_ptr<const Scene>& scene, RenderSettings settings) {
    std::map<std::string, Mean> means;
    for (int i = 0, count = seeds(); i < count; ++i, ++settings.seed) {
      RenderSession session(scene, settings);
      session.start();
      session.finish();
      for (const char* name : {"short", "long"}) {
        double sum = 0.0;
        for (const float x : session.snapshot(name).pixels) {
          sum += x;
        }
        means[name].add(sum);
      }
    }
    return means;
  };
  for (const ConnectionMode mode : {ConnectionMode::Cache, ConnectionMode::Classic}) {
    average.connection_mode = mode;
    for (const bool hittable : {true, false}) {
      SCOPED_TRACE(hittable ? "area" : "point");
      const auto scene = light(hittable);
      auto found = passes(scene, average), expected = passes(scene, pt);
      const auto ratio = [&](const char* name) {
        return found[name].mean() / expected[name].mean();
      };
      EXPECT_NEAR(ratio("short"), hittable ? 1.0 : 2.0 / 3.0, 0.03);
      EXPECT_NEAR(ratio("long"), hittable ? 1.0 : 3.0 / 4.0, 0.05);
    }
  }
}

// --- The pyramid
// ----------------------------------------------------------------------------------

class LecturePyramid : public ::testing::TestWithParam<ConnectionMode> {};

TEST_P(LecturePyramid, WeightedImagesSumToThePicture) {
  const auto scene = glass_room().build();
  RenderSettings settings = small_picture(IntegratorType::Bdpt, 16);
  settings.connection_mode = GetParam();
  settings.strategy_images = 4;
  settings.adaptive_counts = true;
  RenderSession session(scene, settings);
  session.start();
  session.finish();
  const Image picture = session.snapshot();
  std::vector<double> sum(picture.pixels.size());
  int images = 0;
  for (const std::string& name : session.passes()) {
    if (name.ends_with(" weighted")) {
      ++images;
      const Image image = session.snapshot(name);
      for (size_t i = 0; i < image.pixels.size(); ++i) {
        sum[i / 3 * 4 + i % 3] += image.pixels[i];
      }
    }
  }
  EXPECT_EQ(images, 1 + 3 + 4 + 5 + 1);
  for (size_t i = 0; i < sum.size(); ++i) {
    if (i % 4 < 3) {
      ASSERT_NEAR(sum[i], picture.pixels[i], 1e-5 * (1.0 + picture.pixels[i]));
    }
  }
}

// Without its weight, an image is what its strategy renders alone; and all that can find all light
// show the same.
TEST_P(LecturePyramid, ImagesWithoutWeightAreThoseOfTheStrategyAlone) {
  const auto scene =
      plates().light("l", area_light({1.6f, 0, 0.4f}, {0, 0, -0.6f}, 1.0f, 30)).build();
  RenderSettings pyramid = small_picture(IntegratorType::Bdpt, samples(64));
  pyramid.connection_mode = GetParam();
  pyramid.strategy_images = 3;
  pyramid.max_bounces = 1;
  const auto total = [](const Image& image) {
    double sum = 0.0;
    for (size_t i = 0; i < image.pixels.size(); ++i) {
      sum += i % image.channels < 3 ? image.pixels[i] : 0.0f;
    }
    return sum;
  };
  std::map<std::string, Mean> alone;
  for (int i = 0, count = seeds(); i < count; ++i, ++pyramid.seed) {
    RenderSession session(scene, pyramid);
    session.start();
    session.finish();
    for (const std::string& name : session.passes()) {
      alone[name].add(total(session.snapshot(name)));
    }
  }
  for (int edges = 2; edges <= 3; ++edges) {
    for (int s = 0; s <= edges; ++s) {
      const std::string name = "s" + std::to_string(s) + " t" + std::to_string(edges + 1 - s);
      SCOPED_TRACE(name);
      RenderSettings single = pyramid;
      single.strategy_images = 0;
      single.strategies = Technique{s, edges + 1 - s};
      Mean expected;
      for (int i = 0, count = seeds(); i < count; ++i, ++single.seed) {
        expected.add(total(render(scene, single)));
      }
      const Mean& found = alone.at(name + " alone");
      EXPECT_GT(expected.mean(), 0.0);
      EXPECT_TRUE(agree(found, expected, 4.8));
      EXPECT_TRUE(agree(found, alone.at("s1 t" + std::to_string(edges) + " alone"), 4.8));
      EXPECT_LT(alone.at(name + " weighted").mean(), 0.95 * found.mean());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Modes, LecturePyramid,
                         ::testing::Values(ConnectionMode::Cache, ConnectionMode::Classic),
                         [](const auto& info) {
                           return info.param == ConnectionMode::Cache ? "cache" : "classic";
                         });

// Sixty thousand pixels a side with all strategies: some terabytes.
TEST(LecturePyramids, AreRefusedWhereTheyDoNotFit) {
  RenderSettings settings = small_picture(IntegratorType::Bdpt, 1);
  settings.width = settings.height = 60000;
  settings.strategy_images = 12;
  try {
    RenderSession session(glass_room().build(), settings);
    ADD_FAILURE() << "it fits";
  } catch (const SceneError& error) {
    EXPECT_NE(error.message.find("GB"), std::string::npos) << error.message;
  }
}

TEST(LecturePyramids, AreForBdptAlone) {
  RenderSettings settings = small_picture(IntegratorType::PathTracer, 1);
  settings.strategy_images = 3;
  EXPECT_THROW(settings.validate(), SceneError);
}

}  // namespace
}  // namespace janus::test
