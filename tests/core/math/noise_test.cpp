// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/math/noise.h"

#include <gtest/gtest.h>

#include "janus/math/gabor.h"
#include "janus/math/voronoi.h"
#include "support/statistics.h"

namespace janus::test {
namespace {

template <int D>
Coordinates<D> place(Random& random, float size) {
  Coordinates<D> p;
  for (int d = 0; d < D; ++d) {
    p[d] = size * (2.0f * random.next() - 1.0f);
  }
  return p;
}

// Calls test(std::integral_constant<int, D>) for each number of dimensions.
void in_each_dimension(auto&& test) {
  test(std::integral_constant<int, 1>());
  test(std::integral_constant<int, 2>());
  test(std::integral_constant<int, 3>());
  test(std::integral_constant<int, 4>());
}

// As Cycles has them (tests/images/test_nodes.py compares all of them).
TEST(Noise, NumbersAreTheSameEverywhere) {
  EXPECT_EQ(jenkins_hash(std::array{0U}), 0x9519dc65U);
  EXPECT_EQ(jenkins_hash(std::array{1U, 2U}), 0x1037cb9dU);
  EXPECT_EQ(jenkins_hash(std::array{1U, 2U, 3U}), 0xb8d17a0aU);
  EXPECT_EQ(jenkins_hash(std::array{1U, 2U, 3U, 4U}), 0x0584dec1U);
  EXPECT_FLOAT_EQ(perlin_noise<1>(Coordinates<1>(0.3f)), 0.348075f);
  EXPECT_FLOAT_EQ(perlin_noise<2>(vec2(0.3f, 1.7f)), -0.64609993f);
  EXPECT_FLOAT_EQ(perlin_noise<3>(vec3(0.3f, 1.7f, -2.6f)), 0.48509723f);
  EXPECT_FLOAT_EQ(perlin_noise<4>(vec4(0.3f, 1.7f, -2.6f, 5.1f)), -0.13897939f);
}

TEST(Noise, IsNothingOnTheGridAndRepeats) {
  in_each_dimension([](auto dimensions) {
    constexpr int D = dimensions;
    Random random(1);
    float low = 0.0f, high = 0.0f;
    for (int n = 0; n < 20000; ++n) {
      const Coordinates<D> p = place<D>(random, 50.0f);
      EXPECT_EQ(perlin_noise<D>(glm::floor(p)), 0.0f);
      const float x = perlin_noise<D>(p);
      low = std::min(low, x);
      high = std::max(high, x);
    }
    EXPECT_GT(low, -1.1f);
    EXPECT_LT(low, -0.6f);
    EXPECT_LT(high, 1.1f);
    EXPECT_GT(high, 0.6f);
    const Coordinates<D> p(7.25f);  // floats go on by 1/128 there
    EXPECT_EQ(perlin_noise<D>(p), perlin_noise<D>(p + 100000.0f));
  });
}

TEST(Noise, ArbitraryNumbersEnd) {
  for (const float x : {1e10f, 3e38f, -3e38f, kInfinity, std::nanf("")}) {
    in_each_dimension([x](auto dimensions) {
      constexpr int D = dimensions;
      for (const NoiseType type :
           {NoiseType::Multifractal, NoiseType::RidgedMultifractal, NoiseType::HybridMultifractal,
            NoiseType::Fbm, NoiseType::HeteroTerrain}) {
        fractal_noise<D>(Coordinates<D>(x), {.type = type, .detail = x});
        fractal_noise<D>(Coordinates<D>(0.3f), {.type = type, .detail = x, .lacunarity = x});
      }
      for (const VoronoiFeature feature :
           {VoronoiFeature::F1, VoronoiFeature::F2, VoronoiFeature::SmoothF1}) {
        voronoi_point<D>(Coordinates<D>(x), {.feature = feature, .exponent = x});
      }
      voronoi_edge<D>(Coordinates<D>(x), {});
      voronoi_radius<D>(Coordinates<D>(x), {});
    });
    gabor_noise(vec2(x), 2.0f, 0.5f, 1.0f);
  }
}

TEST(Voronoi, DistancesAreThoseOfPoints) {
  in_each_dimension([](auto dimensions) {
    constexpr int D = dimensions;
    Random random(2);
    for (int n = 0; n < 500; ++n) {
      const Coordinates<D> p = place<D>(random, 5.0f);
      for (const bool old : {false, true}) {
        Voronoi voronoi{.old_points = old, .wants_color = true};
        const VoronoiPoint first = voronoi_point<D>(p, voronoi);
        voronoi.feature = VoronoiFeature::F2;
        const VoronoiPoint second = voronoi_point<D>(p, voronoi);
        for (const VoronoiPoint& found : {first, second}) {
          vec4 to = found.position;
          for (int d = 0; d < D; ++d) {
            to[D == 1 ? 3 : d] -= p[d];
          }
          EXPECT_NEAR(glm::length(to), found.distance, 1e-5f);
          EXPECT_GE(found.color.x, 0.0f);
          EXPECT_LE(found.color.x, 1.0f);
        }
        EXPECT_LE(first.distance, second.distance);
        EXPECT_LE(voronoi_edge<D>(p, voronoi), 0.5f * (second.distance + first.distance) + 1e-5f);
        EXPECT_GT(voronoi_radius<D>(p, voronoi), 0.0f);
        voronoi.feature = VoronoiFeature::SmoothF1;
        EXPECT_LE(voronoi_point<D>(p, voronoi).distance, first.distance + 1e-5f);
      }
    }
  });
}

TEST(Gabor, ValuesStayInTheirRange) {
  Random random(3);
  double square = 0.0;
  constexpr int kCount = 4000;
  for (int n = 0; n < kCount; ++n) {
    const vec3 p = place<3>(random, 20.0f);
    const vec2 flat = gabor_noise(vec2(p), 3.0f, 0.5f, 1.0f) / gabor_range(2);
    const vec2 deep = gabor_noise(p, 3.0f, 0.5f, vec3(0.6f, 0.8f, 0.0f)) / gabor_range(3);
    EXPECT_LT(glm::length(flat), 1.0f);
    EXPECT_LT(glm::length(deep), 1.0f);
    square += flat.y * flat.y;
  }
  EXPECT_NEAR(6.0 * std::sqrt(square / kCount), 1.0, 0.4);  // the range was made by eye
}

}  // namespace
}  // namespace janus::test
