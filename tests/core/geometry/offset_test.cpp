// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rays start just far enough off a surface: never on the wrong side of it, and near enough for
// contact shadows of millimetres on floors of kilometres.
#include <gtest/gtest.h>

#include "janus/geometry/accel.h"
#include "janus/math/frame.h"
#include "janus/math/warp.h"
#include "support/scene_kit.h"
#include "support/statistics.h"

namespace janus::test {
namespace {

enum class Shape { Regular, Needle, Cap };

MeshDesc triangle(Shape shape, Random& random) {
  const vec3 a = random.direction(), b = random.direction(), center = random.next() * a;
  const float thin = std::exp(random.in(-9.0f, 0.0f));
  MeshDesc mesh;
  switch (shape) {
    case Shape::Regular:
      mesh.positions = {a, b, random.direction()};
      break;
    case Shape::Needle:
      mesh.positions = {a, a + thin * random.direction(), b};
      break;
    case Shape::Cap:
      mesh.positions = {a, b, glm::mix(a, b, random.next()) + thin * random.direction()};
      break;
  }
  for (vec3& p : mesh.positions) {
    p += center;
  }
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

mat4 placement(float size, float distance, Random& random) {
  const auto turned = [&] { return rotation(random.direction(), random.in(0, 6)); };
  const vec3 uneven(std::exp(random.in(-3, 3)), -std::exp(random.in(-3, 3)), 1.0f);
  return translation(size * distance * random.direction()) * turned() * scaling(size * uneven) *
         turned();
}

class LoneTriangle : public ::testing::TestWithParam<std::tuple<Shape, float, float>> {};

// Nothing but one triangle: whatever leaves it, to either side, meets nothing.
TEST_P(LoneTriangle, IsNeverInItsOwnWay) {
  const auto& [shape, size, distance] = GetParam();
  Random random(30);
  int hits = 0;
  for (int i = 0; i < 60; ++i) {
    const auto scene =
        SceneKit().add("t", triangle(shape, random), {}, placement(size, distance, random)).build();
    for (int k = 0; k < 500; ++k) {
      const SurfaceInteraction p =
          scene->accel->surface_point(0, 0, square_to_triangle(random.next_2d()));
      const float side = random.next() < 0.5f ? 1.0f : -1.0f;
      const vec3 d = Frame(side * p.ng).to_world(square_to_cosine_hemisphere(random.next_2d()));
      const vec3 origin = offset_origin(p.p, p.ng, p.offset, d);
      hits += scene->intersect(Ray{origin, d}).has_value();
      hits += scene->occluded(origin, origin + random.next() * size * d);
    }
  }
  // The plane of a flat, obtuse triangle is hardly known: its offset is bounded by its width.
  EXPECT_LE(hits, shape == Shape::Cap ? 10 : 0);
}

// Seen from up to a million times its size away: the shadow ray ends before it.
TEST_P(LoneTriangle, IsSeenFromAfar) {
  const auto& [shape, size, distance] = GetParam();
  Random random(32);
  int hits = 0;
  for (int i = 0; i < 60; ++i) {
    const auto scene =
        SceneKit().add("t", triangle(shape, random), {}, placement(size, distance, random)).build();
    for (int k = 0; k < 500; ++k) {
      const SurfaceInteraction p =
          scene->accel->surface_point(0, 0, square_to_triangle(random.next_2d()));
      const float side = random.next() < 0.5f ? 1.0f : -1.0f;
      const vec3 d = Frame(side * p.ng).to_world(square_to_cosine_hemisphere(random.next_2d()));
      const vec3 viewer = p.p + size * std::exp(random.in(0, 14)) * d;
      hits += scene->occluded(viewer, offset_origin(p.p, p.ng, p.offset, viewer - p.p));
    }
  }
  EXPECT_LE(hits, 3);
}

INSTANTIATE_TEST_SUITE_P(Offset, LoneTriangle,
                         ::testing::Combine(::testing::Values(Shape::Regular, Shape::Needle,
                                                              Shape::Cap),
                                            ::testing::Values(1e-3f, 1.0f, 1e3f),
                                            ::testing::Values(0.0f, 1.0f, 1000.0f)));

// No rounding at all is no excuse either: planes through the origin, along the axes.
TEST(Offset, PlanesWithoutError) {
  Random random(33);
  for (const float size : {1e-3f, 1.0f, 1e3f}) {
    for (const mat4& m : {mat4(1), scaling(vec3(size)), scaling({size, 3 * size, 0.1f})}) {
      const auto scene = SceneKit().add("plane", plane(size, 2 * size), {}, m).build();
      for (int i = 0; i < 1000; ++i) {
        const SurfaceInteraction p =
            scene->accel->surface_point(0, i % 2, square_to_triangle(random.next_2d()));
        const vec3 d = random.direction();
        const vec3 origin = offset_origin(p.p, p.ng, p.offset, d);
        ASSERT_FALSE(scene->intersect(Ray{origin, d}));
        ASSERT_FALSE(scene->occluded(origin, origin + d));
        ASSERT_FALSE(scene->occluded(origin + d, origin));
      }
    }
  }
}

// A millimetre on a floor of a kilometre.
TEST(Offset, ContactShadowsOnLargeFloors) {
  for (const float height : {0.0f, 0.3f, 17.0f}) {
    for (const bool in_mesh : {false, true}) {
      for (const float turn : {0.0f, 0.7f}) {
        const float size = 1000.0f, s = in_mesh ? size : 1.0f;
        const mat4 m =
            translation({3, 5, height}) * rotation({0, 0, 1}, turn) * scaling(vec3(size / s));
        const auto scene =
            SceneKit()
                .add("floor", plane(s, s), {}, m)
                .add("crumb", cuboid(vec3(-5e-4f, -5e-4f, 0), vec3(5e-4f, 5e-4f, 1e-3f)), {},
                     translation({40, -7, height}))
                .build();
        // A floor point just before the crumb, and light from low behind it.
        const auto hit = scene->intersect(Ray{vec3(40.0007f, -7, height + 1), vec3(0, 0, -1)});
        ASSERT_TRUE(hit);
        EXPECT_EQ(hit->instance, 1u);  // "crumb" comes first
        EXPECT_LT(hit->offset, 1e-5f);
        const vec3 d = normalize(vec3(-1, 0, 0.2f));
        const vec3 origin = offset_origin(hit->p, hit->ng, hit->offset, d);
        EXPECT_TRUE(scene->occluded(origin, origin + 10.0f * d));
        EXPECT_TRUE(scene->intersect(Ray{origin, d}));
      }
    }
  }
}

TEST(Offset, ScalesWithTheScene) {
  Random random(31);
  const MeshDesc mesh = triangle(Shape::Regular, random);
  const mat4 m = placement(1.0f, 2.0f, random);
  const auto offset = [&](const mat4& to_world) {
    return SceneKit().add("t", mesh, {}, to_world).build()->accel->surface_point(0, 0, {}).offset;
  };
  for (const float s : {1e-3f, 1e3f}) {
    EXPECT_NEAR(offset(scaling(vec3(s)) * m) / (s * offset(m)), 1.0f, 1e-3f);
  }
}

}  // namespace
}  // namespace janus::test
