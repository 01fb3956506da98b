// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/geometry/derived.h"

#include <gtest/gtest.h>

#include "janus/util/error.h"

namespace janus::test {
namespace {

const std::vector<vec3> kSquare = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
const std::vector<glm::uvec2> kRing = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};

TEST(Pointiness, OfAPlaneIsAHalf) {
  for (const float x : pointiness(kSquare, std::vector<vec3>(4, vec3(0, 0, 1)), kRing)) {
    EXPECT_NEAR(x, 0.5f, 1e-6f);
  }
}

TEST(Pointiness, OfATipIsAboveThatOfAPit) {
  // Four edges that go down from a tip at 45 degrees: 3/4 there, before the blur. At the other
  // ends, whose normals point up, the edges go up: 1/4.
  const std::vector<vec3> points = {{0, 0, 1}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
  const std::vector<glm::uvec2> edges = {{0, 1}, {0, 2}, {0, 3}, {0, 4}};
  const std::vector<float> up = pointiness(points, std::vector<vec3>(5, vec3(0, 0, 1)), edges);
  EXPECT_NEAR(up[0], (0.75f + 4 * 0.25f) / 5, 1e-5f);
  EXPECT_NEAR(up[1], (0.25f + 0.75f) / 2, 1e-5f);
  const std::vector<float> down = pointiness(points, std::vector<vec3>(5, vec3(0, 0, -1)), edges);
  EXPECT_NEAR(up[0] + down[0], 1.0f, 1e-5f);
}

TEST(Pointiness, PositionsAtOnePlaceAreOne) {
  // Two squares that share a side, but not its ends.
  const std::vector<vec3> points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                    {1, 0, 0}, {2, 0, 1}, {2, 1, 1}, {1, 1, 0}};
  std::vector<glm::uvec2> edges = kRing;
  for (const glm::uvec2 edge : kRing) {
    edges.push_back(edge + 4u);
  }
  const std::vector<float> found = pointiness(points, std::vector<vec3>(8, vec3(0, 0, 1)), edges);
  EXPECT_EQ(found[1], found[4]);
  EXPECT_EQ(found[2], found[7]);
  EXPECT_NE(found[0], found[1]);
}

TEST(RandomPerIsland, IsTheSameWhereEdgesConnect) {
  const std::vector<float> found = random_per_island(6, {{0, 1}, {4, 2}, {1, 5}});
  EXPECT_EQ(found[0], found[1]);
  EXPECT_EQ(found[0], found[5]);
  EXPECT_EQ(found[2], found[4]);
  EXPECT_NE(found[0], found[2]);
  EXPECT_NE(found[0], found[3]);
  for (const float x : found) {
    EXPECT_GE(x, 0.0f);
    EXPECT_LE(x, 1.0f);
  }
}

TEST(DerivedAttributes, SayWhatTheyLack) {
  MeshDesc desc;
  desc.positions = kSquare;
  desc.triangles = {{0, 1, 2}};
  std::vector<AttributeDesc> wanted = {{"pointiness", AttributeDomain::Point, 1, {}}};
  EXPECT_THROW(derive_attributes("mesh", desc, wanted), SceneError);  // no normals
  wanted[0].key = "random_per_island";
  desc.edges = {{0, 9}};
  EXPECT_THROW(derive_attributes("mesh", desc, wanted), SceneError);
  desc.edges = kRing;
  derive_attributes("mesh", desc, wanted);
  EXPECT_EQ(wanted[0].domain, AttributeDomain::Face);
  EXPECT_EQ(wanted[0].values.size(), 1u);
}

}  // namespace
}  // namespace janus::test
