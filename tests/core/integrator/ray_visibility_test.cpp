// SPDX-License-Identifier: GPL-3.0-or-later
//
// What an object or a light is visible to is a rule of the whole path: a segment has one type,
// whichever technique made it and from whichever end.
#include "support/matrix.h"
#include "support/pictures.h"

namespace janus::test {
namespace {

constexpr RayMask without(std::initializer_list<RayType> types) {
  RayMask mask = kAllRays;
  for (const RayType type : types) {
    mask &= static_cast<RayMask>(~ray_bit(type));
  }
  return mask;
}

struct Hidden {
  std::string name;
  RayMask mask;
};
std::ostream& operator<<(std::ostream& out, const Hidden& h) { return out << h.name; }

const Hidden kHidden[] = {
    {"camera", without({RayType::Camera})},
    {"diffuse", without({RayType::Diffuse})},
    {"glossy", without({RayType::Glossy})},
    {"transmission", without({RayType::Transmission})},
    {"shadow", without({RayType::Shadow})},
    {"camera_and_shadow", without({RayType::Camera, RayType::Shadow})},
    {"all_but_shadow", ray_bit(RayType::Shadow)},
    {"all_but_glossy", ray_bit(RayType::Glossy)},
};

NodeGraph leaf() {
  return combine("MIX_SHADER", plastic(Rgb(0.7f), 0.6f),
                 single("BSDF_GLASS", {{"Roughness", 0.6f}, {"IOR", 1.4f}}));
}

// Nothing smooth, so that every technique can make every path. The screen is between the lamp and
// the floor, in the picture, and lit from both sides.
SceneKit plates(RayMask screen, RayMask lamp = kAllRays, const NodeGraph& screen_of = leaf()) {
  LightDesc light = area_light({1.2f, -0.3f, 1.0f}, {0, 0, -0.9f}, 0.9f, 30);
  light.visibility = lamp;
  return SceneKit()
      .add("floor", plane(4, 4), plastic(Rgb(0.5f, 0.4f, 0.3f), 0.6f), translation({0, 0, -1}))
      .add("ceiling", plane(4, 4), plastic(Rgb(0.3f, 0.4f, 0.5f), 0.7f),
           translation({0.1f, 0, 1.2f}) * rotation({1, 0, 0}, 3.0f))
      .add("leaf", plane(1.4f, 1.4f), leaf(),
           translation({-0.6f, 0.4f, -0.1f}) * rotation({0, 1, 0}, 1.3f))
      .add("window", plane(0.5f, 0.6f), leaf(),
           translation({0.3f, -1.4f, 0.1f}) * rotation({1, 0, 0}, 1.3f))
      .add("screen", plane(1.1f, 1.3f), screen_of,
           translation({0.4f, -0.1f, -0.1f}) * rotation({0, 1, 0}, 0.4f), screen)
      .light("l", light)
      .camera({0, -2.6f, 0.8f}, {0, 0.2f, -0.7f}, 0.7f);
}

// By how many standard deviations two pictures differ at most, in one of their parts.
double largest_z(const std::vector<Mean>& a, const std::vector<Mean>& b) {
  double z = 0.0;
  for (size_t k = 0; k < a.size(); ++k) {
    z = std::max(z, std::abs(z_score(a[k], b[k])));
  }
  return z;
}

class RayVisibility : public ::testing::TestWithParam<Hidden> {};
class RayVisibilityByTechnique : public RayVisibility {};

// --- Every technique
// ------------------------------------------------------------------------------

void expect_every_technique(const std::shared_ptr<const Scene>& scene,
                            const std::shared_ptr<const Scene>& plain) {
  for (const int edges : {2, 3}) {
    const auto technique = [&](int s, int count) {
      RenderSettings settings = small_picture(IntegratorType::Bdpt, samples(count));
      settings.strategies = Technique{s, edges + 1 - s};
      settings.seed = 100 * s;
      if (s == 0) {
        settings.light_paths = 0.0f;
      }
      return settings;
    };
    const double all = quarters(plain, technique(1, 16))[0].mean();
    const auto reference = quarters(scene, technique(1, 64));
    for (int s = 0; s <= edges; ++s) {
      if (s != 1) {
        SCOPED_TRACE(::testing::Message() << "s = " << s << ", t = " << edges + 1 - s);
        const auto found = quarters(scene, technique(s, s == 0 ? 128 : 64));
        for (size_t k = 0; k < found.size(); ++k) {
          EXPECT_TRUE(agree(found[k], reference[k], 4.8)) << "part " << k;
        }
        EXPECT_LT(std::hypot(found[0].error(), reference[0].error()), 0.12 * all);
      }
    }
  }
}

void expect_agreement_of_integrators(const std::shared_ptr<const Scene>& scene,
                                     const std::shared_ptr<const Scene>& plain,
                                     int light_tracing = 64) {
  EXPECT_TRUE(scene->diagnostics.empty());
  const auto picture = [&](const auto& of, IntegratorType integrator, int count, int seed) {
    RenderSettings settings = small_picture(integrator, samples(count));
    settings.max_bounces = 4;
    settings.max_glossy_bounces = 1;
    settings.seed = seed;
    return quarters(of, settings);
  };
  const auto bdpt = picture(scene, IntegratorType::Bdpt, 24, 0);
  expect_agreement(bdpt, picture(scene, IntegratorType::PathTracer, 96, 0), 0.015);
  expect_agreement(bdpt, picture(scene, IntegratorType::LightTracer, light_tracing, 0), 0.02);
  EXPECT_GT(largest_z(picture(plain, IntegratorType::Bdpt, 24, 100), bdpt),
            3.0);  // the scene shows it
}

TEST_P(RayVisibility, IntegratorsAgreeOnObjects) {
  expect_agreement_of_integrators(plates(GetParam().mask).build(), plates(kAllRays).build());
}

TEST_P(RayVisibilityByTechnique, EveryTechniqueOfObjects) {
  expect_every_technique(plates(GetParam().mask).build(), plates(kAllRays).build());
}

INSTANTIATE_TEST_SUITE_P(Hidden, RayVisibility, ::testing::ValuesIn(kHidden),
                         [](const auto& info) { return info.param.name; });

INSTANTIATE_TEST_SUITE_P(Hidden, RayVisibilityByTechnique,
                         ::testing::Values(kHidden[2], kHidden[3], kHidden[4], kHidden[7]),
                         [](const auto& info) { return info.param.name; });

class LightVisibility : public ::testing::TestWithParam<Hidden> {};

TEST_P(LightVisibility, IntegratorsAgreeOnLights) {
  expect_agreement_of_integrators(plates(kAllRays, GetParam().mask).build(),
                                  plates(kAllRays).build());
}

TEST_P(LightVisibility, EveryTechniqueOfLights) {
  expect_every_technique(plates(kAllRays, GetParam().mask).build(), plates(kAllRays).build());
}

INSTANTIATE_TEST_SUITE_P(Hidden, LightVisibility, ::testing::Values(kHidden[1], kHidden[2]),
                         [](const auto& info) { return info.param.name; });

// --- All together
// ---------------------------------------------------------------------------------

// Smooth mirrors and glass, alpha, an emitter among the objects: what is hidden, and what from.
struct Mixed {
  std::string name;
  RayMask ball, pane, lamp;  // objects
  RayMask light;             // a light object, with its shape
  std::function<void(SceneKit&, RayMask)> add_light;
};
std::ostream& operator<<(std::ostream& out, const Mixed& m) { return out << m.name; }

void add_area(SceneKit& kit, RayMask visibility) {
  LightDesc light = area_light({0, 0, 0.95f}, {0, 0, 0}, 0.9f, 20);
  light.visibility = visibility;
  kit.light("l", light);
}
void add_soft_point(SceneKit& kit, RayMask visibility) {
  LightDesc light = point_light({0.2f, -0.3f, 0.6f}, 20, 0.25f);
  light.visibility = visibility;
  kit.light("l", light);
}
void add_sun(SceneKit& kit, RayMask visibility) {
  LightDesc light = sun_light({0.2f, -1, 0.4f}, 2, 0.4f);
  light.visibility = visibility;
  kit.light("l", light);
}

const Mixed kMixed[] = {
    {"camera", without({RayType::Camera}), kAllRays, without({RayType::Camera}), kAllRays,
     add_area},
    {"diffuse", kAllRays, without({RayType::Diffuse}), without({RayType::Diffuse}), kAllRays,
     add_area},
    {"glossy", without({RayType::Glossy}), kAllRays, kAllRays, without({RayType::Glossy}),
     add_area},
    {"transmission", kAllRays, without({RayType::Transmission}), without({RayType::Transmission}),
     without({RayType::Transmission}), add_area},
    {"shadow", without({RayType::Shadow}), without({RayType::Shadow}), without({RayType::Shadow}),
     kAllRays, add_area},
    {"various", without({RayType::Shadow}), without({RayType::Glossy, RayType::Camera}),
     without({RayType::Diffuse, RayType::Shadow}), without({RayType::Glossy}), add_soft_point},
    {"sun", without({RayType::Shadow}), without({RayType::Diffuse}), without({RayType::Glossy}),
     without({RayType::Glossy}), add_sun},
};

class MixedVisibility : public ::testing::TestWithParam<Mixed> {};

TEST_P(MixedVisibility, IntegratorsAgree) {
  const auto make = [](const Mixed& m) {
    SceneKit kit = room();
    kit.add("ball", ball(0.35f, 12, true),
            single("BSDF_PRINCIPLED", {{"Base Color", vec4(0.8f, 0.3f, 0.2f, 1)},
                                       {"Roughness", 0.3f},
                                       {"Transmission Weight", 0.8f}}),
            translation({0.35f, -0.2f, 0.1f}), m.ball)
        .add("mirror", plane(1.2f, 1.2f),
             combine("MIX_SHADER", mirror(Rgb(0.9f)), diffuse(Rgb(0.5f))),
             translation({-0.95f, 0, 0.2f}) * rotation({0, 1, 0}, 0.5f * kPi))
        .add("pane", plane(0.9f, 0.9f),
             combine("MIX_SHADER", diffuse(Rgb(0.4f, 0.5f, 0.3f)),
                     single("BSDF_TRANSPARENT", {{"Color", vec4(0.9f, 0.8f, 0.7f, 1)}}), 0.4f),
             translation({0.1f, 0.1f, 0.45f}) * rotation({0, 1, 0}, 0.3f), m.pane)
        .add("lamp", plane(0.4f, 0.4f), emission(Rgb(1, 0.8f, 0.6f), 3),
             translation({0.5f, 0.6f, 0.6f}) * rotation({1, 0, 0}, 0.4f), m.lamp);
    m.add_light(kit, m.light);
    return kit.build();
  };
  const Mixed& mixed = GetParam();
  const auto scene = make(mixed);
  const auto picture = [&](const auto& of, IntegratorType integrator, int count, int edges) {
    RenderSettings settings = small_picture(integrator, samples(count));
    settings.max_bounces = 5;
    settings.max_diffuse_bounces = 2;
    settings.seed = edges;
    return quarters(of, settings);
  };
  const auto bdpt = picture(scene, IntegratorType::Bdpt, 32, 0);
  expect_agreement(bdpt, picture(scene, IntegratorType::PathTracer, 96, 0), 0.015);
  const auto plain = make({"", kAllRays, kAllRays, kAllRays, kAllRays, mixed.add_light});
  EXPECT_GT(largest_z(picture(plain, IntegratorType::Bdpt, 32, 7), bdpt),
            3.0);  // the scene shows it
}

INSTANTIATE_TEST_SUITE_P(Scenes, MixedVisibility, ::testing::ValuesIn(kMixed),
                         [](const auto& info) { return info.param.name; });

// --- Known answers
// --------------------------------------------------------------------------------

constexpr IntegratorType kIntegrators[] = {IntegratorType::Bdpt, IntegratorType::PathTracer,
                                           IntegratorType::LightTracer};

// A plate between a lamp and a floor, below the camera's view of it or not.
double floor_under(RayMask plate, float height, IntegratorType integrator, int max_bounces = 0) {
  SceneKit kit;
  kit.add("floor", plane(2, 2), diffuse(Rgb(0.6f)))
      .light("l", area_light({0, 0, 2}, {0, 0, 0}, 0.5f, 20))
      .camera({0, 0, 1}, {0, 0, 0});
  if (plate) {
    kit.add("plate", plane(9, 9), diffuse(Rgb(0.0f)), translation({0, 0, height}), plate);
  }
  RenderSettings settings = small_picture(integrator, samples(8));
  settings.max_bounces = max_bounces;
  return quarters(kit.build(), settings)[0].mean();
}

TEST(RayVisibilityOf, APlateThatSomeRaysPass) {
  for (const IntegratorType integrator : kIntegrators) {
    SCOPED_TRACE(::testing::Message() << "integrator " << static_cast<int>(integrator));
    const double open = floor_under(0, 0, integrator);
    const auto expect = [&](RayMask plate, float height, double expected) {
      EXPECT_NEAR(floor_under(plate, height, integrator), expected, 1e-3 * open)
          << static_cast<int>(plate) << " at " << height;
    };
    for (const float height : {0.5f, 1.5f}) {  // below and above the camera
      expect(kAllRays, height, 0);
    }
    expect(without({RayType::Shadow}), 1.5f, open);
    expect(without({RayType::Camera}), 1.5f, 0);
    expect(without({RayType::Shadow}), 0.5f, 0);  // the camera sees its black side
    expect(without({RayType::Shadow, RayType::Camera}), 0.5f, open);
    expect(without({RayType::Diffuse, RayType::Glossy, RayType::Transmission}), 1.5f, 0);
  }
}

// A lamp seen in a smooth mirror is no shadow ray's business.
TEST(RayVisibilityOf, AMirrorSeesByGlossyRays) {
  for (const RayMask lamp : {kAllRays, without({RayType::Glossy}), without({RayType::Diffuse}),
                             without({RayType::Shadow})}) {
    for (const RayMask screen :
         {kAllRays, without({RayType::Glossy}), without({RayType::Shadow})}) {
      const auto scene =
          SceneKit()
              .add("mirror", plane(9, 9), mirror(Rgb(1)))
              .add("lamp", plane(9, 9), emission(Rgb(1), 1), translation({0, 0, 3}), lamp)
              .add("screen", plane(9, 9), diffuse(Rgb(0)), translation({0, 0, 2}), screen)
              .camera({0, 0, 1}, {0, 0, 0}, 0.1f)
              .build();
      for (const IntegratorType integrator : {IntegratorType::Bdpt, IntegratorType::PathTracer}) {
        const bool seen = contains(lamp, RayType::Glossy) && !contains(screen, RayType::Glossy);
        EXPECT_NEAR(quarters(scene, small_picture(integrator, 4), 2)[0].mean(), seen, 1e-4);
      }
    }
  }
}

// What nothing sees is as good as nothing.
TEST(RayVisibilityOf, NothingSeesIt) {
  for (const IntegratorType integrator : kIntegrators) {
    const double open = floor_under(0, 0, integrator, 2);
    EXPECT_NEAR(floor_under(ray_bit(RayType::Glossy), 0.5f, integrator, 2), open, 2e-3 * open);
  }
}

// The alpha of the film is the camera's.
TEST(RayVisibilityOf, AlphaOfTheFilm) {
  for (const auto& [mask, alpha] : {std::pair(kAllRays, 1.0),
                                    {without({RayType::Camera}), 0.0},
                                    {without({RayType::Shadow}), 1.0}}) {
    const auto scene =
        SceneKit()
            .add("plate", plane(9, 9), diffuse(Rgb(0.5f)), rotation({1, 0, 0}, 0.5f * kPi), mask)
            .light("l", point_light({0, -1, 0}, 5))
            .build();
    for (const IntegratorType integrator : kIntegrators) {
      RenderSettings settings = small_picture(integrator, 2);
      settings.film_transparent = true;
      EXPECT_EQ(render(scene, settings).pixels[3], alpha);
    }
  }
}

// --- Light Path
// ------------------------------------------------------------------------------

// The screen, which glows as something else to the rays that answer yes: less in the way, too.
NodeGraph asking(const std::string& output) {
  const NodeGraph lit = combine("ADD_SHADER", plastic(Rgb(0.6f, 0.2f, 0.1f), 0.5f),
                                combine("ADD_SHADER", emission(Rgb(0.6f, 0.9f, 0.5f), 2),
                                        single("BSDF_TRANSPARENT", {{"Color", vec4(0.3f)}})));
  NodeGraph graph = combine("MIX_SHADER", leaf(), lit);
  for (Node& node : graph.nodes) {
    if (node.name == graph.surface->node) {
      node.inputs["Fac"] = link("Path", output);
    }
  }
  graph.nodes.push_back(node("Path", "LIGHT_PATH", {}));
  return graph;
}

class LightPathNode : public ::testing::TestWithParam<std::string> {};

TEST_P(LightPathNode, IntegratorsAgree) {
  const auto scene = plates(kAllRays, kAllRays, asking(GetParam())).build();
  EXPECT_EQ(scene->instances.size(), 6u);  // the screen is two
  expect_agreement_of_integrators(scene, plates(kAllRays).build(), 256);
}

TEST_P(LightPathNode, EveryTechnique) {
  expect_every_technique(plates(kAllRays, kAllRays, asking(GetParam())).build(),
                         plates(kAllRays).build());
}

INSTANTIATE_TEST_SUITE_P(Outputs, LightPathNode,
                         ::testing::Values("Is Camera Ray", "Is Shadow Ray", "Is Diffuse Ray",
                                           "Is Glossy Ray", "Is Reflection Ray",
                                           "Is Transmission Ray"),
                         [](const auto& info) {
                           std::string name = info.param;
                           std::erase(name, ' ');
                           return name;
                         });

}  // namespace
}  // namespace janus::test
