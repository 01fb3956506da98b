// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the lobes look like: albedos, limits, and the tables behind them.
#include <gtest/gtest.h>

#include <complex>

#include "janus/shading/albedo.h"
#include "janus/shading/diffuse.h"
#include "janus/shading/facet_lobes.h"
#include "janus/shading/fresnel.h"
#include "janus/shading/layers.h"
#include "janus/shading/sheen.h"
#include "shading/lobes.h"

namespace janus::test {
namespace {

const Rgb kWhite(1);

// The table by an independent way: the reflection's value over the hemisphere.
TEST(AlbedoTables, AreTheIntegralsOfTheLobes) {
  for (const int x : {12, 20, 31}) {
    for (const int y : {6, 15, 31}) {  // entries, where nothing is interpolated
      const float rough = x / 31.0f, mu = y / 31.0f;
      const Bsdf lobe = make({glossy_lobe(kWhite, sqr(rough))});
      EXPECT_NEAR(reflection_albedo(rough, mu), integrated(lobe.view(kNg), at_cosine(mu)), 1.5e-3)
          << rough << " " << mu;
    }
  }
  for (const int x : {7, 11, 15}) {
    for (const int y : {4, 9, 15}) {
      for (const int z : {3, 7, 10}) {
        const float rough = x / 15.0f, mu = y / 15.0f, z2 = sqr(z / 15.0f);
        const float ior = (1 + z2) / (1 - z2);
        const Bsdf lobe = make({glass_lobe(kWhite, kWhite, true, ior, sqr(rough))});
        const Mean outside = albedo(lobe.view(kNg), at_cosine(mu), 20000),
                   inside = albedo(lobe.view(kNg), at_cosine(-mu), 20000);
        EXPECT_NEAR(glass_albedo(rough, mu, ior), outside.mean(), 1e-3 + 4 * outside.error())
            << rough << " " << mu << " " << ior;
        // From within the table counts light that the surface sends nowhere.
        EXPECT_GE(glass_albedo(rough, mu, 1 / ior), inside.mean() - 4 * inside.error());
      }
    }
  }
}

TEST(AlbedoTables, Averages) {
  for (const int x : {5, 18, 31}) {
    double sum = 0;
    constexpr int kSteps = 31;
    for (int i = 0; i < 10 * kSteps; ++i) {
      const float mu = (i + 0.5f) / (10 * kSteps);
      sum += 2 * mu * reflection_albedo(x / 31.0f, mu) / (10 * kSteps);
    }
    EXPECT_NEAR(reflection_albedo_average(x / 31.0f), sum, 1e-3);
  }
  for (const float eta : {1.5f, 1 / 1.5f}) {
    double sum = 0;
    for (int i = 0; i < 300; ++i) {
      const float mu = (i + 0.5f) / 300;
      sum += 2 * mu * glass_albedo(0.8f, mu, eta) / 300;
    }
    EXPECT_NEAR(glass_albedo_average(0.8f, eta), sum, 2e-3);
  }
}

TEST(AlbedoTables, SmoothReflectanceIsFresnels) {
  for (const float mu : {0.2f, 0.4f, 0.8f, 1.0f}) {  // entries
    for (const float eta : {1.2f, 1.5f, 2.0f}) {
      const float f0 = fresnel_normal(eta);
      EXPECT_NEAR(f0 + (1 - f0) * dielectric_position(0, mu, eta), fresnel_dielectric(mu, eta),
                  0.01);
    }
  }
  EXPECT_TRUE(std::isfinite(dielectric_position(NAN, NAN, 1.5f)));
  EXPECT_EQ(reflection_albedo(0, 0.3f), 1.0f);
  EXPECT_EQ(reflection_albedo(2, 2), reflection_albedo(1, 1));
}

// Mirrors lose nothing, rough single scattering does, Multiscatter GGX gives it back.
TEST(Furnace, Glossy) {
  for (const float mu : {0.2f, 0.6f, 0.95f}) {
    for (const float roughness : {0.2f, 0.5f, 0.8f, 1.0f}) {
      const vec3 wo = at_cosine(mu);
      const float alpha = sqr(roughness);
      const Mean single = albedo(make({glossy_lobe(kWhite, alpha)}).view(kNg), wo, 20000);
      const Mean multiple = albedo(make({glossy_lobe(kWhite, alpha, true)}).view(kNg), wo, 60000);
      EXPECT_LT(single.mean(), 1 + 1e-6);
      EXPECT_NEAR(multiple.mean(), 1, 0.01) << mu << " " << roughness;
    }
  }
}

TEST(Furnace, Glass) {
  for (const float mu : {0.3f, 0.6f, 0.95f}) {
    for (const float roughness : {0.2f, 0.5f, 0.9f}) {
      const float alpha = sqr(roughness);
      for (const float ior : {1.33f, 1.5f}) {
        const Bsdf multiple = make({glass_lobe(kWhite, kWhite, true, ior, alpha, true)});
        EXPECT_NEAR(albedo(multiple.view(kNg), at_cosine(mu), 20000).mean(), 1, 0.01)
            << mu << " " << roughness << " " << ior;
        EXPECT_LT(albedo(multiple.view(kNg), at_cosine(-mu), 20000).mean(), 1.01);
        const Bsdf single = make({glass_lobe(kWhite, kWhite, true, ior, alpha)});
        EXPECT_LT(albedo(single.view(kNg), at_cosine(-mu), 20000).mean(), 1 + 1e-6);
      }
    }
  }
}

TEST(Furnace, RoughDiffuse) {
  for (const float mu : {0.05f, 0.4f, 1.0f}) {
    for (const float roughness : {0.0f, 0.3f, 1.0f}) {
      const Bsdf white = make({oren_nayar_lobe(kWhite, kWhite, roughness)});
      EXPECT_NEAR(integrated(white.view(kNg), at_cosine(mu)), 1, 0.005) << mu << " " << roughness;
      const Bsdf grey = make({oren_nayar_lobe(Rgb(0.5f), Rgb(0.5f), roughness)});
      EXPECT_LT(integrated(grey.view(kNg), at_cosine(mu)), 0.505);
    }
  }
  // Roughness 0 is Lambert.
  Random random(4);
  const Bsdf a = make({oren_nayar_lobe(Rgb(0.7f), Rgb(0.7f), 0)}),
             b = make({diffuse_lobe(Rgb(0.7f))});
  for (int i = 0; i < 100; ++i) {
    const vec3 wo = random.direction(), wi = random.direction();
    EXPECT_NEAR(a.view(kNg).eval_cos(wo, wi).x, b.view(kNg).eval_cos(wo, wi).x, 1e-6);
  }
  for (float x = 0; x <= 1; x += 0.01f) {
    EXPECT_NEAR(arc_cosine(x), std::acos(x), 2e-7);
  }
}

// Dielectric layer over white diffuse: Cycles' principled white surface keeps nearly everything.
TEST(Furnace, Layers) {
  for (const float mu : {0.1f, 0.5f, 1.0f}) {
    for (const float roughness : {0.0f, 0.5f, 1.0f}) {
      const Lobe layer = specular_lobe(kWhite, 1.5f, sqr(roughness), true);
      const Bsdf bsdf = make({layer, below(diffuse_lobe(kWhite))});
      EXPECT_NEAR(albedo(bsdf.view(kNg), at_cosine(mu), 20000).mean(), 1, 0.03)
          << mu << " " << roughness;
    }
  }
}

TEST(Metal, ReflectanceIsSchlicks) {
  const Rgb f0(0.9f, 0.5f, 0.2f);
  for (const float mu : {1.0f, 0.4f, 0.1f}) {
    const Bsdf smooth = make({metal_lobe(kWhite, f0, 0)});
    const auto s =
        smooth.view(kNg).sample(at_cosine(mu), 0.5f, vec2(0.5f), TransportMode::Radiance);
    ASSERT_TRUE(s && s->delta);
    EXPECT_NEAR(glm::length(s->weight - (f0 + (1.0f - f0) * schlick(mu))), 0, 1e-5);
  }
}

// By the formulas with complex numbers.
TEST(Metal, ConductorsAreFresnels) {
  const std::complex<double> index(0.2, 3.6);
  for (const double cos : {1.0, 0.6, 0.15, 0.0}) {
    const std::complex<double> t = std::sqrt(1.0 - (1 - cos * cos) / (index * index));
    const double s = std::norm((cos - index * t) / (cos + index * t));
    const double p = std::norm((index * cos - t) / (index * cos + t));
    EXPECT_NEAR(fresnel_conductor(static_cast<float>(cos), 0.2f, 3.6f), 0.5 * (s + p), 1e-5);
    EXPECT_NEAR(fresnel_conductor(static_cast<float>(cos), 1.5f, 0.0f),
                fresnel_dielectric(static_cast<float>(cos), 1.5f), 1e-5);
  }
}

// The tint is that of the reflectance at 82 degrees; straight on and at the horizon nothing
// changes.
TEST(Metal, TintOfTheEdge) {
  const Rgb f0(0.8f, 0.5f, 0.2f), tint(0.3f, 0.6f, 1);
  const Lobe plain = metal_lobe(kWhite, f0, 0.3f), edge = metal_lobe(kWhite, f0, 0.3f, false, tint);
  const Rgb ratio = reflectance(edge, 1 / 7.0f) / reflectance(plain, 1 / 7.0f);
  EXPECT_NEAR(glm::length(ratio - tint), 0, 1e-5);
  EXPECT_NEAR(glm::length(reflectance(edge, 1) - f0), 0, 1e-6);
  EXPECT_NEAR(glm::length(reflectance(edge, 0) - kWhite), 0, 1e-6);
}

// Sheen is a density times an albedo, from all views that see it.
TEST(Furnace, Sheen) {
  for (const float mu : {0.1f, 0.4f, 0.9f}) {
    for (const float roughness : {0.3f, 0.6f, 1.0f}) {
      const Bsdf sheen = make({sheen_lobe(kWhite, roughness)});
      const float expected = SheenLobe(roughness, mu).albedo;
      EXPECT_NEAR(integrated(sheen.view(kNg), at_cosine(mu)), expected, 2e-3 * expected);
      // A white cover over white: what it reflects does not go below.
      const Bsdf covered = make({sheen_lobe(kWhite, roughness), below(diffuse_lobe(kWhite))});
      EXPECT_NEAR(integrated(covered.view(kNg), at_cosine(mu)), 1, 3e-3);
    }
  }
}

// A cone without an edge sends all light back, however narrow it is.
TEST(Furnace, Toon) {
  for (const bool glossy : {false, true}) {
    for (const float size : {0.0f, 1e-3f, 0.3f}) {
      const Bsdf toon = make({toon_lobe(glossy, kWhite, size, 0)});
      EXPECT_NEAR(albedo(toon.view(kNg), at_cosine(0.95f), 2000).mean(), 1, 1e-3)
          << glossy << " " << size;
    }
  }
}

// Coats dim what they cover by what they reflect, and tint it by the length of the way.
TEST(Furnace, Coats) {
  for (const float mu : {0.2f, 0.7f, 1.0f}) {
    for (const float share : {0.4f, 1.0f}) {
      const Lobe coat = coat_lobe(Rgb(share), 1.5f, 0.04f, share, kWhite);
      const Bsdf white = make({coat, below(diffuse_lobe(kWhite))});
      EXPECT_NEAR(albedo(white.view(kNg), at_cosine(mu), 20000).mean(), 1, 0.03) << mu;
      const Rgb tint(0.5f, 0.2f, 1);
      const Lobe tinted = coat_lobe(Rgb(share), 1.5f, 0.04f, share, tint);
      const float cos_t = std::sqrt(1 - (1 - mu * mu) / 2.25f);
      const Rgb ratio = layer_transmittance(tinted, mu) / layer_transmittance(coat, mu);
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(ratio[c], 1 - share + share * std::pow(tint[c], 1 / cos_t), 1e-4);
      }
    }
  }
}

// Smooth glass below dust: each event is dimmed as the camera side sees it.
TEST(Furnace, SmoothBelowCovers) {
  const Lobe dust = sheen_lobe(Rgb(0.6f), 0.5f, Rgb(0.6f));
  const Lobe coat = coat_lobe(Rgb(0.5f), 1.5f, 0.2f, 0.5f, kWhite);
  const Lobe clear = glass_lobe(kWhite, kWhite, true, 1.5f, 0);
  const Bsdf bsdf = make({dust, below(coat), below(clear)});
  for (const float mu : {0.2f, 0.6f, 1.0f, -0.7f}) {
    const float left = 1 - 0.6f * SheenLobe(0.5f, std::abs(mu)).albedo;
    const float share = left * (1 - 0.5f * layer_reflectance(coat, std::abs(mu)).x);
    Random random(3);
    Mean smooth;
    for (int i = 0; i < 20000; ++i) {
      const auto s = bsdf.view(kNg).sample(at_cosine(mu), random.next(), random.next_2d(),
                                           TransportMode::Radiance);
      smooth.add(s && s->delta ? s->weight.x : 0.0f);
    }
    EXPECT_NEAR(smooth.mean(), share, 4 * smooth.error()) << mu;
  }
}

// The narrower a lobe, the nearer it is to its delta: the light of a cone around the smooth
// direction, in both walks.
TEST(SmoothLimit, IsContinuous) {
  struct Case {
    Lobe rough, smooth;
  };
  const float alpha = 2e-4f;
  const Case cases[] = {{glossy_lobe(kWhite, alpha, true), glossy_lobe(kWhite, 0, true)},
                        {specular_lobe(kWhite, 1.5f, alpha), specular_lobe(kWhite, 1.5f, 0)},
                        {glass_lobe(kWhite, Rgb(0.8f), true, 1.5f, alpha),
                         glass_lobe(kWhite, Rgb(0.8f), true, 1.5f, 0)},
                        {refraction_lobe(kWhite, 1.45f, alpha), refraction_lobe(kWhite, 1.45f, 0)}};
  for (const Case& c : cases) {
    EXPECT_FALSE(is_delta(c.rough));
    EXPECT_TRUE(is_delta(c.smooth));
    const Bsdf rough = make({c.rough}), smooth = make({c.smooth});
    for (const TransportMode mode : {TransportMode::Radiance, TransportMode::Importance}) {
      for (const float z : {0.9f, 0.4f, -0.9f}) {
        const vec3 from = at_cosine(z, 0.3f);
        for (const float u : {0.01f, 0.99f}) {  // reflection where there is some, refraction
          const auto a = rough.view(kNg).sample(from, u, vec2(0.3f, 0.4f), mode);
          const auto b = smooth.view(kNg).sample(from, 0.5f, vec2(u, 0.4f), mode);
          ASSERT_EQ(a.has_value(), b.has_value());
          if (a) {
            EXPECT_NEAR(glm::length(a->direction - b->direction), 0, 2e-3);
            EXPECT_NEAR(a->weight.x, b->weight.x, 2e-3 * b->weight.x) << z << " " << u;
            EXPECT_NEAR(a->pdf_reverse / a->pdf_solid, b->pdf_reverse / b->pdf_solid,
                        5e-3 * b->pdf_reverse / b->pdf_solid);
          }
        }
      }
    }
  }
}

// Roughness that Cycles takes for smooth, and an index of 1, which has no facets to speak of.
TEST(SmoothLimit, Thresholds) {
  EXPECT_TRUE(is_delta(glossy_lobe(kWhite, 1.4e-5f)));
  EXPECT_FALSE(is_delta(glossy_lobe(kWhite, 1.5e-5f)));
  EXPECT_TRUE(is_delta(glass_lobe(kWhite, kWhite, true, 1.00005f, 0.3f)));
  const Bsdf straight = make({glass_lobe(kWhite, Rgb(0.5f), true, 1, 0.3f)});
  const auto s =
      straight.view(kNg).sample(at_cosine(0.3f), 0.5f, vec2(0.5f), TransportMode::Radiance);
  ASSERT_TRUE(s);
  EXPECT_NEAR(glm::length(s->direction + at_cosine(0.3f)), 0, 1e-5);
  EXPECT_NEAR(s->weight.x, 0.5, 1e-6);
}

// Narrow lobes keep their digits: the density integrates to 1 in the plane of the half vector.
TEST(SmoothLimit, NarrowLobesAreNormalized) {
  for (const float alpha : {1e-2f, 1e-3f, 1e-4f}) {
    const Bsdf storage = make({glossy_lobe(kWhite, alpha)});
    const BsdfView bsdf = storage.view(kNg);
    // Around normal incidence the lobe is a disk: density times ring, theta = alpha tan(t).
    double sum = 0;
    constexpr int kSteps = 2000;
    for (int i = 0; i < kSteps; ++i) {
      const double t = (i + 0.5) / kSteps * 1.5707, theta = 2 * alpha * std::tan(t);
      if (theta > 1.5) {
        break;
      }
      const vec3 wi(std::sin(theta), 0, std::cos(theta));
      const double width = 2 * alpha / std::pow(std::cos(t), 2) * 1.5707 / kSteps;
      sum += bsdf.pdf_solid(kNg, wi, TransportMode::Radiance) * 6.2831853 * std::sin(theta) * width;
    }
    EXPECT_NEAR(sum, 1, 0.005) << alpha;
  }
}

// Views that a mirror at the shading normal would send below the surface see a turned normal: the
// reflection just leaves the surface, in the plane of both normals, and nothing else changes.
TEST(ValidNormal, KeepsReflectionsAboveTheSurface) {
  Random random(6);
  int turned = 0;
  for (int i = 0; i < 20000; ++i) {
    vec3 wo = random.direction(), n = random.direction();
    wo.z = std::abs(wo.z);
    n.z = std::abs(n.z) + 0.2f;
    n = normalize(n);
    const vec3 used = valid_normal(n, kNg, wo);
    EXPECT_NEAR(length2(used), 1, 1e-4);
    const float reflected = reflect_about(wo, used).z, least = std::min(0.9f * wo.z, 0.01f);
    EXPECT_GT(reflected, std::max(0.0f, least - 3e-4f));
    if (used == n) {
      EXPECT_GE(reflect_about(wo, n).z, least - 1e-5f);
      continue;
    }
    ++turned;
    EXPECT_LT(reflect_about(wo, n).z, least);
    EXPECT_NEAR(reflected, least, 1e-3);
    EXPECT_NEAR(dot(cross(n, kNg), used), 0, 1e-4);
    EXPECT_GT(used.z, n.z - 1e-4f);
    EXPECT_GT(dot(used, wo), 0);
  }
  EXPECT_GT(turned, 1000);
}

// A delta at a turned normal is an event of camera walks alone; all others go both ways.
TEST(ValidNormal, DeltaEventsOfBothWalks) {
  Random random(7);
  int one_way = 0, both = 0, returned = 0;
  for (const Lobe& plain : {glossy_lobe(kWhite, 0), glass_lobe(kWhite, kWhite, true, 1.5f, 0)}) {
    const Bsdf storage = make({placed(plain, kTilted)});
    const BsdfView bsdf = storage.view(kNg);
    for (int i = 0; i < 5000; ++i) {
      const vec3 wo = random.direction();
      const vec2 u = random.next_2d();
      const auto there = bsdf.sample(wo, 0.5f, u, TransportMode::Radiance);
      if (!there) {
        continue;
      }
      const bool reflected = there->direction.z * wo.z > 0;
      const auto back = bsdf.sample(there->direction, 0.5f, vec2(reflected ? 0.0f : 0.9999f, 0),
                                    TransportMode::Importance);
      const bool returns = back && glm::length(back->direction - wo) < 1e-3f;
      if (there->pdf_reverse == 0) {
        ++one_way;
        returned += returns;                              // where the normal was hardly turned
      } else if (std::abs(there->direction.z) > 0.02f) {  // not at the threshold
        ++both;
        EXPECT_TRUE(returns) << wo.z;
      }
    }
  }
  EXPECT_GT(one_way, 100);
  EXPECT_LT(returned, 0.01 * one_way);
  EXPECT_GT(both, 1000);
}

TEST(Lobes, SidesAndFlags) {
  EXPECT_TRUE(make({translucent_lobe(kWhite)}).view(kNg).transmits());
  EXPECT_TRUE(make({diffuse_lobe(kWhite), refraction_lobe(kWhite, 1.5f, 0)}).view(kNg).transmits());
  EXPECT_FALSE(make({diffuse_lobe(kWhite), glossy_lobe(kWhite, 0.1f)}).view(kNg).transmits());
}

}  // namespace
}  // namespace janus::test
