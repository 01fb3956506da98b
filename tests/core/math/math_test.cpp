// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "janus/math/discrete.h"
#include "janus/math/frame.h"
#include "janus/math/warp.h"
#include "support/statistics.h"

namespace janus::test {
namespace {

TEST(Discrete, NeverReturnsProbabilityZero) {
  const float weights[] = {0, 1, 0, 0, 3, 0};
  const DiscreteDistribution d(weights);
  for (const float u : {0.0f, 0.2499999f, 0.25f, 0.9999999f, 0x1.fffffep-1f, 1.0f}) {
    float remainder = -1;
    const size_t i = d.sample(u, &remainder);
    EXPECT_GT(d.pmf(i), 0.0f) << u;
    EXPECT_GE(remainder, 0.0f);
    EXPECT_LT(remainder, 1.0f);
  }
  EXPECT_FLOAT_EQ(d.pmf(1), 0.25f);
  EXPECT_FLOAT_EQ(d.pmf(4), 0.75f);
  EXPECT_EQ(d.pmf(5), 0.0f);
  const float nothing[] = {0, 0};
  EXPECT_TRUE(DiscreteDistribution(nothing).empty());
  EXPECT_TRUE(DiscreteDistribution(std::span<const float>()).empty());
}

TEST(Discrete, SharesAndRemainder) {
  const float weights[] = {2, 0, 5, 1};
  const DiscreteDistribution d(weights);
  Random random(1);
  std::vector<double> counts(4 * 8), expected(4 * 8);
  constexpr int kCount = 80000;
  for (int n = 0; n < kCount; ++n) {
    float remainder;
    const size_t i = d.sample(random.next(), &remainder);
    ++counts[i * 8 + static_cast<size_t>(remainder * 8)];  // uniform within each share
  }
  for (size_t i = 0; i < expected.size(); ++i) {
    expected[i] = kCount * weights[i / 8] / 64.0;
  }
  EXPECT_LT(chi_square_z(counts, expected), 4.0);
}

TEST(Frame, IsRightHandedAndOrthonormal) {
  Random random(2);
  for (int n = 0; n < 1000; ++n) {
    const vec3 normal = n == 0 ? vec3(0, 0, -1) : n == 1 ? vec3(0, 0, 1) : random.direction();
    const Frame f(normal);
    EXPECT_NEAR(dot(f.s, f.t), 0, 1e-6);
    EXPECT_NEAR(dot(f.s, f.n), 0, 1e-6);
    EXPECT_NEAR(length2(f.s), 1, 1e-6);
    EXPECT_NEAR(glm::length(cross(f.s, f.t) - f.n), 0, 1e-6);
  }
}

// Directions against the density that the map states.
template <class Map, class Pdf>
void expect_density(Map&& map, Pdf&& pdf) {
  const SphereCells cells;
  std::vector<double> counts(cells.size());
  Random random(3);
  constexpr int kCount = 100000;
  for (int n = 0; n < kCount; ++n) {
    const vec3 d = map(random.next_2d());
    EXPECT_NEAR(length2(d), 1, 1e-5);
    ++counts[cells.cell(d)];
  }
  std::vector<double> expected = cells.integrate(pdf);
  double total = 0;
  for (double& e : expected) {
    total += e;
    e *= kCount;
  }
  EXPECT_NEAR(total, 1, 2e-3);
  EXPECT_LT(chi_square_z(counts, expected), 4.0);
}

TEST(Warp, Sphere) {
  expect_density(square_to_sphere, [](vec3) { return 0.25f * kInvPi; });
}
TEST(Warp, CosineHemisphere) {
  expect_density(square_to_cosine_hemisphere, [](vec3 d) { return std::max(0.0f, d.z) * kInvPi; });
}
TEST(Warp, CosineCone) {  // edges of the cones on edges of cells: cos = 0.5 and 0.75
  expect_density([](vec2 u) { return square_to_cosine_cone(u, 0.75f); },
                 [](vec3 d) { return d.z > 0.5f ? d.z / (kPi * 0.75f) : 0.0f; });
}
TEST(Warp, Cone) {
  expect_density([](vec2 u) { return square_to_cone(u, 0.25f); },
                 [](vec3 d) { return d.z > 0.75f ? 1.0f / (2 * kPi * 0.25f) : 0.0f; });
}

TEST(Warp, DiskAndTriangleAreUniform) {
  constexpr int kSide = 64;  // a grid: moments are exact up to its spacing
  double r2 = 0, b1 = 0, b2 = 0, b12 = 0;
  for (int i = 0; i < kSide * kSide; ++i) {
    const vec2 u((i % kSide + 0.5f) / kSide, (i / kSide + 0.5f) / kSide);
    const vec2 d = square_to_disk(u), b = square_to_triangle(u);
    EXPECT_LE(dot(d, d), 1.0f + 1e-6f);
    EXPECT_TRUE(b.x >= 0 && b.y >= 0 && b.x + b.y <= 1.0f + 1e-6f);
    r2 += dot(d, d) / (kSide * kSide);
    b1 += b.x / (kSide * kSide);
    b2 += b.y / (kSide * kSide);
    b12 += b.x * b.y / (kSide * kSide);
  }
  EXPECT_NEAR(r2, 0.5, 1e-3);
  EXPECT_NEAR(b1, 1.0 / 3, 1e-3);
  EXPECT_NEAR(b2, 1.0 / 3, 1e-3);
  EXPECT_NEAR(b12, 1.0 / 12, 1e-3);
}

}  // namespace
}  // namespace janus::test
