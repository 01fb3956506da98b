// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/shading/bsdf.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "janus/shading/fresnel.h"
#include "janus/shading/layers.h"
#include "shading/lobes.h"

namespace janus::test {
namespace {

using enum TransportMode;

struct BsdfCase {
  const char* name;
  std::vector<Lobe> lobes;
  bool delta = false;      // some lobe is a delta
  bool reciprocal = true;  // f(wo,wi) = f(wi,wo) up to (n_i/n_o)^2 of transmission
};

const Rgb kWhite(1);
const Lobe kLayer = specular_lobe(kWhite, 1.5f, 0.2f, true);

const FacetWidths kBrushed(0.5f, 0.15f, normalize(vec3(1, 0.4f, 0.2f)));
const Lobe kSheen = sheen_lobe(Rgb(0.5f, 0.4f, 0.6f), 0.4f, Rgb(0.5f, 0.4f, 0.6f));
const Lobe kCoat = coat_lobe(Rgb(0.7f), 1.6f, 0.15f, 0.7f, Rgb(0.9f, 0.5f, 0.3f));

const BsdfCase kCases[] = {
    {"diffuse", {diffuse_lobe(Rgb(0.8f))}},
    {"diffuse_tilted", {placed(diffuse_lobe(Rgb(0.8f)), kTilted)}},
    {"two_normals", {placed(diffuse_lobe(Rgb(0.3f)), kTilted), diffuse_lobe(Rgb(0.5f))}},
    {"oren_nayar", {oren_nayar_lobe(kWhite, Rgb(0.5f), 0.7f)}},
    {"oren_nayar_tilted", {placed(oren_nayar_lobe(kWhite, Rgb(0.9f), 1), kTilted)}},
    {"translucent", {translucent_lobe(Rgb(0.7f))}},
    {"translucent_tilted", {placed(translucent_lobe(Rgb(0.7f)), kTilted)}},
    {"rough_translucent", {rough_translucent_lobe(kWhite, Rgb(0.5f), 0.7f)}},
    {"rough_translucent_tilted", {placed(rough_translucent_lobe(kWhite, Rgb(0.9f), 1), kTilted)}},
    {"mirrored_glossy", {mirrored_glossy_lobe(Rgb(0.9f), 0.3f)}, false, false},
    {"mirrored_glossy_tilted",
     {placed(mirrored_glossy_lobe(Rgb(0.9f), 0.4f), kTilted)},
     false,
     false},
    {"glossy", {glossy_lobe(Rgb(0.9f), 0.3f)}},
    {"glossy_narrow", {glossy_lobe(Rgb(0.9f), 0.15f)}},
    {"glossy_tilted", {placed(glossy_lobe(Rgb(0.9f), 0.4f), kTilted)}},
    {"glossy_multiscatter", {glossy_lobe(kWhite, 0.6f, true)}, false, false},
    {"metal", {metal_lobe(kWhite, Rgb(0.9f, 0.6f, 0.3f), 0.3f, true)}, false, false},
    {"metal_edge", {metal_lobe(kWhite, Rgb(0.6f), 0.3f, false, Rgb(0.2f, 0.5f, 0.8f))}},
    {"conductor", {conductor_lobe(kWhite, Rgb(0.2f, 1, 3), Rgb(3.5f, 2, 0), 0.3f)}},
    {"beckmann", {with_beckmann(glossy_lobe(Rgb(0.9f), 0.4f))}},
    {"beckmann_brushed", {placed(with_beckmann(glossy_lobe(kWhite, kBrushed)), kTilted)}},
    {"beckmann_glass", {with_beckmann(glass_lobe(kWhite, Rgb(0.9f), true, 1.5f, 0.3f))}},
    {"beckmann_refraction", {with_beckmann(refraction_lobe(kWhite, 1.4f, 0.25f))}},
    {"film_metal", {with_film(metal_lobe(kWhite, Rgb(0.8f), 0.3f), 400, 1.4f)}},
    {"film_glass",  // a film looks thinner from within
     {with_film(glass_lobe(kWhite, Rgb(0.9f), true, 1.5f, 0.25f), 100, 2.4f)},
     false,
     false},
    {"ashikhmin_shirley", {ashikhmin_shirley_lobe(Rgb(0.9f), 0.3f)}},
    {"ashikhmin_shirley_rough", {ashikhmin_shirley_lobe(Rgb(0.9f), 1)}},
    {"ashikhmin_shirley_tilted", {placed(ashikhmin_shirley_lobe(kWhite, 0.4f), kTilted)}},
    {"ashikhmin_shirley_brushed", {ashikhmin_shirley_lobe(kWhite, kBrushed)}},
    {"ashikhmin_shirley_brushed_tilted",
     {placed(ashikhmin_shirley_lobe(kWhite, FacetWidths(0.2f, 0.6f, vec3(1, 0, 0))), kTilted)}},
    {"brushed", {glossy_lobe(Rgb(0.9f), kBrushed)}},
    {"brushed_tilted", {placed(glossy_lobe(Rgb(0.9f), kBrushed), kTilted)}},
    {"brushed_metal", {metal_lobe(kWhite, Rgb(0.8f), kBrushed, true)}, false, false},
    {"specular", {specular_lobe(kWhite, 1.5f, 0.25f)}},
    {"specular_tinted", {specular_lobe(kWhite, 1.5f, Rgb(0.1f, 0.04f, 0), 0.25f)}},
    {"sheen", {kSheen}, false, false},
    {"sheen_smooth", {sheen_lobe(kWhite, 0.25f)}, false, false},
    {"sheen_tilted", {placed(kSheen, kTilted)}, false, false},
    {"velvet", {velvet_lobe(Rgb(0.8f), 0.5f)}},
    {"toon", {toon_lobe(false, Rgb(0.8f), 0.4f, 0.2f)}, false, false},
    {"toon_tilted", {placed(toon_lobe(false, Rgb(0.8f), 0.8f, 0.4f), kTilted)}, false, false},
    {"glossy_toon", {toon_lobe(true, Rgb(0.8f), 0.5f, 0.3f)}, false, false},
    {"glass", {glass_lobe(kWhite, Rgb(0.9f), true, 1.5f, 0.2f)}},
    {"glass_tilted", {placed(glass_lobe(kWhite, Rgb(0.9f), true, 1.45f, 0.3f), kTilted)}},
    {"glass_multiscatter", {glass_lobe(kWhite, Rgb(0.8f), false, 1.33f, 0.5f, true)}, false, false},
    {"glass_tinted", {glass_lobe(kWhite, Rgb(0.9f), false, 1.5f, 0.2f, false, Rgb(2, 1, 0))}},
    {"glass_below_one", {glass_lobe(kWhite, kWhite, true, 0.7f, 0.25f)}},
    {"refraction", {refraction_lobe(kWhite, 1.45f, 0.2f)}},
    {"mixture",
     {diffuse_lobe(Rgb(0.6f)), glossy_lobe(Rgb(0.1f), 0),
      glass_lobe(Rgb(0.3f), kWhite, true, 1.5f, 0)},
     true},
    {"rough_mixture",
     {translucent_lobe(Rgb(0.2f)), glossy_lobe(Rgb(0.2f), 0.3f),
      placed(glass_lobe(Rgb(0.5f), kWhite, true, 1.5f, 0.25f), kTilted),
      refraction_lobe(Rgb(0.1f), 1.3f, 0)},
     true},
    {"both_sides_tilted",
     {placed(diffuse_lobe(Rgb(0.5f)), kTilted), placed(translucent_lobe(Rgb(0.5f)), kTilted)}},
    {"layered", {kLayer, below(diffuse_lobe(Rgb(0.8f)))}, false, false},
    {"coated", {kCoat, below(kLayer), below(diffuse_lobe(Rgb(0.8f)))}, false, false},
    {"all_covers",
     {kSheen, below(placed(kCoat, kTilted)), below(metal_lobe(Rgb(0.3f), Rgb(0.9f), kBrushed)),
      below(glass_lobe(Rgb(0.3f), Rgb(0.8f), false, 1.5f, 0.2f), 2),
      below(specular_lobe(Rgb(0.4f), 1.5f, 0), 3), below(diffuse_lobe(Rgb(0.4f)))},
     true,
     false},
    {"principled",
     {metal_lobe(Rgb(0.2f), Rgb(0.9f, 0.5f, 0.1f), 0.2f, true),
      glass_lobe(Rgb(0.3f), Rgb(0.8f), false, 1.5f, 0.2f, true), kLayer,
      below(oren_nayar_lobe(Rgb(0.4f), Rgb(0.6f), 0.5f))},
     false,
     false},
};

std::ostream& operator<<(std::ostream& out, const BsdfCase& c) { return out << c.name; }

Bsdf one(const Lobe& lobe) { return make({lobe}); }
Lobe mirror(vec3 normal = kNg) { return placed(glossy_lobe(kWhite, 0), normal); }
Lobe dielectric(float ior = 1.5f, vec3 normal = kNg) {
  return placed(glass_lobe(kWhite, kWhite, true, ior, 0), normal);
}

class Bsdfs : public ::testing::TestWithParam<BsdfCase> {
 protected:
  bool upright() const {
    return std::all_of(GetParam().lobes.begin(), GetParam().lobes.end(),
                       [](const Lobe& lobe) { return lobe.normal == kNg; });
  }
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

// Where a walk may come from: upright, oblique, grazing, from behind.
const vec3 kFrom[] = {normalize(vec3(0.3f, 0.2f, 1)), normalize(vec3(-1, 0.4f, 0.3f)),
                      normalize(vec3(0.6f, 0.8f, 0.05f)), normalize(vec3(0.2f, 0.7f, -0.8f))};

TEST_P(Bsdfs, SamplesFollowTheDensity) {
  const SphereCells cells{12, 12};
  for (const TransportMode mode : {Radiance, Importance}) {
    for (const vec3 from : kFrom) {
      std::vector<double> counts(cells.size());
      const int count = samples(25000);
      for (int i = 0; i < count; ++i) {
        const auto s = bsdf_.sample(from, random_.next(), random_.next_2d(), mode);
        if (s && !s->delta) {
          ++counts[cells.cell(s->direction)];
        }
      }
      auto expected = cells.integrate([&](vec3 to) { return pdf(bsdf_, from, to, mode); }, 32);
      double total = 0;
      for (double& e : expected) {
        total += e;
        e *= count;
      }
      EXPECT_LT(chi_square_z(counts, expected), 4.0)
          << from.x << ", light walk " << (mode == Importance);
      EXPECT_LT(total, 1 + 3e-3);  // less where the surface itself is in the way
      if (upright()) {
        EXPECT_GT(total, 0.1);
      }
    }
  }
}

// A sample says of itself what the functions say.
TEST_P(Bsdfs, SamplesAgreeWithTheFunctions) {
  for (const TransportMode mode : {Radiance, Importance}) {
    const TransportMode reverse = mode == Radiance ? Importance : Radiance;
    int drawn = 0;
    for (int i = 0; i < 1000; ++i) {
      const vec3 from = random_.direction();
      const auto s = bsdf_.sample(from, random_.next(), random_.next_2d(), mode);
      if (!s || s->delta) {
        continue;
      }
      ++drawn;
      const vec3 wo = mode == Radiance ? from : s->direction;
      const vec3 wi = mode == Radiance ? s->direction : from;
      EXPECT_FLOAT_EQ(s->pdf_solid, pdf(bsdf_, from, s->direction, mode));
      EXPECT_FLOAT_EQ(s->pdf_reverse, pdf(bsdf_, s->direction, from, reverse));
      const Rgb expected = eval(bsdf_, from, s->direction, mode) / s->pdf_solid;
      EXPECT_LE(glm::length(s->weight - expected), 1e-4 * glm::length(expected));
      const BsdfEval both = bsdf_.evaluate(wo, wi, mode);
      EXPECT_EQ(both.f, bsdf_.eval(wo, wi, mode));
      EXPECT_EQ(both.pdf_radiance, bsdf_.pdf_solid(wo, wi, Radiance));
      EXPECT_EQ(both.pdf_importance, bsdf_.pdf_solid(wo, wi, Importance));
    }
    EXPECT_GT(drawn, 300);
  }
}

// The throughput of a walk stays bounded: the sampling follows the value. (Oren-Nayar is left out:
// its retroreflection grows without bound towards the horizon.)
TEST_P(Bsdfs, WeightsAreBounded) {
  for (const Lobe& lobe : bsdf_.lobes()) {
    if (lobe.type == LobeType::OrenNayar || lobe.type == LobeType::RoughTranslucent ||
        lobe.type == LobeType::Velvet) {
      return;
    }
  }
  for (int i = 0; i < 5000; ++i) {
    const vec3 from = random_.direction();
    const auto s = bsdf_.sample(from, random_.next(), random_.next_2d(), Radiance);
    if (s) {
      EXPECT_LT(max_component(s->weight), 3.0f) << from.z;
      EXPECT_TRUE(is_finite(s->weight));
    }
  }
}

// Veach's rule for shading normals, and closed surfaces.
TEST_P(Bsdfs, AdjointFactor) {
  const bool through = bsdf_.transmits();
  for (int i = 0; i < 2000; ++i) {
    const vec3 wo = random_.direction(), wi = random_.direction();
    const Rgb radiance = bsdf_.eval(wo, wi, Radiance), importance = bsdf_.eval(wo, wi, Importance);
    EXPECT_EQ(radiance, bsdf_.eval_cos(wo, wi));
    EXPECT_NEAR(importance.x * std::abs(wi.z), radiance.x * std::abs(wo.z),
                1e-5 * (1 + radiance.x));
    // Whatever has a value can be drawn by both walks.
    if (radiance.x > 0) {
      EXPECT_GT(bsdf_.pdf_solid(wo, wi, Radiance), 0);
      EXPECT_GT(bsdf_.pdf_solid(wo, wi, Importance), 0);
    }
    EXPECT_TRUE(through || wo.z * wi.z > 0 || is_black(radiance));
  }
}

// f(wo, wi) / n_i^2 = f(wi, wo) / n_o^2 (f in Cycles' meaning, one index for all lobes). Lobes that
// do more where the camera stands are not: Multiscatter GGX and what lies below a layer.
TEST_P(Bsdfs, Reciprocity) {
  if (!upright()) {
    return;  // f |wi . N| with several normals is not f |wi . Ng|
  }
  float ior = 1;
  for (const Lobe& lobe : bsdf_.lobes()) {
    ior = lobe.type >= LobeType::Glass ? lobe.ior : ior;
  }
  double worst = 0;
  for (int i = 0; i < 3000; ++i) {
    const vec3 wo = random_.direction(), wi = random_.direction();
    if (std::abs(wo.z) < 0.01f || std::abs(wi.z) < 0.01f) {
      continue;
    }
    const float ratio = wo.z * wi.z > 0 ? 1 : wo.z > 0 ? sqr(ior) : 1 / sqr(ior);
    const float a = bsdf_.eval_cos(wo, wi).x / std::abs(wi.z);
    const float b = bsdf_.eval_cos(wi, wo).x / std::abs(wo.z) * ratio;
    worst = std::max<double>(worst, std::abs(a - b) / std::max(1e-3f, std::max(a, b)));
  }
  if (GetParam().reciprocal) {
    EXPECT_LT(worst, 2e-3);
  } else {
    EXPECT_GT(worst, 0.01);  // as said above; else this list is out of date
  }
}

TEST_P(Bsdfs, MixesSumToTheirLobes) {
  for (const vec3 wi : {normalize(vec3(-0.2f, 0.4f, 0.9f)), normalize(vec3(-0.2f, 0.4f, -0.9f))}) {
    const vec3 wo = normalize(vec3(0.1f, 0.2f, 1));
    Rgb sum(0);
    float normal = 0, grazing = 0;
    for (const Lobe& lobe : bsdf_.lobes()) {
      sum += one(below(lobe, 0)).view(kNg).eval_cos(wo, wi) * covers_transmittance(lobe, kNg, wo);
      normal += lobe.pmf_normal;
      grazing += lobe.pmf_grazing;
    }
    EXPECT_NEAR(sum.x, bsdf_.eval_cos(wo, wi).x, 1e-5 * (1 + sum.x));
    EXPECT_NEAR(normal, 1, 1e-6);
    EXPECT_NEAR(grazing, 1, 1e-6);
  }
}

// A cache keeps the lobes that are not deltas, and covers: values and densities stay as they were.
TEST_P(Bsdfs, DeltasMayBeLeftOut) {
  if (std::ranges::any_of(bsdf_.lobes(), &Lobe::above)) {
    GTEST_SKIP() << "all stay";
  }
  std::vector<Lobe> kept;
  for (const Lobe& lobe : bsdf_.lobes()) {
    if (!is_delta(lobe)) {
      kept.push_back(lobe);
    }
  }
  EXPECT_EQ(kept.size() < bsdf_.lobes().size(), GetParam().delta);
  const BsdfView cached(kept, kNg, kNg);
  for (int i = 0; i < 200; ++i) {
    const vec3 wo = random_.direction(), wi = random_.direction();
    const BsdfEval a = bsdf_.evaluate(wo, wi, Radiance), b = cached.evaluate(wo, wi, Radiance);
    EXPECT_EQ(a.f, b.f);
    EXPECT_EQ(a.pdf_radiance, b.pdf_radiance);
    EXPECT_EQ(a.pdf_importance, b.pdf_importance);
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, Bsdfs, ::testing::ValuesIn(kCases),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(Diffuse, WhiteReflectsEverything) {
  const Bsdf white = one(diffuse_lobe(kWhite));
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
  EXPECT_FALSE(one(mirror()).view(kNg).connectible());
  EXPECT_FALSE(one(dielectric()).view(kNg).connectible());
  EXPECT_TRUE(make({diffuse_lobe(kWhite), mirror()}).view(kNg).connectible());
  EXPECT_EQ(one(mirror()).view(kNg).pdf_solid(kNg, kNg, Radiance), 0.0f);
}

TEST(Mirror, Reflects) {
  const Bsdf bsdf = one(mirror());
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
    const Bsdf storage = one(dielectric(ior));
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
  for (const bool reflects : {true, false}) {
    const Bsdf storage = one(reflects ? mirror(kTilted) : dielectric(1.5f, kTilted));
    for (int i = 0; i < 5000; ++i) {
      const vec3 from = random.direction();
      const auto s = storage.view(kNg).sample(from, random.next(), random.next_2d(), Radiance);
      if (s && reflects) {
        EXPECT_GT(s->direction.z * from.z, 0);
      }
      EXPECT_TRUE(!s || is_finite(s->weight));
    }
  }
}

}  // namespace
}  // namespace janus::test
