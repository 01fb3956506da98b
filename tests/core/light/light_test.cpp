// SPDX-License-Identifier: GPL-3.0-or-later
//
// A light has three descriptions: as a target of next event estimation, as something that rays
// hit, and as a source of rays. They must tell of the same radiance and of the same densities.
#include "janus/light/light.h"

#include <gtest/gtest.h>

#include "support/scene_kit.h"
#include "support/statistics.h"

namespace janus::test {
namespace {

struct LightCase {
  std::string name;
  SceneKit (*make)();
  double watts;          // emitted; 0: not compared
  bool hittable = true;  // false: a point
  bool nee = true;       // false: the world
  bool whole = true;     // shines over all of its surface towards the receiver
};

// The receiver, a square of side 1 at the origin with normal +z, is not part of the scene.
SceneKit lamp(LightDesc desc) { return SceneKit().light("lamp", std::move(desc)); }

LightDesc shaped(AreaShape shape, const mat4& deform, float spread = kPi) {
  LightDesc desc = area_light({0.3f, -0.2f, 1.2f}, {0, 0, 0}, 0.6f, 7, spread);
  desc.shape = shape;
  desc.size_y = 0.3f;
  desc.transform = desc.transform * deform;
  return desc;
}

const LightCase kCases[] = {
    {"point", [] { return lamp(point_light({0.2f, 0.1f, 1}, 7)); }, 7, false},
    {"point_soft", [] { return lamp(point_light({0.2f, 0.1f, 1}, 7, 0.3f)); }, 7},
    {"point_sphere", [] { return lamp(point_light({0.2f, 0.1f, 1}, 7, 0.3f, false)); }, 7},
    {"square", [] { return lamp(shaped(AreaShape::Square, mat4(1))); }, 7},
    {"rectangle_scaled",
     [] { return lamp(shaped(AreaShape::Rectangle, scaling({2, -0.7f, 1.5f}))); }, 7},
    {"disk", [] { return lamp(shaped(AreaShape::Disk, mat4(1))); }, 7},
    {"ellipse_scaled", [] { return lamp(shaped(AreaShape::Ellipse, scaling({1, 3, 1}))); }, 7},
    {"sheared",  // as under a parent that is scaled unevenly
     [] {
       mat4 shear(1);
       shear[1][0] = 0.5f;
       return lamp(shaped(AreaShape::Rectangle, shear));
     },
     7},
    {"sheared_axis",  // the light's axis is not perpendicular to it
     [] {
       mat4 shear(1);
       shear[2][0] = 0.4f;
       return lamp(shaped(AreaShape::Rectangle, shear));
     },
     7},
    {"spread", [] { return lamp(shaped(AreaShape::Square, mat4(1), 1.0f)); }, 7, true, true, false},
    {"narrow_spread", [] { return lamp(shaped(AreaShape::Disk, mat4(1), 0.3f)); }, 7, true, true,
     false},
    {"mesh",  // both sides of 0.4 * 0.5 * 1.5 m^2 shine with pi L
     [] {
       return SceneKit().add(
           "lamp", plane(0.4f, 0.5f), emission(Rgb(1), 3),
           translation({0.1f, 0.2f, 0.9f}) * rotation({1, 2, 0}, 2.5f) * scaling({-1, 1.5f, 1}));
     },
     2 * 0.4 * 0.5 * 1.5 * 3 * 3.14159265},
    {"world",  // geometry below the receiver sets the extent of the scene
     [] {
       return SceneKit().add("floor", plane(3, 3), {}, translation({0, 0, -0.1f})).world(Rgb(2));
     },
     0, true, false},
};

std::ostream& operator<<(std::ostream& out, const LightCase& c) { return out << c.name; }

std::optional<LightHit> hit_light(const Scene& scene, const Ray& ray) {
  const auto surface = scene.intersect(ray);
  if (surface) {
    size_t index;
    const MeshLight* mesh = scene.mesh_light(*surface, index);
    return mesh ? std::optional(
                      mesh->at(*surface, ray.origin, ray.direction, scene.shade(*surface).emission))
                : std::nullopt;
  }
  return scene.lights[0]->intersect(ray);
}

vec3 receiver_point(Random& random) { return vec3(random.next_2d() - 0.5f, 0); }

// Where an emitted ray meets the receiver from above.
std::optional<vec3> landing(const EmissionSample& e) {
  const vec3 p = e.origin - e.direction * (e.origin.z / e.direction.z);
  const bool inside = std::abs(p.x) < 0.5f && std::abs(p.y) < 0.5f;
  return e.direction.z < 0 && e.origin.z > 0 && inside ? std::optional(p) : std::nullopt;
}

class Lights : public ::testing::TestWithParam<LightCase> {
 protected:
  const std::shared_ptr<const Scene> scene_ = GetParam().make().build();
  const Light& light_ = *scene_->lights.at(0);
  Random random_{9};
};

TEST_P(Lights, EmitsItsPower) {
  if (GetParam().watts > 0) {
    EXPECT_NEAR(light_.power() / GetParam().watts, 1, 1e-4);
  }
  Mean watts;
  for (int i = 0; i < 200000; ++i) {
    const auto e = light_.sample_emission(random_.next_2d(), random_.next_2d());
    watts.add(e ? luminance(e->weight) : 0.0f);
  }
  EXPECT_NEAR(watts.mean() / light_.power(), 1, 0.003 + 4 * watts.error() / light_.power());
}

TEST_P(Lights, IrradianceAgrees) {
  Mean nee, hit, emitted;
  for (int i = 0; i < samples(400000); ++i) {
    const vec3 p = receiver_point(random_);
    if (const auto s = light_.sample_illumination(p, random_.next_2d())) {
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
    emitted.add(q && light_.endpoint(*e, *q) ? e->weight.x : 0.0f);  // flux over an area of 1
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
    integral.add(h ? h->pdf_illumination * 4 * kPi : 0.0f);
  }
  if (GetParam().whole) {
    EXPECT_LT(std::abs(z_score(integral, 1.0)), 4.0) << integral.mean();
  }
  int compared = 0, missed = 0;
  for (int i = 0; i < 10000; ++i) {
    const vec3 p = receiver_point(random_);
    const auto s = light_.sample_illumination(p, random_.next_2d());
    if (!s) {
      continue;
    }
    const auto h = hit_light(*scene_, Ray{p, s->wi});
    if (!h) {
      ++missed;  // rounding at the rim
      continue;
    }
    ++compared;
    EXPECT_NEAR(h->pdf_illumination / s->pdf_solid, 1, 1e-3);
    EXPECT_NEAR(h->radiance.x / s->radiance.x, 1, 1e-3);
    EXPECT_NEAR(h->emission.value / s->emission.value, 1, 1e-3);
  }
  EXPECT_GT(compared, 100);
  EXPECT_LT(missed, 10);
}

// The weights of a light path use the NEE density at the receiver that the ray reached.
TEST_P(Lights, EmittedRaysKnowTheDensityOfIllumination) {
  int compared = 0;
  for (int i = 0; i < 300000 && GetParam().hittable && GetParam().nee; ++i) {
    const auto e = light_.sample_emission(random_.next_2d(), random_.next_2d());
    const auto p = e ? landing(*e) : std::nullopt;
    const auto z0 = p ? light_.endpoint(*e, *p) : std::nullopt;
    const auto h = z0 ? hit_light(*scene_, Ray{*p, normalize(*z0 - *p)}) : std::nullopt;
    if (h) {
      ++compared;
      EXPECT_NEAR(light_.pdf_illumination(*e, *z0, *p) / h->pdf_illumination, 1, 1e-3);
      EXPECT_NEAR(e->density.value / h->emission.value, 1, 1e-3);
    }
  }
  EXPECT_EQ(compared > 100, GetParam().hittable && GetParam().nee);
}

INSTANTIATE_TEST_SUITE_P(Kinds, Lights, ::testing::ValuesIn(kCases),
                         [](const auto& info) { return info.param.name; });

// Under a facing disk of radius R at height h: E = pi L R^2 / (R^2 + h^2).
TEST(LightValues, DiskAndSphere) {
  LightDesc disk = area_light({0, 0, 1}, {0, 0, 0}, 0.8f, 5);
  disk.shape = AreaShape::Disk;
  const double disk_radiance = 5 / (3.14159265 * 3.14159265 * 0.16);
  // A sphere gives what its centre would give: E = I / d^2 = P / (4 pi d^2).
  for (const auto& [desc, expected] :
       {std::pair(disk, 3.14159265 * disk_radiance * 0.16 / 1.16),
        std::pair(point_light({0, 0, 1}, 5, 0.4f, false), 5 / (4 * 3.14159265))}) {
    const auto scene = SceneKit().light("lamp", desc).build();
    Random random(10);
    Mean irradiance;
    for (int i = 0; i < 200000; ++i) {
      const auto s = scene->lights[0]->sample_illumination(vec3(0), random.next_2d());
      irradiance.add(s ? s->wi.z * s->radiance.x / s->pdf_solid : 0.0f);
    }
    EXPECT_NEAR(irradiance.mean() / expected, 1, 0.003);
  }
}

TEST(LightSampler, ProbabilitiesSumToOne) {
  const auto scene = SceneKit()
                         .add("lamp", plane(1, 1), emission(Rgb(1), 1))
                         .light("a", point_light({0, 0, 1}, 1))
                         .light("b", point_light({0, 0, 2}, 1000))
                         .world(Rgb(1))
                         .build();
  ASSERT_EQ(scene->lights.size(), 4u);
  float emission = 0, illumination = 0;
  for (size_t i = 0; i < 4; ++i) {
    const LightSampler& sampler = scene->light_sampler;
    const bool infinite = scene->lights[i]->infinite();
    emission += sampler.pmf_emission(i);
    illumination += sampler.pmf_illumination(vec3(0), i);
    EXPECT_GT(sampler.pmf_emission(i), 0.0f);
    EXPECT_EQ(sampler.pmf_illumination(vec3(0), i) > 0.0f, !infinite);
  }
  EXPECT_FLOAT_EQ(emission, 1);
  EXPECT_FLOAT_EQ(illumination, 1);
}

}  // namespace
}  // namespace janus::test
