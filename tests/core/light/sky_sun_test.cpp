// SPDX-License-Identifier: GPL-3.0-or-later
//
// A world of Sky Texture is made of its sun and the rest: each direction belongs to one of them.
#include <gtest/gtest.h>

#include "light/light_cases.h"

namespace janus::test {
namespace {

std::shared_ptr<const Scene> world(std::map<std::string, NodeProperty> properties,
                                   const std::string& model = "SINGLE_SCATTERING") {
  SceneKit kit = around();
  kit.builder.set_world({"World", sky_texture(model, std::move(properties))});
  return kit.build();
}

vec3 toward(float elevation, float rotation) {
  return {std::cos(elevation) * std::sin(rotation), std::cos(elevation) * std::cos(rotation),
          std::sin(elevation)};
}

TEST(SkySun, StandsWhereTheNodeSays) {
  const auto scene = world({{"sun_elevation", 0.4f}, {"sun_rotation", 1.1f}});
  ASSERT_EQ(scene->lights.size(), 2u);
  const Emitter sun = scene->lights[1]->emitters().at(0);
  EXPECT_LT(length2(sun.axis - toward(0.4f, 1.1f)), 1e-10f);
  EXPECT_NEAR(sun.theta_o, 0.00475f, 1e-4f);
  EXPECT_GT(sun.strength, scene->lights[0]->emitters().at(0).strength);
}

TEST(SkySun, SharesDirectionsWithTheSky) {
  const auto scene = world({{"sun_size", 0.5f}});
  Random random(3);
  int in_sun = 0;
  for (int i = 0; i < 10000; ++i) {
    vec3 d = random.direction();
    d.z = std::abs(d.z);
    const Ray ray{vec3(0.0f), d};
    const auto sky = scene->lights[0]->intersect(ray), sun = scene->lights[1]->intersect(ray);
    ASSERT_NE(sky.has_value(), sun.has_value());
    in_sun += sun ? 1 : 0;
    const bool inside = dot(d, toward(0.6f, 0.0f)) > std::cos(0.25f * 1.001f);
    EXPECT_EQ(sun.has_value(), inside);
  }
  EXPECT_GT(in_sun, 200);
}

TEST(SkySun, IrradianceAgrees) {
  const auto scene = world({{"sun_size", 0.5f}}, "MULTIPLE_SCATTERING");
  const Light& sun = *scene->lights.at(1);
  Mean nee, hit, power;
  Random random(5);
  for (int i = 0; i < 100000; ++i) {
    if (const auto s = sun.sample_illumination(vec3(0.0f), 0, random.next_2d())) {
      nee.add(luminance(s->radiance) / s->pdf_solid);
    }
    const auto h = sun.intersect({vec3(0.0f), random.direction()});
    hit.add(h ? luminance(h->radiance) * 4 * kPi : 0.0f);
    const auto e = sun.sample_emission(random.next_2d(), random.next_2d());
    power.add(e ? luminance(e->weight) : 0.0f);
  }
  EXPECT_NEAR(nee.mean() / sun.emitters().at(0).strength, 1, 0.01);
  EXPECT_NEAR(hit.mean(), nee.mean(), 4 * hit.error());
  EXPECT_NEAR(power.mean() / sun.power(), 1, 0.05);
}

TEST(SkySun, IsNoLightWhereItDoesNotShine) {
  EXPECT_EQ(world({{"sun_elevation", -0.5f}})->lights.size(), 1u);
  EXPECT_EQ(world({{"sun_disc", false}})->lights.size(), 1u);
  EXPECT_EQ(world({{"sun_intensity", 0.0f}})->lights.size(), 1u);
  EXPECT_EQ(world({}, "PREETHAM")->lights.size(), 1u);
}

}  // namespace
}  // namespace janus::test
