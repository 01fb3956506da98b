// SPDX-License-Identifier: GPL-3.0-or-later
//
// Path tracing, light tracing and BDPT have the same expectation: for each kind of light, for
// specular surfaces and for shading normals. pt finds light by NEE and by hits, lt by emission
// only, so agreement also ties a light's three densities together.
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
    {"leaning_mirror",  // out of the picture; all of its light comes by way of the mirror
     [] {
       return SceneKit()
           .add("floor", plane(3, 3), diffuse(Rgb(0.8f)), translation({0, 0, -1}))
           .add("mirror", leaning(plane(1.5f, 1.5f), {-0.5f, 0, 0.87f}), mirror(Rgb(0.9f)),
                translation({1, 0, 0}) * rotation({0, 1, 0}, -0.5f * kPi))
           .light("l", area_light({-1, 0, 0.2f}, {1, 0, 0.2f}, 0.8f, 20, 2.0f))
           .camera({0, 0, 2}, {0, 0, -1}, 0.3f);
     },
     true, 48},
    {"hair",  // where light walks end
     [] { return strands_in(room()).light("l", area_light({0, 0, 0.95f}, {0, 0, 0}, 0.9f, 20)); },
     false, 64},
    {"shining_hair",  // light that walks alone can find
     [] {
       return room()
           .add("tube", strand({{-0.7f, 0, 0.6f}, {0, 0.2f, 0.8f}, {0.7f, 0, 0.6f}}, 0.15f),
                emission(Rgb(1, 0.8f, 0.6f), 4))
           .add("balls", balls({{0.5f, -0.3f, 0}, {-0.1f, -0.5f, 0.2f}}, 0.12f),
                combine("ADD_SHADER", diffuse(Rgb(0.5f)), emission(Rgb(0.5f, 0.7f, 1), 3)));
     },
     false, 96},
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
  expect_integrators_agree(scene, count, light_tracing);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Agreement, ::testing::ValuesIn(kScenes),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace janus::test
