// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/shading/hair.h"

#include <gtest/gtest.h>

#include "shading/lobes.h"

namespace janus::test {
namespace {

using enum TransportMode;

const vec3 kAlong = normalize(vec3(1.0f, 0.2f, 0.0f));  // across kNg

std::vector<Lobe> chiang(const ChiangHair& hair) {
  return {chiang_lobe(LobeType::ChiangReflection, Rgb(1.0f), kAlong, hair),
          chiang_lobe(LobeType::ChiangRest, Rgb(1.0f), kAlong, hair)};
}

struct FiberCase {
  const char* name;
  std::vector<Lobe> lobes;
};

const FiberCase kCases[] = {
    {"reflection", {hair_lobe(false, Rgb(0.8f), kAlong, 0.2f, 0.7f, 0.05f)}},
    {"transmission", {hair_lobe(true, Rgb(0.8f), kAlong, 0.3f, 0.4f, -0.1f)}},
    {"chiang", chiang({Rgb(0.2f, 0.5f, 1.3f), 0.4f, 0.5f, 0.3f, 1.55f, 0.05f})},
    {"chiang_wide", chiang({Rgb(0.1f), 0.9f, 0.9f, 0.0f, 1.3f, 0.0f})},
    {"chiang_dark", chiang({Rgb(8.0f), 0.3f, 0.3f, 0.0f, 1.55f, 0.03f})},
    {"all",
     {hair_lobe(false, Rgb(0.2f), kAlong, 0.2f, 0.7f, 0.0f),
      hair_lobe(true, Rgb(0.3f), kAlong, 0.3f, 0.4f, 0.0f),
      chiang_lobe(LobeType::ChiangRest, Rgb(0.5f), kAlong, {Rgb(0.3f), 0.5f, 0.5f}),
      diffuse_lobe(Rgb(0.4f))}},
};

std::ostream& operator<<(std::ostream& out, const FiberCase& c) { return out << c.name; }

const vec3 kFrom[] = {normalize(vec3(0.3f, 0.2f, 1)), normalize(vec3(-1, 0.4f, 0.3f)),
                      normalize(vec3(0.1f, 0.9f, 0.2f))};

class Fibers : public ::testing::TestWithParam<FiberCase> {
 protected:
  Fibers() { storage_.set_kind(VertexKind::OneWay); }
  Bsdf storage_ = make(GetParam().lobes);
  BsdfView bsdf() const { return storage_.view(kNg); }
  Random random_{7};
};

TEST_P(Fibers, SamplesFollowTheDensity) {
  const SphereCells cells{12, 12};
  for (const vec3 from : kFrom) {
    std::vector<double> counts(cells.size());
    const int count = samples(25000);
    for (int i = 0; i < count; ++i) {
      const auto s = bsdf().sample(from, random_.next(), random_.next_2d(), Radiance);
      if (s) {
        ++counts[cells.cell(s->direction)];
      }
    }
    auto expected =
        cells.integrate([&](vec3 to) { return bsdf().pdf_solid(from, to, Radiance); }, 48);
    double total = 0;
    for (double& e : expected) {
      total += e;
      e *= count;
    }
    EXPECT_LT(chi_square_z(counts, expected), 4.0) << from.x;
    EXPECT_GT(total, 0.3);
    EXPECT_LT(total, 1.01);
  }
}

TEST_P(Fibers, SamplesAgreeWithTheFunctions) {
  int drawn = 0;
  for (int i = 0; i < 1000; ++i) {
    const vec3 from = random_.direction();
    const auto s = bsdf().sample(from, random_.next(), random_.next_2d(), Radiance);
    if (!s) {
      continue;
    }
    ++drawn;
    const BsdfEval e = bsdf().evaluate(from, s->direction, Radiance);
    EXPECT_TRUE(is_finite(s->weight));
    EXPECT_FLOAT_EQ(s->pdf_solid, e.pdf_radiance);
    EXPECT_LE(glm::length(s->weight - e.f / s->pdf_solid), 1e-4f * glm::length(s->weight));
    EXPECT_NEAR(glm::length(s->direction), 1.0f, 1e-4f);
  }
  EXPECT_GT(drawn, 300);
}

// Light walks end here: they draw nothing, and their density is nought.
TEST_P(Fibers, AreForCameraWalksAlone) {
  for (int i = 0; i < 200; ++i) {
    const vec3 a = random_.direction(), b = random_.direction();
    EXPECT_EQ(bsdf().pdf_solid(a, b, Importance), 0.0f);
    EXPECT_FALSE(bsdf().sample(a, random_.next(), random_.next_2d(), Importance));
    const auto s = bsdf().sample(a, random_.next(), random_.next_2d(), Radiance);
    EXPECT_TRUE(!s || s->pdf_reverse == 0.0f);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, Fibers, ::testing::ValuesIn(kCases),
                         [](const auto& info) { return std::string(info.param.name); });

// Where nothing is absorbed, all light comes out again, wherever the fibre is hit.
TEST(ChiangHair, KeepsEnergy) {
  for (const float roughness : {0.2f, 0.5f, 0.9f}) {
    for (const vec3 from : kFrom) {
      const Bsdf lobes = make(chiang({Rgb(0.0f), roughness, roughness, 0.0f, 1.55f, 0.0f}));
      EXPECT_NEAR(albedo(lobes.view(kNg), from, 40000).mean(), 1.0, 0.02) << roughness;
    }
  }
}

TEST(ChiangHair, CoatNarrowsReflectionsAlone) {
  const auto peak = [](LobeType type, float coat) {
    const ChiangHair hair{Rgb(0.2f), 0.5f, 0.5f, coat, 1.55f, 0.0f};
    const Bsdf bsdf = make({chiang_lobe(type, Rgb(1.0f), vec3(1, 0, 0), hair)});
    return bsdf.view(kNg).eval_cos(normalize(vec3(0.5f, 0, 1)), normalize(vec3(-0.5f, 0, 1))).x;
  };
  EXPECT_GT(peak(LobeType::ChiangReflection, 0.8f), 2 * peak(LobeType::ChiangReflection, 0.0f));
  EXPECT_EQ(peak(LobeType::ChiangRest, 0.8f), peak(LobeType::ChiangRest, 0.0f));
}

// Scales turn reflections away from the mirror direction, by twice their tilt.
TEST(ChiangHair, ScalesTiltReflections) {
  const float tilt = 0.1f;
  const Bsdf bsdf = make({chiang_lobe(LobeType::ChiangReflection, Rgb(1.0f), vec3(1, 0, 0),
                                      {Rgb(0.2f), 0.1f, 0.1f, 0.0f, 1.55f, tilt})});
  float best = 0.0f, at = 0.0f;
  for (float angle = -0.6f; angle < 0.6f; angle += 0.01f) {
    const float f = bsdf.view(kNg).eval_cos(kNg, vec3(std::sin(angle), 0, std::cos(angle))).x;
    if (f > best) {
      best = f;
      at = angle;
    }
  }
  EXPECT_NEAR(std::abs(at), 2 * tilt, 0.02f);
}

TEST(ChiangHair, AbsorptionOfItsColor) {
  // White hair absorbs nothing, and more pigment absorbs more, blue most.
  EXPECT_EQ(absorption_of_color(Rgb(1.0f), 0.3f), Rgb(0.0f));
  const Rgb little = absorption_of_melanin(0.5f, 0.0f), much = absorption_of_melanin(2.0f, 0.0f);
  EXPECT_LT(little.x, much.x);
  EXPECT_LT(much.x, much.z);
}

}  // namespace
}  // namespace janus::test
