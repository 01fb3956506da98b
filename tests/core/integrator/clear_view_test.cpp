// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the camera sees clearly: holdouts, and the glass of a transparent film.
#include <gtest/gtest.h>

#include "support/pictures.h"
#include "support/scene_kit.h"

namespace janus::test {
namespace {

constexpr IntegratorType kIntegrators[] = {IntegratorType::Bdpt, IntegratorType::PathTracer,
                                           IntegratorType::LightTracer};

NodeGraph holdout() {
  NodeGraph graph = single("HOLDOUT", {});
  graph.surface = NodeLink{"Shader", "Holdout"};
  return graph;
}
NodeGraph transparent(Rgb color) { return single("BSDF_TRANSPARENT", {{"Color", vec4(color, 1)}}); }
NodeGraph refraction(float roughness, float ior = 1.7f) {
  return single("BSDF_REFRACTION",
                {{"Color", vec4(0.9f, 0.95f, 1, 1)}, {"Roughness", roughness}, {"IOR", ior}});
}
NodeGraph mixed(const NodeGraph& a, const NodeGraph& b, float factor = 0.5f) {
  return combine("MIX_SHADER", a, b, factor);
}

// Across the view, at a distance behind the origin.
mat4 upright(float y, vec3 at = vec3(0.0f)) {
  return translation(at + vec3(0, y, 0)) * rotation({1, 0, 0}, 0.5f * kPi);
}

struct Film {
  bool transparent = false, glass = false;
  float roughness = 0.1f;
};

RenderSettings picture(IntegratorType integrator, int samples, const Film& film) {
  RenderSettings settings = small_picture(integrator, samples);
  settings.film_transparent = film.transparent;
  settings.film_transparent_glass = film.glass;
  settings.film_transparent_roughness = film.roughness;
  return settings;
}

// Of the whole picture: luminance and alpha.
struct Seen {
  Mean light, alpha;
};
Seen seen(const std::shared_ptr<const Scene>& scene, RenderSettings settings,
          int count = seeds(6)) {
  Seen means;
  settings.seed += 1000 * (static_cast<uint32_t>(settings.integrator) + 1);
  for (int i = 0; i < count; ++i, ++settings.seed) {
    const Image image = render(scene, settings);
    double light = 0.0, alpha = 0.0;
    for (size_t p = 0; p < image.pixels.size(); p += 4) {
      light += luminance(Rgb(image.pixels[p], image.pixels[p + 1], image.pixels[p + 2]));
      alpha += image.pixels[p + 3];
    }
    means.light.add(4 * light / image.pixels.size());
    means.alpha.add(4 * alpha / image.pixels.size());
  }
  return means;
}

// --- The integrators -----------------------------------------------------------------------------

struct ViewCase {
  const char* name;
  Film film;
  bool light_tracing;
  SceneKit (*make)();
};

std::ostream& operator<<(std::ostream& out, const ViewCase& c) { return out << c.name; }

// Of everything that may hold out, before and behind the rest of a room.
SceneKit holes() {
  return room()
      .add("held", ball(0.3f, 12, true), diffuse(Rgb(0.8f, 0.3f, 0.2f)),
           translation({0.5f, -0.1f, 0.4f}), kAllRays, true)
      .add("held pane", plane(0.7f, 0.7f),
           mixed(diffuse(Rgb(0.8f)), transparent(Rgb(0.9f, 0.8f, 0.6f)), 0.6f),
           upright(-0.7f, {-0.5f, 0, 0.5f}), kAllRays, true)
      .add("held lamp", plane(0.5f, 0.5f), emission(Rgb(1, 0.8f, 0.6f), 3),
           upright(0.7f, {-0.4f, 0, 0.6f}), kAllRays, true)
      .add("half", plane(0.5f, 0.5f), mixed(diffuse(Rgb(0.3f, 0.8f, 0.4f)), holdout(), 0.6f),
           upright(-0.8f, {0.5f, 0, -0.6f}))
      .add("full", plane(0.4f, 0.4f),
           combine("ADD_SHADER", diffuse(Rgb(0.7f, 0.7f, 0.2f)), holdout()),
           upright(0.5f, {0.0f, 0, 0.1f}))
      .light("l", area_light({0.2f, -0.4f, 0.9f}, {0, 0, -0.5f}, 0.5f, 20));
}

// A picture, so that next event estimation looks for it.
Image sky() {
  Image image(8, 4, 3);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 8; ++x) {
      for (int c = 0; c < 3; ++c) {
        image.pixels[3 * (8 * y + x) + c] = 0.2f + 0.15f * y + 0.1f * c + (x % 3 ? 0.0f : 0.6f);
      }
    }
  }
  return image;
}

// Rough panes that are clear, that are not, and both, before what holds out and the sky.
SceneKit panes() {
  return SceneKit()
      .add("clear", plane(0.9f, 1.8f), refraction(0.65f), upright(0, {-0.6f, 0, 0}))
      .add("both", plane(0.9f, 0.9f), mixed(refraction(0.65f), refraction(0.9f)),
           upright(0, {0.5f, 0, 0.5f}))
      .add("more", plane(0.9f, 0.9f), mixed(refraction(0.6f), diffuse(Rgb(0.5f, 0.3f, 0.7f))),
           upright(0, {0.5f, 0, -0.5f}))
      .add("second", plane(2.6f, 0.8f), mixed(refraction(0.7f), refraction(0.9f)), upright(0.9f))
      .add("held", ball(0.4f, 12, true), diffuse(Rgb(0.9f, 0.4f, 0.3f)),
           translation({-0.3f, 1.6f, 0.5f}), kAllRays, true)
      .add("held lamp", plane(0.6f, 0.6f), emission(Rgb(1, 0.8f, 0.6f), 2),
           upright(1.5f, {0.4f, 0, -0.4f}), kAllRays, true)
      .add("floor", plane(3, 3), diffuse(Rgb(0.6f)), translation({0, 0.4f, -1.4f}))
      .world(sky())
      .light("sun", sun_light({0.3f, -1, 0.5f}, 2.0f, 1.5f));
}

// Smooth glass, too: a lens before a wall that is lit, and the sky.
SceneKit lens() {
  return panes()
      .add("lens", ball(0.5f, 24, true),
           single("BSDF_PRINCIPLED", {{"Base Color", vec4(0.9f, 0.95f, 1, 1)},
                                      {"Roughness", 0.0f},
                                      {"Transmission Weight", 0.8f},
                                      {"IOR", 1.3f}}),
           translation({0.1f, -0.8f, 0.1f}))
      .add("wall", plane(1.2f, 0.8f), mixed(diffuse(Rgb(0.7f)), holdout(), 0.3f),
           upright(2.0f, {0.6f, 0, 0.6f}));
}

const ViewCase kViews[] = {
    {"Holes", {}, true, holes},
    {"HolesInATransparentFilm", {true}, true, [] { return holes().world(Rgb(0.4f, 0.3f, 0.5f)); }},
    {"PanesOnAnOpaqueFilm", {}, true, panes},
    {"PanesThatAreNotClear", {true, true, 0.0f}, true, panes},
    {"Panes", {true, true, 0.8f}, true, panes},
    {"Lens", {true, true, 0.8f}, false, lens},
};

class ClearView : public ::testing::TestWithParam<ViewCase> {};

TEST_P(ClearView, IntegratorsAgree) {
  const ViewCase& view = GetParam();
  const auto scene = view.make().build();
  const auto bdpt = picture(IntegratorType::Bdpt, samples(48), view.film);
  const auto pt = picture(IntegratorType::PathTracer, samples(144), view.film);
  const auto lt = picture(IntegratorType::LightTracer, samples(192), view.film);
  const auto expected = quarters(scene, bdpt);
  expect_agreement(expected, quarters(scene, pt));
  const Mean alpha = seen(scene, bdpt).alpha;
  EXPECT_TRUE(close(alpha, seen(scene, pt).alpha, 0.01));
  EXPECT_GT(1.0 - alpha.mean(), 0.005);
  if (view.light_tracing) {
    expect_agreement(expected, quarters(scene, lt), 0.08);  // the sky is wide, and its paths few
    EXPECT_TRUE(close(alpha, seen(scene, lt).alpha, 0.01));
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, ClearView, ::testing::ValuesIn(kViews),
                         [](const auto& info) { return std::string(info.param.name); });

// --- Each technique alone ------------------------------------------------------------------------

// All (s,t) but the first for paths of so many edges against that.
void expect_techniques_agree(const SceneKit& kit, int edges, double tolerance) {
  const auto scene = kit.build();
  const auto of = [&](int s) {
    RenderSettings settings = picture(IntegratorType::Bdpt, samples(384), {true, true, 0.8f});
    settings.strategies = Technique{s, edges + 1 - s};
    settings.light_paths = s == 0 ? 0.0f : 1.0f;
    return quarters(scene, settings);
  };
  const auto reference = of(1);
  for (const int s : {0, 2, 3}) {
    if (s <= edges) {
      SCOPED_TRACE(::testing::Message() << "s = " << s << ", t = " << edges + 1 - s);
      expect_agreement(of(s), reference, tolerance);
    }
  }
}

TEST(ClearViewTechniques, AgreeForEachPathLength) {
  expect_techniques_agree(panes(), 2, 0.15);
  expect_techniques_agree(panes(), 3, 0.15);
}

// A wall behind clear glass, half of which holds out.
TEST(ClearViewTechniques, AgreeBehindClearGlass) {
  const mat4 left = upright(1.2f, {-1, 0, 0}), right = upright(1.2f, {1, 0, 0});
  expect_techniques_agree(SceneKit()
                              .add("pane", plane(2.6f, 2.6f), refraction(0.7f), upright(0))
                              .add("held", plane(2, 3), diffuse(Rgb(0.9f)), left, kAllRays, true)
                              .add("wall", plane(2, 3), diffuse(Rgb(0.5f, 0.7f, 0.3f)), right)
                              .light("l", area_light({0, -0.3f, 2.5f}, {0, 1.2f, 0}, 1, 60)),
                          3, 0.1);
}

// --- Known answers, Cycles' among them -----------------------------------------------------------

struct Expected {
  const char* what;
  double light, alpha;
};

class KnownAnswerOfClearViews : public ::testing::TestWithParam<IntegratorType> {
 protected:
  void expect(const Expected& expected, const Film& film, const SceneKit& kit) {
    SCOPED_TRACE(expected.what);
    const Seen found = seen(kit.build(), picture(GetParam(), samples(64), film), 4);
    EXPECT_NEAR(found.light.mean(), expected.light, 0.004);
    EXPECT_NEAR(found.alpha.mean(), expected.alpha, 0.004);
  }

  // A wall before a grey world.
  static SceneKit wall(const NodeGraph& surface, bool held = false) {
    return SceneKit()
        .add("wall", plane(9, 9), surface, upright(1), kAllRays, held)
        .world(Rgb(0.5f));
  }
};

TEST_P(KnownAnswerOfClearViews, HoldoutsLeaveHoles) {
  const NodeGraph white = diffuse(Rgb(1)), glow = emission(Rgb(1), 1);
  const NodeGraph pane = mixed(glow, transparent(Rgb(1)), 0.3f);
  for (const bool film : {false, true}) {
    const Film f{film};
    expect({"wall", 0.5, 1}, f, wall(white));
    expect({"held wall", 0, 0}, f, wall(white, true));
    expect({"held light", 0, 0}, f, wall(glow, true));
    expect({"half a hole", 0.25, 0.5}, f, wall(mixed(white, holdout())));
    expect({"half a hole that glows", 0.5, 0.5}, f, wall(mixed(glow, holdout())));
    expect({"a hole and more", 0, 0}, f, wall(combine("ADD_SHADER", glow, holdout())));
    expect({"held pane", film ? 0 : 0.15, film ? 0 : 0.3}, f, wall(pane, true));
    expect({"transparent hole", film ? 0 : 0.25, film ? 0 : 0.5}, f,
           wall(mixed(transparent(Rgb(1)), holdout())));
    expect({"behind a pane", 0, 0}, f,
           wall(glow, true).add("pane", plane(9, 9), transparent(Rgb(1)), upright(0)));
  }
}

TEST_P(KnownAnswerOfClearViews, OthersSeeHoldoutsAsTheyAre) {
  // A floor that nothing but a held wall shines on.
  const auto floor = [](bool held) {
    const auto kit =
        SceneKit()
            .add("wall", plane(3, 3), emission(Rgb(1), 1), upright(1.5f), kAllRays, held)
            .add("floor", plane(2, 2), diffuse(Rgb(0.8f)), translation({0, 0, -0.5f}))
            .camera({0, 0, 3}, {0, 0, -0.5f}, 0.2f)
            .build();
    return quarters(kit, small_picture(GetParam(), samples(64)), 4)[0].mean();
  };
  EXPECT_NEAR(floor(true), floor(false), 0.01 * floor(false));
  EXPECT_GT(floor(true), 0.05);
}

TEST_P(KnownAnswerOfClearViews, WhatAClearViewLeavesOut) {
  if (GetParam() == IntegratorType::LightTracer) {
    GTEST_SKIP() << "hardly any light path leaves so narrow a lobe towards the camera";
  }
  const Film film{true, true, 0.3f};
  const NodeGraph clear = refraction(0.3f, 1.1f), blurred = refraction(0.31f, 1.1f);
  const double light = 0.5 * luminance(Rgb(0.9f, 0.95f, 1));
  const double tint = (0.9 + 0.95 + 1) / 3;
  expect({"clear", 0, 1 - tint}, film, wall(clear));
  expect({"blurred", light, 1}, film, wall(blurred));
  expect({"both", 0.5 * light, 1 - 0.5 * tint}, film, wall(mixed(clear, blurred)));
  expect({"glass is glass", light, 1}, {true, false, 1.0f}, wall(clear));
  expect({"opaque film", light, 1}, {false, true, 1.0f}, wall(clear));
}

INSTANTIATE_TEST_SUITE_P(Integrators, KnownAnswerOfClearViews, ::testing::ValuesIn(kIntegrators),
                         [](const auto& info) {
                           return std::string(info.param == IntegratorType::Bdpt         ? "bdpt"
                                              : info.param == IntegratorType::PathTracer ? "pt"
                                                                                         : "lt");
                         });

// A sun is a lamp, not the background.
TEST(KnownAnswer, ATransparentFilmShowsTheSun) {
  const auto scene = SceneKit().world(Rgb(0.5f)).light("sun", sun_light({0, 1, 0}, 1, 3)).build();
  for (const IntegratorType integrator : kIntegrators) {
    const Seen opaque = seen(scene, picture(integrator, 8, {}), 2);
    const Seen transparent = seen(scene, picture(integrator, 8, {true}), 2);
    EXPECT_NEAR(transparent.light.mean(), opaque.light.mean() - 0.5, 1e-4);
    EXPECT_GT(transparent.light.mean(), 0.1);
    EXPECT_EQ(transparent.alpha.mean(), 0.0);
  }
}

// --- Exposure ------------------------------------------------------------------------------------

TEST(KnownAnswer, ExposureActsOnTheFinishedColor) {
  const auto scene =
      room()
          .add("half", plane(0.5f, 0.5f), mixed(diffuse(Rgb(0.5f)), holdout()), upright(-0.8f))
          .light("l", area_light({0.2f, -0.4f, 0.9f}, {0, 0, -0.5f}, 0.5f, 20))
          .build();
  for (const IntegratorType integrator : kIntegrators) {
    RenderSettings settings = small_picture(integrator, 8);
    settings.clamp_direct = 0.2f;
    const Image plain = render(scene, settings);
    settings.film_exposure = 3.0f;
    const Image exposed = render(scene, settings);
    for (size_t i = 0; i < plain.pixels.size(); ++i) {
      const float expected = plain.pixels[i] * (i % 4 == 3 ? 1.0f : 3.0f);
      ASSERT_NEAR(exposed.pixels[i], expected, 1e-5f * std::abs(expected));
    }
  }
}

}  // namespace
}  // namespace janus::test
