// SPDX-License-Identifier: GPL-3.0-or-later
//
// Transparent surfaces are crossings: every technique lets the same share of light through them,
// counts the same of them on a path, and finds what they emit.
#include "support/pictures.h"
#include "support/scene_kit.h"

namespace janus::test {
namespace {

NodeGraph transparent(Rgb color) { return single("BSDF_TRANSPARENT", {{"Color", vec4(color, 1)}}); }

// Half of it is there.
NodeGraph half(const NodeGraph& there, Rgb through = Rgb(1)) {
  return combine("MIX_SHADER", there, transparent(through));
}

NodeGraph glowing_alpha(float alpha, float strength) {
  return single("BSDF_PRINCIPLED", {{"Base Color", vec4(0.8f, 0.6f, 0.3f, 1)},
                                    {"Roughness", 0.6f},
                                    {"Alpha", alpha},
                                    {"Emission Color", vec4(1, 0.5f, 0.2f, 1)},
                                    {"Emission Strength", strength}});
}

// A floor, a wall and a block.
SceneKit stage() {
  return SceneKit()
      .add("floor", plane(3, 3), diffuse(Rgb(0.6f)), translation({0, 0, -0.6f}))
      .add("wall", plane(3, 2), diffuse(Rgb(0.7f, 0.5f, 0.4f)),
           translation({0, 1.4f, 0.4f}) * rotation({1, 0, 0}, 0.5f * kPi))
      .add("block", cuboid({-0.3f, -0.3f, -0.55f}, {0.3f, 0.3f, 0}), diffuse(Rgb(0.3f, 0.6f, 0.7f)))
      .camera({0, -2.6f, 1}, {0, 0, -0.3f}, 0.25f);
}

LightDesc lamp() { return area_light({0.7f, -0.7f, 1.5f}, {0, 0, -0.3f}, 0.7f, 40); }

// Level panes over the block, below the lamp, smaller than the floor: some light comes from aside.
SceneKit& roof(SceneKit& kit, int count) {
  for (int i = 0; i < count; ++i) {
    kit.add("roof" + std::to_string(i), plane(1.6f, 1.6f), transparent(Rgb(0.9f, 0.7f, 0.5f)),
            translation({0, 0, 0.5f + 0.2f * i}));
  }
  return kit;
}

// Upright panes before the camera, over half of the frame.
SceneKit& window(SceneKit& kit, int count) {
  for (int i = 0; i < count; ++i) {
    kit.add("window" + std::to_string(i), plane(1, 1), transparent(Rgb(0.5f, 0.7f, 0.9f)),
            translation({0.5f, -1.4f - 0.2f * i, 0.4f}) * rotation({1, 0, 0}, 0.5f * kPi));
  }
  return kit;
}

// --- Agreement
// ------------------------------------------------------------------------------------

struct CrossingScene {
  std::string name;
  SceneKit (*make)();
};

const CrossingScene kScenes[] = {
    {"before_lamp", [] { return roof(stage().light("l", lamp()), 3); }},
    {"before_camera", [] { return window(stage().light("l", lamp()), 3); }},
    {"both", [] { return window(roof(stage().light("l", lamp()), 1), 2); }},
    {"alpha",  // crossings with a choice, and vertices on the same surfaces
     [] {
       return stage()
           .add("screen", plane(1.6f, 1.6f), half(diffuse(Rgb(0.8f, 0.6f, 0.5f))),
                translation({0, 0, 0.5f}) * rotation({0, 1, 0}, 0.3f))
           .add("veil", plane(1.2f, 1.2f), half(single("BSDF_TRANSLUCENT", {}), Rgb(1, 0.8f, 0.6f)),
                translation({0.5f, -1.1f, 0.2f}) * rotation({1, 0, 0}, 1.5f))
           .light("l", lamp());
     }},
    {"alpha_that_emits",
     [] {
       return stage()
           .add("glow", plane(1, 1), glowing_alpha(0.5f, 0.8f),
                translation({0.4f, -0.9f, 0.1f}) * rotation({1, 0, 0}, 1.4f))
           .light("l", lamp());
     }},
    {"alpha_lamp",
     [] {
       return stage().add("lamp", cuboid({0.2f, -1, 1.3f}, {0.9f, -0.4f, 1.7f}),
                          glowing_alpha(0.6f, 12));
     }},
    {"alpha_lamp_behind_panes",  // a closed one: its light crosses its own far side
     [] {
       return roof(window(stage().add("lamp", cuboid({0.2f, -1, 1.3f}, {0.9f, -0.4f, 1.7f}),
                                      glowing_alpha(0.6f, 12)),
                          1),
                   1);
     }},
    {"world", [] { return window(roof(stage().world(Rgb(0.6f, 0.7f, 1)), 2), 1); }},
    {"sun",
     [] { return window(roof(stage().light("l", sun_light({0.3f, -0.5f, 1}, 2, 0)), 2), 1); }},
    {"glossy",  // a pane that also reflects, over what it shows
     [] {
       return stage()
           .add("cover", plane(1.2f, 1.2f),
                half(single("BSDF_GLOSSY", {{"Roughness", 0.5f}}), Rgb(0.7f, 0.9f, 0.8f)),
                translation({0, 0, 0.3f}) * rotation({1, 0, 0}, 0.2f))
           .light("l", lamp());
     }},
};

std::ostream& operator<<(std::ostream& out, const CrossingScene& s) { return out << s.name; }

class Crossings : public ::testing::TestWithParam<CrossingScene> {};

// The limit is a property of the whole path.
TEST_P(Crossings, IntegratorsAgreeAtEveryLimit) {
  const auto scene = GetParam().make().build();
  EXPECT_TRUE(scene->diagnostics.empty());
  const auto picture = [&](IntegratorType integrator, int count, int limit) {
    RenderSettings settings = small_picture(integrator, samples(count));
    settings.max_bounces = 3;
    settings.transparent_max_bounces = limit;
    settings.seed = 10000 * limit;
    return quarters(scene, settings);
  };
  const auto all = picture(IntegratorType::Bdpt, 12, 8);
  for (const int limit : {0, 1, 2, 8}) {
    SCOPED_TRACE(::testing::Message() << "at most " << limit << " crossings");
    const auto bdpt = limit == 8 ? all : picture(IntegratorType::Bdpt, 12, limit);
    for (const auto& [integrator, count] :
         {std::pair(IntegratorType::PathTracer, 32), std::pair(IntegratorType::LightTracer, 80)}) {
      SCOPED_TRACE(::testing::Message() << "integrator " << static_cast<int>(integrator));
      const auto found = picture(integrator, count, limit);
      for (size_t k = 0; k < found.size(); ++k) {
        EXPECT_TRUE(agree(found[k], bdpt[k], 5.5)) << "part " << k;
      }
      // What a limit leaves may be little and noisy: its error counts beside the whole picture.
      EXPECT_LT(std::hypot(found[0].error(), bdpt[0].error()), 0.015 * all[0].mean());
    }
    if (limit == 0) {
      EXPECT_LT(z_score(bdpt[0], all[0]), -6.0);  // it cuts
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Crossings, ::testing::ValuesIn(kScenes),
                         [](const auto& info) { return info.param.name; });

// --- Known answers
// --------------------------------------------------------------------------------

constexpr IntegratorType kIntegrators[] = {IntegratorType::Bdpt, IntegratorType::PathTracer,
                                           IntegratorType::LightTracer};

// Panes between a lamp and a floor, or between the floor and the camera, let T^n through while n
// is within the limit, and nothing beyond.
TEST(Transparency, PanesMultiplyUpToTheLimit) {
  constexpr float kThrough = 0.8f;
  for (const float low : {0.2f, 1.1f}) {  // the camera is at 1
    for (const IntegratorType integrator : kIntegrators) {
      const auto picture = [&](int panes, int limit) {
        SceneKit kit;
        kit.add("floor", plane(2, 2), diffuse(Rgb(0.6f)));
        kit.light("l", area_light({0, 0, 2}, {0, 0, 0}, 0.5f, 20)).camera({0, 0, 1}, {0, 0, 0});
        for (int i = 0; i < panes; ++i) {  // as wide as all paths
          kit.add("pane" + std::to_string(i), plane(9, 9), transparent(Rgb(kThrough)),
                  translation({0, 0, low + 0.2f * i}));
        }
        RenderSettings settings = small_picture(integrator, samples(8));
        settings.max_bounces = 0;
        settings.transparent_max_bounces = limit;
        return quarters(kit.build(), settings)[0];
      };
      const Mean open = picture(0, 8);
      for (const int panes : {1, 3}) {
        // Below the camera, the light passes on its way down and up again.
        const int crossings = low < 1.0f ? 2 * panes : panes;
        for (const int limit : {0, crossings - 1, crossings, 8}) {
          SCOPED_TRACE(::testing::Message() << panes << " panes from " << low << ", limit " << limit
                                            << ", integrator " << static_cast<int>(integrator));
          const Mean found = picture(panes, limit);
          const double expected =
              limit < crossings ? 0.0 : open.mean() * std::pow(kThrough, crossings);
          EXPECT_NEAR(found.mean(), expected, 1e-3 * expected);
        }
      }
    }
  }
}

// A shadow ray between two transparent surfaces crosses neither of them, from any distance.
TEST(Transparency, EndsOfAShadowRayAreNotCrossed) {
  for (const float distance : {0.5f, 2.0f, 30.0f}) {
    SceneKit kit;
    kit.add("a", plane(1, 1), transparent(Rgb(0.5f)));
    kit.add("b", plane(2, 1), transparent(Rgb(0.5f)),
            translation({0.3f, -0.2f, distance}) * rotation({1, 2, 3}, 0.4f));
    const auto scene = kit.build();
    Random random(3);
    const auto point = [&](uint32_t instance) {
      const float x = random.next();
      return scene->accel->surface_point(instance, random.next() < 0.5f ? 0 : 1,
                                         vec2(1 - x, x * random.next()));
    };
    int crossed = 0;
    for (int i = 0; i < 20000; ++i) {
      const SurfaceInteraction a = point(i % 2), b = point(1 - i % 2);
      const vec3 d = b.p - a.p;
      crossed += scene->transmittance(offset_origin(a.p, a.ng, a.offset, d),
                                      offset_origin(b.p, b.ng, b.offset, -d), RayType::Shadow,
                                      0) != Rgb(1);
    }
    EXPECT_EQ(crossed, 0) << "over " << distance << " m";
  }
}

// Film alpha: what a camera ray's crossings leave.
TEST(Transparency, AlphaOfTheFilm) {
  struct Case {
    int planes, limit;
    Rgb through;
    double alpha;
  };
  const Case cases[] = {{0, 8, Rgb(1), 0},
                        {1, 8, Rgb(1), 0.5},
                        {2, 8, Rgb(1), 0.75},
                        {1, 8, Rgb(0.2f, 0.4f, 0.6f), 0.8},
                        {1, 0, Rgb(1), 1}};  // absorbed
  for (const auto& [planes, limit, through, alpha] : cases) {
    SceneKit kit;
    kit.world(Rgb(0.5f));
    for (int i = 0; i < planes; ++i) {
      kit.add("plane" + std::to_string(i), plane(9, 9), half(diffuse(Rgb(0.8f)), through),
              translation({0, 1.0f + 0.5f * i, 0}) * rotation({1, 0, 0}, 0.5f * kPi));
    }
    const auto scene = kit.build();
    for (const IntegratorType integrator : kIntegrators) {
      RenderSettings settings = small_picture(integrator, samples(64));
      settings.film_transparent = true;
      settings.transparent_max_bounces = limit;
      Mean found;
      for (settings.seed = 0; settings.seed < 8; ++settings.seed) {
        const Image image = render(scene, settings);
        double sum = 0.0;
        for (size_t i = 3; i < image.pixels.size(); i += 4) {
          sum += image.pixels[i];
        }
        found.add(sum / 256);
      }
      SCOPED_TRACE(::testing::Message() << planes << " planes, limit " << limit << ", integrator "
                                        << static_cast<int>(integrator));
      EXPECT_NEAR(found.mean(), alpha, 0.003);
      EXPECT_LT(found.error(), 0.001);
    }
  }
}

}  // namespace
}  // namespace janus::test
