// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/shading/bsdf.h"

#include <gtest/gtest.h>

#include "janus/shading/fresnel.h"
#include "support/statistics.h"

namespace janus::test {
namespace {

using enum TransportMode;

struct BsdfCase {
  const char* name;
  std::vector<Lobe> lobes;
  float smooth;  // probability of the lobes that are not deltas
};

const vec3 kNg(0, 0, 1);
const vec3 kTilted = normalize(vec3(0.5f, -0.3f, 1));

const BsdfCase kCases[] = {
    {"diffuse", {{LobeType::Diffuse, Rgb(0.8f), kNg, 1, 0}}, 1},
    {"diffuse_tilted", {{LobeType::Diffuse, Rgb(0.8f), kTilted, 1, 0}}, 1},
    {"two_normals",
     {{LobeType::Diffuse, Rgb(0.3f), kTilted, 1, 0}, {LobeType::Diffuse, Rgb(0.5f), kNg, 1, 0}},
     1},
    {"mixture",
     {{LobeType::Diffuse, Rgb(0.6f), kNg, 1, 0},
      {LobeType::Mirror, Rgb(0.1f), kNg, 1, 0},
      {LobeType::Dielectric, Rgb(0.3f), kNg, 1.5f, 0}},
     0.6f},
};

std::ostream& operator<<(std::ostream& out, const BsdfCase& c) { return out << c.name; }

Bsdf make(const std::vector<Lobe>& lobes) {
  Bsdf bsdf;
  for (const Lobe& lobe : lobes) {
    EXPECT_TRUE(bsdf.add(lobe));
  }
  bsdf.finish();
  return bsdf;
}

Bsdf one(LobeType type, float ior = 1.5f, vec3 normal = kNg) {
  return make({{type, Rgb(1), normal, ior, 0}});
}

class Bsdfs : public ::testing::TestWithParam<BsdfCase> {
 protected:
  const Bsdf storage_ = make(GetParam().lobes);
  const BsdfView bsdf_ = storage_.view(kNg);
  Random random_{11};
};

float pdf(const BsdfView& bsdf, vec3 from, vec3 to, TransportMode mode) {
  return mode == Radiance ? bsdf.pdf_solid(from, to, mode) : bsdf.pdf_solid(to, from, mode);
}
Rgb eval(const BsdfView& bsdf, vec3 from, vec3 to, TransportMode mode) {
  return mode == Radiance ? bsdf.eval(from, to, mode) : bsdf.eval(to, from, mode);
}

TEST_P(Bsdfs, SamplesFollowTheDensity) {
  const SphereCells cells{12, 12};
  for (const TransportMode mode : {Radiance, Importance}) {
    for (const vec3 from : {normalize(vec3(0.3f, 0.2f, 1)), normalize(vec3(-1, 0.4f, 0.3f)),
                            normalize(vec3(0.2f, 0.7f, -0.8f))}) {
      std::vector<double> counts(cells.size());
      constexpr int kCount = 100000;
      for (int i = 0; i < kCount; ++i) {
        const auto s = bsdf_.sample(from, random_.next(), random_.next_2d(), mode);
        if (s && !s->delta) {
          ++counts[cells.cell(s->direction)];
          // What a sample says about itself is what the functions say.
          EXPECT_FLOAT_EQ(s->pdf_solid, pdf(bsdf_, from, s->direction, mode));
          EXPECT_FLOAT_EQ(s->pdf_reverse,
                          pdf(bsdf_, s->direction, from, mode == Radiance ? Importance : Radiance));
          EXPECT_NEAR(s->weight.x, eval(bsdf_, from, s->direction, mode).x / s->pdf_solid,
                      1e-4 * s->weight.x);
        }
      }
      auto expected = cells.integrate([&](vec3 to) { return pdf(bsdf_, from, to, mode); });
      double total = 0;
      for (double& e : expected) {
        total += e;
        e *= kCount;
      }
      EXPECT_LT(chi_square_z(counts, expected), 4.0)
          << from.x << ", light walk " << (mode == Importance);
      // A shading normal can leave the lobe, or a part of it, without light.
      EXPECT_LT(total, GetParam().smooth + 2e-3);
      if (GetParam().lobes[0].normal == kNg) {
        EXPECT_NEAR(total, GetParam().smooth, 2e-3);
      }
    }
  }
}

// Veach's rule for shading normals, and reciprocity of both walks' densities with their names.
TEST_P(Bsdfs, AdjointFactor) {
  for (int i = 0; i < 2000; ++i) {
    const vec3 wo = random_.direction(), wi = random_.direction();
    const Rgb radiance = bsdf_.eval(wo, wi, Radiance), importance = bsdf_.eval(wo, wi, Importance);
    EXPECT_EQ(radiance, bsdf_.eval_cos(wo, wi));
    EXPECT_NEAR(importance.x * std::abs(wi.z), radiance.x * std::abs(wo.z), 1e-5);
    // Whatever has a value can be drawn by both walks.
    EXPECT_EQ(radiance.x > 0, bsdf_.pdf_solid(wo, wi, Radiance) > 0);
    EXPECT_EQ(radiance.x > 0, bsdf_.pdf_solid(wo, wi, Importance) > 0);
    EXPECT_TRUE(wo.z * wi.z > 0 || is_black(radiance));  // closed surfaces do not leak
  }
}

TEST_P(Bsdfs, MixesSumToTheirLobes) {
  const vec3 wo = normalize(vec3(0.1f, 0.2f, 1)), wi = normalize(vec3(-0.2f, 0.4f, 0.9f));
  Rgb sum(0);
  float total = 0;
  for (const Lobe& lobe : bsdf_.lobes()) {
    sum += make({lobe}).view(kNg).eval_cos(wo, wi);
    total += lobe.pmf;
  }
  EXPECT_NEAR(sum.x, bsdf_.eval_cos(wo, wi).x, 1e-6);
  EXPECT_FLOAT_EQ(total, 1);
}

INSTANTIATE_TEST_SUITE_P(Cases, Bsdfs, ::testing::ValuesIn(kCases),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(Diffuse, WhiteReflectsEverything) {
  const Bsdf white = one(LobeType::Diffuse);
  Random random(12);
  for (int i = 0; i < 1000; ++i) {
    for (const TransportMode mode : {Radiance, Importance}) {
      const auto s =
          white.view(kNg).sample(random.direction(), random.next(), random.next_2d(), mode);
      ASSERT_TRUE(s);
      EXPECT_NEAR(s->weight.x, 1, 1e-5);
    }
  }
}

TEST(Delta, IsNotConnectible) {
  EXPECT_FALSE(one(LobeType::Mirror).view(kNg).connectible());
  EXPECT_FALSE(one(LobeType::Dielectric).view(kNg).connectible());
  EXPECT_TRUE(make(kCases[3].lobes).view(kNg).connectible());
  EXPECT_EQ(one(LobeType::Mirror).view(kNg).pdf_solid(kNg, kNg, Radiance), 0.0f);
}

TEST(Mirror, Reflects) {
  const Bsdf bsdf = one(LobeType::Mirror);
  for (const float side : {1.0f, -1.0f}) {
    const vec3 from = normalize(vec3(0.3f, 0.4f, side));
    const auto s = bsdf.view(kNg).sample(from, 0.5f, vec2(0.5f), Radiance);
    ASSERT_TRUE(s && s->delta);
    EXPECT_NEAR(glm::length(s->direction - vec3(-from.x, -from.y, from.z)), 0, 1e-6);
    EXPECT_FLOAT_EQ(s->weight.x, 1);
  }
}

// Snell's and Fresnel's laws, the share of each event, and eta^2: radiance as in Cycles carries no
// such factor, light walks gain (eta on the light's side / eta on the camera's side)^2.
TEST(Dielectric, SnellFresnelAndEta) {
  Random random(13);
  for (const float ior : {1.5f, 1.0f / 1.5f, 1.33f}) {
    const Bsdf storage = one(LobeType::Dielectric, ior);
    const BsdfView bsdf = storage.view(kNg);
    for (int n = 0; n < 200; ++n) {
      const vec3 from = random.direction();
      const float eta = from.z > 0 ? ior : 1 / ior;  // index of the other side
      const float f = fresnel_dielectric(std::abs(from.z), eta);
      for (const TransportMode mode : {Radiance, Importance}) {
        Mean reflected;
        for (int i = 0; i < 200; ++i) {
          const auto s = bsdf.sample(from, random.next(), vec2((i + 0.5f) / 200, 0.5f), mode);
          ASSERT_TRUE(s && s->delta);
          const bool reflection = s->direction.z * from.z > 0;
          reflected.add(reflection);
          EXPECT_NEAR(length2(s->direction), 1, 1e-5);
          if (reflection) {
            EXPECT_NEAR(s->weight.x, 1, 1e-5);
            EXPECT_NEAR(s->pdf_solid, f, 1e-5);
            EXPECT_EQ(s->eta_scale, 1.0f);
            continue;
          }
          const vec2 sines = vec2(s->direction) * eta + vec2(from);
          EXPECT_NEAR(glm::length(sines), 0, 1e-4);
          const float gain = mode == Radiance ? 1.0f : 1 / (eta * eta);
          EXPECT_NEAR(s->weight.x, gain, 1e-3 * gain);
          EXPECT_NEAR(s->eta_scale, gain, 1e-5);
          // The way back has the same Fresnel factor. The two densities are of one delta in the
          // solid angles of both sides: n^2 cos domega is invariant.
          const float there_over_back = eta * eta * std::abs(s->direction.z / from.z);
          EXPECT_NEAR(s->pdf_reverse / s->pdf_solid * there_over_back, 1, 1e-3);
        }
        EXPECT_NEAR(reflected.mean(), f, 0.006);
      }
    }
  }
}

TEST(Fresnel, KnownValues) {
  EXPECT_NEAR(fresnel_dielectric(1, 1.5f), 0.04, 1e-6);
  EXPECT_NEAR(fresnel_dielectric(1, 1 / 1.5f), 0.04, 1e-6);
  EXPECT_NEAR(fresnel_dielectric(0, 1.5f), 1, 1e-6);
  EXPECT_EQ(fresnel_dielectric(0.5f, 1 / 1.5f), 1.0f);  // total reflection
  EXPECT_FALSE(refract_through(normalize(vec3(1, 0, 0.5f)), kNg, 1 / 1.5f));
}

// A shading normal never sends an event to the wrong side of the surface.
TEST(Delta, RespectsTheGeometricSide) {
  Random random(14);
  for (const LobeType type : {LobeType::Mirror, LobeType::Dielectric}) {
    const Bsdf storage = one(type, 1.5f, kTilted);
    for (int i = 0; i < 5000; ++i) {
      const vec3 from = random.direction();
      const auto s = storage.view(kNg).sample(from, random.next(), random.next_2d(), Radiance);
      if (s && type == LobeType::Mirror) {
        EXPECT_GT(s->direction.z * from.z, 0);
      }
      EXPECT_TRUE(!s || is_finite(s->weight));
    }
  }
}

}  // namespace
}  // namespace janus::test
