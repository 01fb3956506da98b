// SPDX-License-Identifier: GPL-3.0-or-later
//
// Passes of light path expressions: every integrator and every technique sorts a path in the same
// way, and what belongs together adds up.
#include "support/pictures.h"
#include "support/scene_kit.h"

namespace janus::test {
namespace {

using Pictures = std::map<std::string, Image>;

Pictures render_all(const std::shared_ptr<const Scene>& scene, const RenderSettings& settings) {
  RenderSession session(scene, settings);
  session.start();
  session.finish();
  Pictures pictures;
  for (const std::string& name : session.passes()) {
    pictures[name] = session.snapshot(name);
  }
  return pictures;
}

RenderSettings with_expressions(RenderSettings settings, const std::vector<std::string>& texts) {
  for (const std::string& text : texts) {
    settings.expressions.push_back({text, text});
  }
  return settings;
}

// The means of a pass of every seed, by name.
std::map<std::string, Mean> means(const std::shared_ptr<const Scene>& scene,
                                  RenderSettings settings, int count = seeds()) {
  std::map<std::string, Mean> sums;
  settings.seed += 1000 * (static_cast<uint32_t>(settings.integrator) + 1) +
                   10000 * static_cast<uint32_t>(settings.connection_mode);
  for (int i = 0; i < count; ++i, ++settings.seed) {
    for (const auto& [name, image] : render_all(scene, settings)) {
      double sum = 0.0;
      for (size_t p = 0; p < image.pixels.size(); p += image.channels) {
        sum += luminance(Rgb(image.pixels[p], image.pixels[p + 1], image.pixels[p + 2]));
      }
      sums[name].add(sum / (image.width * image.height));
    }
  }
  return sums;
}

// All kinds of events, in vertices of one kind and of two, seen and lit from everywhere.
SceneKit all_kinds() {
  NodeGraph paper = combine("MIX_SHADER", single("BSDF_TRANSLUCENT", {{"Color", vec4(0.9f)}}),
                            single("BSDF_GLASS", {{"Roughness", 0.5f}, {"IOR", 1.3f}}));
  return open_box(Rgb(0.7f, 0.6f, 0.5f))
      .add("plastic", cuboid({-0.9f, 0.1f, -1}, {-0.4f, 0.6f, -0.2f}),
           plastic(Rgb(0.3f, 0.4f, 0.5f), 0.4f))
      .add("paper", plane(0.9f, 0.9f), paper,
           translation({0.3f, 0.2f, 0.1f}) * rotation({0, 1, 0}, 0.8f))
      .add("mirror", plane(0.8f, 0.8f), mirror(Rgb(0.9f)),
           translation({0.9f, 0.3f, -0.3f}) * rotation({0, 1, 0}, -1.4f))
      .add("glass", ball(0.3f, 12), glass(Rgb(0.95f), 1.5f), translation({0, -0.3f, -0.6f}))
      .light("key", area_light({0.2f, -0.4f, 0.9f}, {0, 0, -1}, 0.7f, 20));
}

struct Way {
  std::string name;
  RenderSettings settings;
};
std::ostream& operator<<(std::ostream& out, const Way& way) { return out << way.name; }

Way way(const std::string& name, IntegratorType integrator, int count,
        ConnectionMode mode = ConnectionMode::Cache) {
  RenderSettings settings = small_picture(integrator, count);
  settings.connection_mode = mode;
  return {name, settings};
}

const Way kWays[] = {way("pt", IntegratorType::PathTracer, samples(96)),
                     way("lt", IntegratorType::LightTracer, samples(48)),
                     way("bdpt", IntegratorType::Bdpt, samples(48)),
                     way("classic", IntegratorType::Bdpt, samples(32), ConnectionMode::Classic)};

class LecturePasses : public ::testing::TestWithParam<Way> {};

// In one render, to the last digits: no join is sorted differently from its value.
TEST_P(LecturePasses, OfAllPathsSumToThePicture) {
  const std::vector<std::vector<std::string>> partitions = {
      {"LE", "L.E", "L..+E"},
      {"LE", "LD.*E", "LG.*E", "LS.*E"},
      {"LE", "L.*RE", "L.*TE"},
      {"L.*E"},
      {"LE", "L(.*'box')E", "L.*<.'plastic'>E", "L(.*'paper'|.*'mirror'|.*'glass')E"},
      {"L'key'.*E"},
      {"LR*E", "L.*TR*E"},
  };
  const auto scene = all_kinds().build();
  for (const auto& partition : partitions) {
    SCOPED_TRACE(partition.back());
    RenderSettings settings = with_expressions(GetParam().settings, partition);
    settings.samples = 8;
    const Pictures found = render_all(scene, settings);
    const Image& picture = found.at("Combined");
    std::vector<double> sum(static_cast<size_t>(picture.width) * picture.height * 3);
    double total = 0.0;
    for (const std::string& name : partition) {
      const Image& part = found.at(name);
      ASSERT_EQ(part.channels, 3);
      double share = 0.0;
      for (size_t i = 0; i < sum.size(); ++i) {
        sum[i] += part.pixels[i];
        share += part.pixels[i];
      }
      // Light tracing knows no specular event before the eye, and the eye sees no lamp here.
      EXPECT_TRUE(share > 0.0 || name == "LE") << name;
      total += share;
    }
    ASSERT_GT(total, 0.0);
    for (size_t i = 0; i < sum.size(); ++i) {
      const double expected = picture.pixels[i / 3 * 4 + i % 3];
      ASSERT_NEAR(sum[i], expected, 1e-5 * (1.0 + expected)) << "value " << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Ways, LecturePasses, ::testing::ValuesIn(kWays),
                         [](const auto& info) { return info.param.name; });
INSTANTIATE_TEST_SUITE_P(Merging, LecturePasses, ::testing::Values([] {
                           Way merging = way("merging", IntegratorType::Bdpt, 8);
                           merging.settings.merge_radius = 0.2f;
                           return merging;
                         }()),
                         [](const auto& info) { return info.param.name; });

const std::vector<std::string> kSorted = {
    "LDE",   "LGE",         "LDDE",     "LGDE",        "LDGE",
    "LGGE",  "LDDD+E",      "LD<DT>E",  "L<GT>DE",     "L<DT>.E",
    "LS+DE", "L.*G.*<DR>E", "L<GR>.*E", "L.'paper'DE", "LD.*D'plastic'E"};

void expect_same_passes(const std::map<std::string, Mean>& a, const std::map<std::string, Mean>& b,
                        double least_error) {
  for (const auto& [name, mean] : a) {
    SCOPED_TRACE(name);
    EXPECT_GT(mean.mean(), 0.0);
    EXPECT_TRUE(agree(mean, b.at(name), 4.8));
    EXPECT_LT(mean.error(), least_error * mean.mean()) << "this proves nothing";
  }
}

// Camera walks alone, light walks alone, and both sort the same paths into the same passes.
TEST(LecturePassesOfAllIntegrators, Agree) {
  const auto scene = all_kinds().build();
  const auto reference = means(scene, with_expressions(kWays[0].settings, kSorted));
  for (const Way& way : {kWays[1], kWays[2], kWays[3]}) {
    SCOPED_TRACE(way.name);
    const bool light = way.name == "lt";  // which cannot make all of Combined here
    auto found = means(scene, with_expressions(way.settings, kSorted));
    if (light) {
      found.erase("Combined");
    }
    expect_same_passes(found, reference, 0.2);
  }
}

// Where bounce caps forbid one kind of a vertex and allow the other.
TEST(LecturePassesOfAllIntegrators, AgreeUnderBounceCaps) {
  const auto scene = all_kinds().build();
  const std::vector<std::string> texts = {"LDDE",  "LGDE",  "LDGE", "LGGE",
                                          "LD.DE", "LG.GE", "L...E"};
  std::map<std::string, Mean> reference;
  for (const Way& way : {kWays[0], kWays[2], kWays[3]}) {
    SCOPED_TRACE(way.name);
    RenderSettings settings = with_expressions(way.settings, texts);
    settings.max_diffuse_bounces = 1;
    settings.max_glossy_bounces = 1;
    const auto found = means(scene, settings);
    if (reference.empty()) {
      reference = found;
    } else {
      expect_same_passes(found, reference, 0.2);
    }
  }
}

// A lamp that glossy events do not see, behind a screen that diffuse ones do not.
TEST(LecturePassesOfAllIntegrators, AgreeUnderRayVisibility) {
  LightDesc key = area_light({1.2f, -0.3f, 1.0f}, {0, 0, -0.9f}, 0.9f, 30);
  key.visibility = static_cast<RayMask>(kAllRays & ~ray_bit(RayType::Glossy));
  const auto scene =
      SceneKit()
          .add("floor", plane(4, 4), plastic(Rgb(0.5f, 0.4f, 0.3f), 0.6f), translation({0, 0, -1}))
          .add("ceiling", plane(4, 4), plastic(Rgb(0.3f, 0.4f, 0.5f), 0.7f),
               translation({0.1f, 0, 1.2f}) * rotation({1, 0, 0}, 3.0f))
          .add("screen", plane(1.1f, 1.3f), plastic(Rgb(0.7f), 0.6f),
               translation({0.4f, -0.1f, -0.1f}) * rotation({0, 1, 0}, 0.4f),
               static_cast<RayMask>(kAllRays & ~ray_bit(RayType::Diffuse)))
          .light("key", key)
          .camera({0, -2.6f, 0.8f}, {0, 0.2f, -0.9f}, 0.7f)
          .build();
  const std::vector<std::string> texts = {"LDE", "LDDE", "LDGE", "L.DE", "LD..E"};
  std::map<std::string, Mean> reference;
  for (const Way& way : kWays) {
    SCOPED_TRACE(way.name);
    auto all = texts;
    all.push_back("LG.*E");
    auto found = means(scene, with_expressions(way.settings, all));
    EXPECT_EQ(found.at("LG.*E").mean(), 0.0);  // not lit
    found.erase("LG.*E");
    if (reference.empty()) {
      reference = found;
    } else {
      expect_same_passes(found, reference, 0.2);
    }
  }
}

// --- Known answers
// --------------------------------------------------------------------------------

// Each word of the two letters is a product of two numbers.
TEST(LecturePassesOfWords, AreKnown) {
  constexpr double kDiffuse = 0.5 * 0.8, kMirror = 0.5 * 0.9;
  const auto scene = box_of_words(kDiffuse, kMirror).build();
  const double d = kDiffuse, s = kMirror, all = d + s;
  const std::map<std::string, double> expected = {
      {"LE", 1.0},
      {"LDE", d},
      {"LSE", s},
      {"LDSE", d * s},
      {"LSDE", s * d},
      {"LS?D+E", d + d * d + d * d * d + s * d * (1 + d)},
      {"L(D|S)(D|S)E", all * all},
      {"L'box'E", 1.0},
      {"LD.SE", d * all * s}};
  std::vector<std::string> texts;
  for (const auto& [text, value] : expected) {
    texts.push_back(text);
  }
  for (const Way& way : {kWays[0], kWays[2], kWays[3]}) {
    RenderSettings settings = with_expressions(way.settings, texts);
    settings.max_bounces = 2;
    settings.samples = samples(24);
    const auto found = means(scene, settings);
    for (const auto& [text, value] : expected) {
      const Mean& mean = found.at(text);
      EXPECT_LT(std::abs(z_score(mean, value)), 4.8) << way << " " << text << ": " << mean.mean()
                                                     << " +- " << mean.error() << " for " << value;
      EXPECT_LT(mean.error(), 0.02 * value) << way << " " << text;
    }
  }
}

// What belongs to a lamp is what is left without the other one.
TEST(LecturePassesOfLights, AreThoseOfTheLightsAlone) {
  const auto with = [](bool key, bool fill, bool sky) {
    SceneKit kit = room();
    if (key) {
      LightDesc desc = area_light({0.2f, -0.4f, 0.9f}, {0, 0, -1}, 0.7f, 20);
      desc.light_group = "Studio";
      kit.light("key", desc);
    }
    if (fill) {
      kit.light("fill", point_light({-0.5f, -0.7f, 0.2f}, 5, 0.1f));
    }
    if (sky) {
      kit.world(Rgb(0.2f, 0.3f, 0.4f));
    }
    return kit.build();
  };
  const RenderSettings settings = kWays[2].settings;
  const auto together = means(with(true, true, true),
                              with_expressions(settings, {"L{Studio}.*E", "L'fill'.*E", "B.*E"}));
  EXPECT_TRUE(agree(together.at("L{Studio}.*E"),
                    means(with(true, false, false), settings).at("Combined"), 4.8));
  EXPECT_TRUE(
      agree(together.at("L'fill'.*E"), means(with(false, true, false), settings).at("Combined")));
  EXPECT_TRUE(agree(together.at("B.*E"), means(with(false, false, true), settings).at("Combined")));
}

// Whoever looks at a render does not change it.
TEST_P(LecturePasses, LeaveThePictureAlone) {
  const auto scene = all_kinds().build();
  RenderSettings settings = GetParam().settings;
  settings.samples = 4;
  const Image plain = render(scene, settings);
  const Pictures found = render_all(scene, with_expressions(settings, kSorted));
  EXPECT_EQ(found.at("Combined").pixels, plain.pixels);
}

TEST(LecturePassesOfThreads, AreTheSameWithAnyNumber) {
  const auto scene = all_kinds().build();
  for (const Way& way : kWays) {
    RenderSettings settings = with_expressions(way.settings, kSorted);
    settings.samples = 3;
    settings.threads = 1;
    const Pictures one = render_all(scene, settings);
    settings.threads = 3;
    for (const auto& [name, image] : render_all(scene, settings)) {
      EXPECT_EQ(image.pixels, one.at(name).pixels) << way << " " << name;
    }
  }
}

TEST(LecturePassesRefuse, WhatCannotBe) {
  const auto scene = all_kinds().build();
  const auto message = [&](RenderSettings settings) -> std::string {
    try {
      RenderSession session(scene, settings);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  RenderSettings settings = small_picture(IntegratorType::Bdpt, 1);
  settings.expressions = {{"Caustics", "LS+D"}};
  EXPECT_NE(message(settings).find("pass 'Caustics' (LS+D): an expression ends with E"),
            std::string::npos);
  settings.expressions = {{"A", "LE"}, {"A", "LDE"}};
  EXPECT_NE(message(settings).find("two passes are called 'A'"), std::string::npos);
  settings.expressions = {{"Combined", "LE"}};
  EXPECT_NE(message(settings).find("two passes"), std::string::npos);
  settings.expressions = {{"A", "L'Nobody'E"}};
  RenderSession session(scene, settings);
  ASSERT_EQ(session.diagnostics().size(), 1u);
  EXPECT_NE(session.diagnostics()[0].message.find("'Nobody'"), std::string::npos);
  EXPECT_EQ(session.diagnostics()[0].severity, Severity::Warning);
  settings.expressions = {{"A", "L{Nobody}E"}};
  EXPECT_EQ(RenderSession(scene, settings).diagnostics().at(0).severity, Severity::Info);
  EXPECT_THROW(session.snapshot("B"), Error);
}

}  // namespace
}  // namespace janus::test
