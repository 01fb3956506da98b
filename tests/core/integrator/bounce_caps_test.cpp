// SPDX-License-Identifier: GPL-3.0-or-later
//
// Limits of bounces by kind are rules of the whole path: every technique sums over the same paths,
// whichever end it counts from, and where lobes of two kinds reflect into one direction it splits
// the value in the same way.
#include <array>

#include "support/matrix.h"
#include "support/pictures.h"

namespace janus::test {
namespace {

struct Limits {
  int diffuse, glossy, transmission;
};
constexpr int kNone = 1024;

std::ostream& operator<<(std::ostream& out, const Limits& l) {
  return out << "diffuse " << l.diffuse << ", glossy " << l.glossy << ", transmission "
             << l.transmission;
}

RenderSettings limited(RenderSettings settings, const Limits& limits) {
  settings.max_diffuse_bounces = limits.diffuse;
  settings.max_glossy_bounces = limits.glossy;
  settings.max_transmission_bounces = limits.transmission;
  return settings;
}

// --- Known answers
// --------------------------------------------------------------------------------

// Of each word, the last letter is not counted.
TEST(BounceCaps, CountWords) {
  constexpr double kDiffuse = 0.5 * 0.8, kMirror = 0.5 * 0.9;
  const auto scene = box_of_words(kDiffuse, kMirror).build();
  const auto binomial = [](int n, int k) {
    double product = 1.0;
    for (int i = 0; i < k; ++i) {
      product = product * (n - i) / (i + 1);
    }
    return product;
  };
  constexpr int kMax = 5;
  for (const Limits& limits : {Limits{0, 0, 0},
                               {0, 2, 0},
                               {2, 0, 0},
                               {1, 1, 0},
                               {1, 3, 0},
                               {kNone, 1, 0},
                               {2, kNone, 0},
                               {kNone, kNone, 0}}) {
    double expected = 1.0;
    for (int i = 0; i <= std::min(limits.diffuse, kMax); ++i) {
      for (int j = 0; j <= std::min(limits.glossy, kMax) && i + j <= kMax; ++j) {
        expected += binomial(i + j, i) * std::pow(kDiffuse, i) * std::pow(kMirror, j) *
                    (kDiffuse + kMirror);
      }
    }
    for (const IntegratorType integrator : {IntegratorType::PathTracer, IntegratorType::Bdpt}) {
      RenderSettings settings = limited(small_picture(integrator, samples(16)), limits);
      settings.max_bounces = kMax;
      const Mean found = quarters(scene, settings)[0];
      SCOPED_TRACE(::testing::Message()
                   << limits << ", integrator " << static_cast<int>(integrator));
      EXPECT_LT(std::abs(z_score(found, expected)), 4.5) << found.mean() << " for " << expected;
      EXPECT_LT(found.error(), 0.006 * expected);
    }
  }
}

// Light through n panes of clear glass, single sheets: n transmissions and a last bounce.
TEST(BounceCaps, PanesOfGlass) {
  for (const int panes : {1, 3}) {
    SceneKit kit;
    kit.add("wall", plane(9, 9), emission(Rgb(1), 1)).camera({0, 0, 3}, {0, 0, 0}, 0.1f);
    for (int i = 0; i < panes; ++i) {  // an index of 1: nothing is reflected
      kit.add("pane" + std::to_string(i), plane(9, 9),
              single("BSDF_REFRACTION", {{"Roughness", 0.0f}, {"IOR", 1.0f}}),
              translation({0, 0, 0.5f + 0.3f * i}));
    }
    const auto scene = kit.build();
    for (const IntegratorType integrator : {IntegratorType::PathTracer, IntegratorType::Bdpt}) {
      for (int limit = 0; limit <= panes; ++limit) {
        const RenderSettings settings =
            limited(small_picture(integrator, samples(2)), {0, 0, limit});
        EXPECT_NEAR(quarters(scene, settings, 2)[0].mean(), limit + 1 >= panes ? 1.0 : 0.0, 1e-4)
            << panes << " panes, limit " << limit;
      }
    }
  }
}

// --- Every technique
// ------------------------------------------------------------------------------

// Lobes of both kinds, and of the third, at most vertices; nothing smooth, so that every technique
// can make every path.
NodeGraph plastic(Rgb color, float roughness) {
  return combine(
      "ADD_SHADER", diffuse(color),
      single("BSDF_GLOSSY", {{"Color", vec4(0.4f, 0.3f, 0.2f, 1)}, {"Roughness", roughness}}));
}

SceneKit mixed_plates() {
  return SceneKit()
      .add("floor", plane(4, 4), plastic(Rgb(0.5f, 0.4f, 0.3f), 0.6f), translation({0, 0, -1}))
      .add("ceiling", plane(4, 4), plastic(Rgb(0.3f, 0.4f, 0.5f), 0.7f),
           translation({0.1f, 0, 1.2f}) * rotation({1, 0, 0}, 3.0f))
      .add("leaf", plane(1.6f, 1.6f),
           combine("MIX_SHADER", plastic(Rgb(0.7f), 0.6f),
                   single("BSDF_GLASS", {{"Roughness", 0.6f}, {"IOR", 1.4f}})),
           translation({-0.3f, 0.3f, 0}) * rotation({0, 1, 0}, 1.3f))
      .light("l", area_light({1.6f, 0, 0.4f}, {0, 0, -0.6f}, 1.0f, 30))
      .camera({0, -2.6f, 0.8f}, {0, 0.2f, -0.9f}, 0.7f);
}

TEST(BounceCaps, EveryTechnique) {
  const auto scene = mixed_plates().build();
  EXPECT_TRUE(scene->diagnostics.empty());
  for (const auto& [edges, limits] : {std::pair(3, Limits{0, kNone, kNone}),
                                      {3, Limits{1, 0, 0}},
                                      {3, Limits{0, 0, 1}},
                                      {4, Limits{1, 1, 0}}}) {
    const auto technique = [&, edges = edges](int s, int count) {
      RenderSettings settings = small_picture(IntegratorType::Bdpt, samples(count));
      settings.strategies = Technique{s, edges + 1 - s};
      settings.seed = 100 * s;
      if (s == 0) {
        settings.light_paths = 0.0f;
      }
      return settings;
    };
    const auto all = quarters(scene, technique(1, 64))[0];
    const auto reference = quarters(scene, limited(technique(1, 65), limits));
    EXPECT_LT(z_score(reference[0], all), -6.0);  // it cuts
    for (int s = 0; s <= edges; ++s) {
      if (s != 1) {
        SCOPED_TRACE(::testing::Message() << limits << ", s = " << s << ", t = " << edges + 1 - s);
        const auto found = quarters(scene, limited(technique(s, s == 0 ? 240 : 48), limits));
        for (size_t k = 0; k < found.size(); ++k) {
          EXPECT_TRUE(agree(found[k], reference[k], 4.8)) << "part " << k;
        }
        // What a limit leaves may be little and noisy: its error counts beside the whole picture.
        EXPECT_LT(std::hypot(found[0].error(), reference[0].error()), 0.04 * all.mean());
      }
    }
  }
}

// --- All together
// ---------------------------------------------------------------------------------

TEST(BounceCaps, IntegratorsAgree) {
  const auto scene =
      room()
          .add("ball", ball(0.35f, 12, true),
               single("BSDF_PRINCIPLED", {{"Base Color", vec4(0.8f, 0.3f, 0.2f, 1)},
                                          {"Roughness", 0.5f},
                                          {"Transmission Weight", 0.5f}}),
               translation({0.35f, 0.3f, 0.1f}))
          .add("metal", plane(1.2f, 1.2f), single("BSDF_GLOSSY", {{"Roughness", 0.5f}}),
               translation({-0.95f, 0, 0.2f}) * rotation({0, 1, 0}, 0.5f * kPi))
          .add("shelf", plane(0.8f, 0.8f), plastic(Rgb(0.4f, 0.5f, 0.3f), 0.4f),
               translation({0.3f, 0.5f, -0.4f}))
          .light("l", area_light({0, 0, 0.95f}, {0, 0, 0}, 0.9f, 20))
          .build();
  for (const Limits& limits : {Limits{0, 0, 0},
                               {0, kNone, kNone},
                               {1, kNone, 1},
                               {kNone, 0, 2},
                               {2, 1, 0},
                               {kNone, 1, 1}}) {
    SCOPED_TRACE(::testing::Message() << limits);
    const auto picture = [&](IntegratorType integrator, int count) {
      RenderSettings settings = limited(small_picture(integrator, samples(count)), limits);
      settings.seed = 10 * limits.diffuse + limits.glossy;
      return quarters(scene, settings);
    };
    const auto bdpt = picture(IntegratorType::Bdpt, 16);
    expect_agreement(bdpt, picture(IntegratorType::PathTracer, 48));
    expect_agreement(bdpt, picture(IntegratorType::LightTracer, 40), 0.03);
  }
}

// The weights know nothing of labels: with limits they are what they were.
TEST(BounceCaps, LimitsThatNeverBindChangeNothing) {
  const auto scene = mixed_plates().build();
  for (const IntegratorType integrator :
       {IntegratorType::Bdpt, IntegratorType::PathTracer, IntegratorType::LightTracer}) {
    const RenderSettings settings = small_picture(integrator, 2);
    const int bounces = settings.max_bounces;
    EXPECT_EQ(render(scene, settings).pixels,
              render(scene, limited(settings, {bounces, bounces, bounces})).pixels);
  }
}

}  // namespace
}  // namespace janus::test
