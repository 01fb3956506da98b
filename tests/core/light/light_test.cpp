// SPDX-License-Identifier: GPL-3.0-or-later
//
// A light has three descriptions: as a target of next event estimation, as something that rays
// hit, and as a source of rays. They must tell of the same radiance and of the same densities.
#include "janus/light/light.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "light/light_cases.h"

namespace janus::test {
namespace {

vec3 receiver_point(Random& random) { return vec3(random.next_2d() - 0.5f, 0); }

// Where an emitted ray meets the receiver from above.
std::optional<vec3> landing(const EmissionSample& e) {
  const vec3 p = e.origin - e.direction * (e.origin.z / e.direction.z);
  const bool inside = std::abs(p.x) < 0.5f && std::abs(p.y) < 0.5f;
  return e.direction.z < 0 && e.origin.z > 0 && inside ? std::optional(p) : std::nullopt;
}

class Lights : public ::testing::TestWithParam<LightCase> {
 protected:
  const std::shared_ptr<const Scene> scene_ = GetParam().scene();
  const Light& light_ = *scene_->lights.at(0);

  // Next event estimation: `pdf_solid` with the choice of the emitter in it.
  std::optional<IlluminationSample> illuminate(vec3 p) {
    if (!scene_->light_sampler.illuminates()) {
      return std::nullopt;
    }
    const LightChoice choice =
        scene_->light_sampler.sample_illumination(facing_up(p), random_.next());
    auto s = light_.sample_illumination(p, choice.primitive, random_.next_2d());
    if (s) {
      s->pdf_solid *= choice.pmf;
    }
    return s;
  }
  float pdf_illumination(vec3 p, const LightHit& h) const {
    return h.pdf_illumination *
           scene_->light_sampler.pmf_illumination(facing_up(p), 0, h.primitive);
  }
  static Receiver facing_up(vec3 p) { return {p, vec3(0, 0, 1), true}; }

  Random random_{9};
};

TEST_P(Lights, EmitsItsPower) {
  if (GetParam().watts > 0) {
    EXPECT_NEAR(light_.power() / GetParam().watts, 1, 1e-4);
  }
  Mean watts;
  // That of lamps that fall otherwise than lights do is what they would have in the picture.
  const float distance = glm::length(vec3(scene_->camera.transform[3]) - kFallingFrom);
  for (int i = 0; i < 200000; ++i) {
    const auto e = light_.sample_emission(random_.next_2d(), random_.next_2d());
    watts.add(e ? luminance(e->weight * light_.tint(e->origin, e->direction, distance)) : 0.0f);
  }
  if (light_.infinite()) {  // what it sends to the scene depends on the direction: about so much
    EXPECT_NEAR(watts.mean() / light_.power(), 1, 0.6);
  } else {
    EXPECT_NEAR(watts.mean() / light_.power(), 1, 0.003 + 4 * watts.error() / light_.power());
  }
}

TEST_P(Lights, IrradianceAgrees) {
  Mean nee, hit, emitted;
  for (int i = 0; i < samples(250000); ++i) {
    const vec3 p = receiver_point(random_);
    if (const auto s = illuminate(p)) {
      nee.add(std::max(0.0f, s->wi.z) * s->radiance.x / s->pdf_solid);
    } else {
      nee.add(0);
    }
    vec3 d = random_.direction();
    d.z = std::abs(d.z);
    const auto h = hit_light(*scene_, Ray{p, d});
    hit.add(h ? h->radiance.x * d.z * 2 * kPi : 0.0f);

    const auto e = light_.sample_emission(random_.next_2d(), random_.next_2d());
    const auto q = e ? landing(*e) : std::nullopt;
    const auto z0 = q ? light_.endpoint(*e, *q) : std::nullopt;
    const float distance = z0 ? glm::length(*q - *z0) : 0.0f;
    const float tint = z0 ? light_.tint(*z0, e->direction, distance).x : 0.0f;
    emitted.add(z0 ? e->weight.x * tint : 0.0f);  // over an area of 1
  }
  EXPECT_TRUE(GetParam().nee ? agree(nee, emitted) : nee.mean() == 0);
  EXPECT_TRUE(GetParam().hittable ? agree(hit, emitted) : hit.mean() == 0);
  EXPECT_LT(emitted.error(), 0.02 * emitted.mean());  // so that it means something
  if (!GetParam().nee) {
    EXPECT_NEAR(emitted.mean(), 2 * kPi, 0.03 * 2 * kPi);  // E = pi L
  }
}

// The density that a hit reports is that of next event estimation: it integrates to 1 over the
// directions in which the light is seen, and sampled directions find the same value.
TEST_P(Lights, DensityOfIlluminationAgrees) {
  if (!GetParam().nee || !GetParam().hittable) {
    GTEST_SKIP() << "one description only";
  }
  Mean integral;
  for (int i = 0; i < 400000; ++i) {
    const vec3 p(0.1f, -0.2f, 0);
    const auto h = hit_light(*scene_, Ray{p, random_.direction()});
    integral.add(h ? pdf_illumination(p, *h) * 4 * kPi : 0.0f);
  }
  if (GetParam().whole) {
    EXPECT_LT(std::abs(z_score(integral, 1.0)), 4.0) << integral.mean();
  }
  int compared = 0, missed = 0;
  for (int i = 0; i < 10000; ++i) {
    const vec3 p = receiver_point(random_);
    const auto s = illuminate(p);
    if (!s) {
      continue;
    }
    const auto h = hit_light(*scene_, Ray{p, s->wi});
    if (!h) {
      ++missed;  // rounding at the rim
      continue;
    }
    ++compared;
    EXPECT_NEAR(pdf_illumination(p, *h) / s->pdf_solid, 1, 1e-3);
    EXPECT_NEAR(h->radiance.x / s->radiance.x, 1, 1e-3);
    EXPECT_NEAR(h->emission.value / s->emission.value, 1, 1e-3);
  }
  EXPECT_GT(compared, 100);
  EXPECT_LT(missed, 10);
}

// The weights of a light path use the NEE density at the receiver that the ray reached.
TEST_P(Lights, EmittedRaysKnowTheDensityOfIllumination) {
  int compared = 0, unlike = 0;
  for (int i = 0; i < 300000 && GetParam().hittable && GetParam().nee; ++i) {
    const auto e = light_.sample_emission(random_.next_2d(), random_.next_2d());
    const auto p = e ? landing(*e) : std::nullopt;
    const auto z0 = p ? light_.endpoint(*e, *p) : std::nullopt;
    const auto h = z0 ? hit_light(*scene_, Ray{*p, normalize(*z0 - *p)}) : std::nullopt;
    if (h) {
      ++compared;
      const double nee = light_.pdf_illumination(*e, *z0, *p) / h->pdf_illumination;
      const double emission = e->density.value / h->emission.value;
      unlike += std::abs(nee - 1) > 1e-3 || std::abs(emission - 1) > 1e-3;
    }
  }
  EXPECT_EQ(compared > 100, GetParam().hittable && GetParam().nee);
  EXPECT_LE(unlike, compared / 10000);  // rounding at the edge of a picture's cell
}

// Sampled directions follow the density that a hit reports.
TEST_P(Lights, IlluminationFitsItsDensity) {
  if (!GetParam().nee || !GetParam().hittable) {
    GTEST_SKIP() << "one description only";
  }
  const vec3 p(0.1f, -0.2f, 0);
  const SphereCells cells{40, 40};
  std::vector<double> counts(cells.size(), 0.0);
  const int n = 20000;
  for (int i = 0; i < n; ++i) {
    if (const auto s = illuminate(p)) {
      ++counts[cells.cell(s->wi)];
    }
  }
  auto expected = cells.integrate(
      [&](vec3 d) {
        const auto h = hit_light(*scene_, Ray{p, d});
        return h ? pdf_illumination(p, *h) : 0.0f;
      },
      28);
  for (double& e : expected) {
    e *= n;
  }
  EXPECT_LT(chi_square_z(counts, expected), 4.0);
}

// So do the directions of emitted rays.
TEST_P(Lights, EmissionFitsItsDensity) {
  if (!GetParam().projected) {
    GTEST_SKIP() << "not of a simple shape";
  }
  const vec3 center = light_.emitters()[0].bounds.center();
  const auto density = [&](vec3 d) {
    if (!GetParam().hittable) {
      const auto s = light_.sample_illumination(center + d, 0, vec2(0.5f));
      return s ? s->emission.value : 0.0f;
    }
    const auto h = hit_light(*scene_, Ray{light_.infinite() ? vec3(0.0f) : center + 9.0f * d, -d});
    return h ? h->emission.value : 0.0f;
  };
  const SphereCells cells{24, 24};
  std::vector<double> counts(cells.size(), 0.0);
  const int n = 30000;
  for (int i = 0; i < n; ++i) {
    if (const auto e = light_.sample_emission(random_.next_2d(), random_.next_2d())) {
      ++counts[cells.cell(e->direction)];
    }
  }
  auto expected = cells.integrate([&](vec3 d) { return density(d) * GetParam().projected(d); }, 44);
  for (double& e : expected) {
    e *= n;
  }
  EXPECT_LT(chi_square_z(counts, expected), 4.0);
}

INSTANTIATE_TEST_SUITE_P(Kinds, Lights, ::testing::ValuesIn(kLightCases),
                         [](const auto& info) { return info.param.name; });

// --- Known values ---

double irradiance(const LightDesc& desc, vec3 p) {
  const auto scene = around().light("lamp", desc).build();
  Random random(10);
  Mean sum;
  for (int i = 0; i < 100000; ++i) {
    const auto s = scene->lights[0]->sample_illumination(p, 0, random.next_2d());
    sum.add(s ? std::max(0.0f, s->wi.z) * s->radiance.x / s->pdf_solid : 0.0f);
  }
  return sum.mean();
}

// Under a facing disk of radius R at height h: E = pi L R^2 / (R^2 + h^2).
TEST(LightValues, DiskAndSphere) {
  LightDesc disk = area_light({0, 0, 1}, {0, 0, 0}, 0.8f, 5);
  disk.shape = AreaShape::Disk;
  EXPECT_NEAR(irradiance(disk, vec3(0)) / (5 / (kPiD * 0.16) * 0.16 / 1.16), 1, 0.003);
  // A sphere gives what its centre would give: E = I / d^2 = P / (4 pi d^2).
  const LightDesc sphere = point_light({0, 0, 1}, 5, 0.4f, false);
  EXPECT_NEAR(irradiance(sphere, vec3(0)) / (5 / (4 * kPiD)), 1, 0.003);
}

// A point light's intensity, whatever the size of the beam, its blend and (on the axis, far away)
// its radius.
TEST(LightValues, SpotOnItsAxis) {
  for (const float radius : {0.0f, 0.1f}) {
    for (const float blend : {0.0f, 0.5f, 1.0f}) {
      const LightDesc desc = spot_light({0, 0, 20}, {0, 0, 0}, 5, 0.7f, blend, radius);
      EXPECT_NEAR(irradiance(desc, vec3(0)) / (5 / (4 * kPiD * 400)), 1, 2e-3) << radius << blend;
    }
  }
}

// Smoothstep over the cosine, from the edge inwards.
TEST(LightValues, SpotBlend) {
  const double edge = std::cos(0.35), inner = edge + 0.5 * (1 - edge);
  for (const double angle : {0.1, 0.2, 0.3, 0.34, 0.36}) {
    const double t = std::clamp((std::cos(angle) - edge) / (inner - edge), 0.0, 1.0);
    const double expected = 5 / (4 * kPiD) * t * t * (3 - 2 * t);
    const LightDesc desc = spot_light({0, 0, 1}, {0, 0, 0}, 5, 0.7f, 0.5f);
    const double x = std::tan(angle), cosine = std::cos(angle);
    const double e = irradiance(desc, vec3(x, 0, 0));
    EXPECT_NEAR(e / (cosine * cosine * cosine), expected, 1e-5) << angle;
  }
}

// The strength of a sun is the irradiance of a surface that faces it.
TEST(LightValues, Sun) {
  for (const float angle : {0.0f, 1e-6f, 0.00918f, 0.2f, 1.0f, kPi}) {
    EXPECT_NEAR(irradiance(sun_light({0, 0, 1}, 3, angle), vec3(0)), 3, 0.01) << angle;
  }
  LightDesc plain = sun_light({0, 0, 1}, 3, 0.2f);
  plain.normalize = false;  // the strength is the radiance
  EXPECT_NEAR(irradiance(plain, vec3(0)), 3 * kPiD * 0.00996671, 1e-3);
}

// Within a sphere light its radiance comes from all around, and light paths go there.
TEST(LightValues, InsideOfASphere) {
  const double radiance = 5 / (4 * kPiD * kPiD);
  for (LightDesc desc : {point_light({0, 0, 0.5f}, 5, 1, false),
                         spot_light({0, 0, 0.5f}, {0, 0, 0}, 5, 0.5f, 0.1f, 1, false)}) {
    const auto scene = SceneKit().light("lamp", desc).add("floor", plane(0.4f, 0.4f), {}).build();
    const Light& light = *scene->lights[0];
    Random random(11);
    Mean nee, hit, emitted;
    for (int i = 0; i < 200000; ++i) {
      const vec3 p(0.4f * (random.next_2d() - 0.5f), 1e-3f);
      const auto s = light.sample_illumination(p, 0, random.next_2d());
      nee.add(s ? std::max(0.0f, s->wi.z) * s->radiance.x / s->pdf_solid : 0.0f);
      const vec3 d = random.direction();
      const auto h = light.intersect(Ray{p, d});
      ASSERT_TRUE(h);
      hit.add(std::max(0.0f, d.z) * h->radiance.x * 4 * kPi);
      EXPECT_FLOAT_EQ(h->pdf_illumination, 0.25f * kInvPi);
      const auto e = light.sample_emission(random.next_2d(), random.next_2d());
      const auto surface = e ? scene->intersect(Ray{e->origin, e->direction}) : std::nullopt;
      const bool lands = surface && e->direction.z < 0 && light.endpoint(*e, surface->p);
      emitted.add(lands ? e->weight.x / 0.16f : 0.0f);
    }
    EXPECT_NEAR(hit.mean() / (kPiD * radiance), 1, 0.02);
    EXPECT_TRUE(agree(nee, hit));
    EXPECT_TRUE(agree(emitted, hit));
  }
}

// A picture of one colour is a world of that colour, all around and over the poles.
TEST(LightValues, ConstantImage) {
  Image image(6, 3, 4);
  std::fill(image.pixels.begin(), image.pixels.end(), 0.7f);
  const auto scene = around().world(image, 2).build();
  const Light& light = *scene->lights.at(0);
  Random random(12);
  for (int i = 0; i < 1000; ++i) {
    const auto h = light.intersect(Ray{vec3(0), i == 0 ? vec3(0, 0, 1) : random.direction()});
    ASSERT_TRUE(h);
    EXPECT_FLOAT_EQ(h->radiance.x, 1.4f);
    EXPECT_NEAR(h->pdf_illumination * 4 * kPi, 1, 1e-4);
  }
  EXPECT_NEAR(light.power() / (1.4 * 4 * kPiD * 0.25 * 2 * of_scene(vec3(1))), 1, 1e-4);
}

}  // namespace
}  // namespace janus::test
