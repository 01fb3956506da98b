// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/shading/thin_wall.h"

#include "janus/shading/fresnel.h"
#include "shading/compiled.h"
#include "shading/lobes.h"

namespace janus::test {
namespace {

const Rgb kWhite(1);

Lobe side(float ior = 1.5f) { return glass_lobe(kWhite, kWhite, false, ior, 0); }

// Follows light to and fro between both sides.
struct Bounced {
  double reflected, transmitted;
};
Bounced bounced(double reflectance, double kept) {
  Bounced sum{reflectance, 0};
  double between = (1 - reflectance) * kept;
  for (int i = 0; i < 500; ++i) {
    (i % 2 == 0 ? sum.transmitted : sum.reflected) += between * (1 - reflectance);
    between *= reflectance * kept;
  }
  return sum;
}

TEST(ThinGlass, IsTheSumOfAllReflections) {
  for (const float ior : {1.1f, 1.5f, 3.0f}) {
    for (const float cos : {1.0f, 0.6f, 0.2f, 0.02f}) {
      const Rgb tint(0.9f, 0.3f, 1);
      const ThinGlass glass = thin_glass(side(ior), tint, cos);
      const double cos_t = std::sqrt(1 - (1 - cos * cos) / (ior * ior));
      for (int c = 0; c < 3; ++c) {
        const auto [reflected, transmitted] =
            bounced(fresnel_dielectric(cos, ior), std::pow(tint[c], 1 / cos_t));
        EXPECT_NEAR(glass.reflected[c], reflected, 2e-6) << ior << " " << cos;
        EXPECT_NEAR(glass.transmitted[c], transmitted, 2e-6) << ior << " " << cos;
      }
    }
  }
}

TEST(ThinGlass, LosesNothingWithoutATint) {
  for (const float cos : {1.0f, 0.7f, 0.3f, 0.05f}) {
    for (const Lobe& glass : {side(), with_film(side(), 300, 1.8f), side(0.8f), side(1)}) {
      const auto [reflected, transmitted] = thin_glass(glass, kWhite, cos);
      EXPECT_NEAR(average(reflected + transmitted), 1, 2e-5) << cos << " " << glass.ior;
    }
  }
  // A film has colours; beyond the critical angle nothing comes through.
  const Rgb film = thin_glass(with_film(side(), 300, 1.8f), kWhite, 0.9f).reflected;
  EXPECT_GT(max_component(film) - std::min({film.x, film.y, film.z}), 0.05f);
  EXPECT_EQ(thin_glass(side(0.8f), kWhite, 0.3f).transmitted, Rgb(0));
  EXPECT_EQ(thin_glass(side(), Rgb(0), 0.9f).transmitted, Rgb(0));
}

TEST(ThinGlass, WhatGoesThroughIsWiderTheHigherTheIndex) {
  EXPECT_EQ(thin_width(0.3f, 1), 0);
  EXPECT_EQ(thin_width(0.3f, 0.7f), 0);
  EXPECT_NEAR(thin_width(0.2f, 1.5f), 0.2f * std::sqrt(3.4f * 0.5f / 3.375f), 1e-6);
  EXPECT_NEAR(thin_width(1, 2), std::sqrt(3.4f * 2.25f / 8), 1e-6);
  EXPECT_LE(thin_width(1, 5), 1);
}

// A Principled surface that runs at the origin, seen from `view`.
ShadingResult seen(const Program& program, vec3 view) {
  ShadingPoint point{};
  point.ns = point.ng = kNg;
  point.view = view;
  ShadingResult result;
  program.run(point, result);
  return result;
}

Program thin(std::map<std::string, NodeInput> inputs) {
  inputs.insert({{"Thin Wall", 1.0f}, {"Base Color", vec4(1)}, {"IOR", 1.5f}});
  Compiled result = compiled(single("BSDF_PRINCIPLED", std::move(inputs)));
  EXPECT_TRUE(result.diagnostics.empty());
  return std::move(result.program);
}

TEST(ThinWall, WhiteGlassReflectsAndTransmitsAllLight) {
  for (const float roughness : {0.3f, 0.6f, 1.0f}) {
    const Program program = thin({{"Transmission Weight", 1.0f}, {"Roughness", roughness}});
    EXPECT_EQ(program.dependence, Dependence::View);
    EXPECT_TRUE(program.transmits);
    for (const float cos : {0.9f, 0.5f, -0.7f}) {
      const ShadingResult result = seen(program, at_cosine(cos));
      EXPECT_EQ(result.transparency, Rgb(0));
      const Mean all = albedo(result.bsdf.view(kNg), at_cosine(cos), 40000);
      // Facets' multiple bounces are those of Cycles, which lose what falls below the surface.
      EXPECT_NEAR(all.mean(), 1, 0.01 + 4 * all.error()) << roughness << " " << cos;
    }
  }
}

TEST(ThinWall, SmoothGlassIsCrossed) {
  const Program program = thin({{"Transmission Weight", 0.8f},
                                {"Roughness", 0.0f},
                                {"Base Color", vec4(0.5f, 0.7f, 0.9f, 1)},
                                {"Alpha", 0.9f},
                                {"Coat Weight", 1.0f}});
  EXPECT_TRUE(program.has_transparency());
  const float cos = 0.6f;
  const ThinGlass glass = thin_glass(side(), Rgb(0.5f, 0.7f, 0.9f), cos);
  for (const float z : {cos, -cos}) {
    const ShadingResult result = seen(program, at_cosine(z));
    const Rgb behind = (result.transparency - 0.1f) / (0.9f * 0.8f);
    const float coat = behind.x / glass.transmitted.x;  // which reflects some before
    EXPECT_LT(coat, 0.95f);
    EXPECT_GT(coat, 0.7f);
    EXPECT_NEAR(behind.z, coat * glass.transmitted.z, 1e-5);
    for (const Lobe& lobe : result.bsdf.lobes()) {
      EXPECT_FALSE(transmits(lobe));
    }
  }
}

// Subsurface scattering comes out on both sides, as its anisotropy says.
TEST(ThinWall, ScattersToBothSides) {
  for (const float rough : {0.0f, 0.8f}) {
    const Program program = thin({{"Subsurface Weight", 1.0f},
                                  {"Subsurface Anisotropy", 0.4f},
                                  {"Specular IOR Level", 0.0f},
                                  {"Diffuse Roughness", rough}});
    EXPECT_TRUE(program.constant());
    double back = 0, forth = 0;
    Bsdf bsdf;
    for (const Lobe& lobe : program.lobes) {
      EXPECT_NE(lobe.type, LobeType::Subsurface);
      bsdf.add(lobe);
      (transmits(lobe) ? forth : back) += integrated(make({lobe}).view(kNg), at_cosine(0.8f));
    }
    bsdf.finish();
    EXPECT_NEAR(back, 0.3, 2e-3);
    EXPECT_NEAR(forth, 0.7, 4e-3);
    const Mean all = albedo(bsdf.view(kNg), at_cosine(0.8f), 100000);
    EXPECT_NEAR(all.mean(), 1, 0.005 + 4 * all.error());
  }
}

// Cycles reads a whole number.
TEST(ThinWall, LessThanOneIsNone) {
  const Program half = thin({{"Transmission Weight", 1.0f}, {"Thin Wall", 0.9f}});
  EXPECT_EQ(seen(half, at_cosine(0.8f)).bsdf.lobes()[0].type, LobeType::Glass);
}

}  // namespace
}  // namespace janus::test
