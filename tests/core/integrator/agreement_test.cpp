// SPDX-License-Identifier: GPL-3.0-or-later
//
// Path tracing, light tracing and BDPT have the same expectation: for each kind of light, for
// specular surfaces, for shading normals, and for every subset of the techniques. pt finds light by
// NEE and by hits, lt by emission only, so agreement also ties a light's three densities together.
#include "support/pictures.h"
#include "support/scene_kit.h"

namespace janus::test {
namespace {

struct AgreementScene {
  std::string name;
  SceneKit (*make)();
  bool light_tracing;  // nothing is seen by way of a mirror or through glass
  int samples = 24;
};

// Two diffuse blocks, so that there are shadows and paths of every length.
SceneKit room() {
  return open_box()
      .add("block", cuboid({-0.7f, -0.2f, -1}, {-0.2f, 0.4f, 0.1f}), diffuse(Rgb(0.7f)))
      .add("low", cuboid({0.2f, -0.6f, -1}, {0.7f, 0.0f, -0.4f}), diffuse(Rgb(0.2f, 0.5f, 0.8f)));
}

const AgreementScene kScenes[] = {
    {"area", [] { return room().light("l", area_light({0, 0, 0.9f}, {0, 0, 0}, 0.5f, 20)); }, true},
    {"area_spread",
     [] { return room().light("l", area_light({0, 0, 0.9f}, {0.1f, 0, 0}, 0.4f, 20, 1.0f)); },
     true},
    {"area_scaled",
     [] {
       LightDesc light = area_light({0.2f, 0.2f, 0.8f}, {0, 0, 0}, 0.4f, 20);
       light.shape = AreaShape::Ellipse;
       light.transform = light.transform * scaling({1.5f, 0.4f, 1});
       return room().light("l", light);
     },
     true, 160},
    {"point", [] { return room().light("l", point_light({0.1f, 0, 0.6f}, 20)); }, true},
    {"point_soft", [] { return room().light("l", point_light({0.1f, 0, 0.6f}, 20, 0.3f)); }, true},
    {"point_sphere",
     [] { return room().light("l", point_light({0.1f, 0, 0.6f}, 20, 0.3f, false)); }, true},
    {"mesh",
     [] {
       return room().add(
           "lamp", plane(0.5f, 0.2f), emission(Rgb(1, 0.8f, 0.6f), 5),
           translation({0, 0, 0.8f}) * rotation({0, 1, 0}, 2.6f) * scaling({1, -2, 1}));
     },
     true},
    {"world", [] { return room().world(Rgb(0.5f, 0.7f, 1)); }, true, 96},
    {"shading_normals",  // where the adjoint BSDF differs from the BSDF
     [] {
       return room()
           .add("ball", ball(0.4f, 8, true), diffuse(Rgb(0.8f)), translation({0.2f, 0.3f, 0.2f}))
           .light("l", area_light({0, 0, 0.9f}, {0, 0, 0}, 0.5f, 20));
     },
     true},
    {"emitting_surface",  // a closure and an emission on one surface
     [] {
       return room().add("lamp", cuboid({-0.2f, -0.2f, 0.3f}, {0.2f, 0.2f, 0.6f}),
                         combine("ADD_SHADER", diffuse(Rgb(0.5f)), emission(Rgb(1), 2)));
     },
     true},
    {"glass_and_mirror",
     [] {
       return room()
           .add("glass", ball(0.35f, 24, true), glass(Rgb(0.9f, 1, 1), 1.5f),
                translation({0.4f, -0.2f, 0.0f}))
           .add("mirror", ball(0.3f, 16), mirror(Rgb(0.9f)), translation({-0.45f, 0.1f, 0.5f}))
           .light("l", area_light({0, 0, 0.95f}, {0, 0, 0}, 0.9f, 20));
     },
     false, 64},
    {"mixture",  // delta and smooth lobes at one point
     [] {
       return room()
           .add("ball", ball(0.35f, 16),
                combine("MIX_SHADER", diffuse(Rgb(0.8f)), glass(Rgb(1), 1.4f), 0.3f),
                translation({0.4f, -0.2f, 0.0f}))
           .light("l", area_light({0, 0, 0.95f}, {0, 0, 0}, 0.9f, 20));
     },
     false, 64},
};

std::ostream& operator<<(std::ostream& out, const AgreementScene& s) { return out << s.name; }

class Agreement : public ::testing::TestWithParam<AgreementScene> {};

TEST_P(Agreement, AllIntegrators) {
  const auto& [name, make, light_tracing, count] = GetParam();
  const auto scene = make().build();
  EXPECT_TRUE(scene->diagnostics.empty());
  const auto bdpt = quarters(scene, small_picture(IntegratorType::Bdpt, samples(count)));
  const auto pt = quarters(scene, small_picture(IntegratorType::PathTracer, samples(3 * count)));
  expect_agreement(bdpt, pt);
  if (light_tracing) {
    expect_agreement(bdpt,
                     quarters(scene, small_picture(IntegratorType::LightTracer, samples(count))));
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Agreement, ::testing::ValuesIn(kScenes),
                         [](const auto& info) { return std::string(info.param.name); });

// --- Subsets of the techniques, on a scene where all of them matter ------------------------------

class Techniques : public ::testing::Test {
 protected:
  void expect_same(RenderSettings settings) {
    RenderSettings reference = small_picture(IntegratorType::PathTracer, samples(160));
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

TEST_F(Techniques, WithoutLightPaths) {
  bdpt_.light_paths = 0.0f;
  expect_same(bdpt_);
}
TEST_F(Techniques, WithoutConnections) {
  bdpt_.connections = 0.0f;
  expect_same(bdpt_);
}
TEST_F(Techniques, ManyConnections) {
  bdpt_.connections = 3.5f;
  expect_same(bdpt_);
}
TEST_F(Techniques, FewLightPaths) {
  bdpt_.light_paths = 0.3f;
  expect_same(bdpt_);
}
TEST_F(Techniques, PowerHeuristic) {
  bdpt_.heuristic = Heuristic::Power;
  expect_same(bdpt_);
}
TEST_F(Techniques, ManyWaves) {  // a cache too small for a pass
  bdpt_.width = bdpt_.height = 64;
  bdpt_.samples = samples(6);
  bdpt_.cache_bytes = 1 << 16;
  expect_same(bdpt_);
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
  reference.samples = samples(160);
  expect_agreement(quarters(scene_, bdpt_), quarters(scene_, reference));
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

}  // namespace
}  // namespace janus::test
