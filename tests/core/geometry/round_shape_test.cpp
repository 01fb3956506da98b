// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/geometry/round_shape.h"

#include <gtest/gtest.h>

#include "janus/util/error.h"
#include "support/pictures.h"
#include "support/scene_kit.h"
#include "support/statistics.h"

namespace janus::test {
namespace {

const mat4 kPlace = translation({3, -2, 5}) * rotation({1, 2, 3}, 0.7f) * scaling({2, 2, 2});

std::shared_ptr<const Scene> scene_of(RoundDesc shape, const mat4& place = mat4(1.0f)) {
  return SceneKit().add("shape", std::move(shape), std::nullopt, place).build();
}

vec3 at(const mat4& m, vec3 p) { return vec3(m * vec4(p, 1.0f)); }

RoundDesc wavy(float radius) {
  return strand({{0, 0, 0}, {1, 0.4f, 0}, {2, -0.3f, 0.2f}, {3, 0.1f, 0.5f}}, radius);
}

TEST(RoundShape, BallIsAsLargeAsItSays) {
  const auto scene = scene_of(balls({{0, 0, 0}, {4, 0, 0}}, 0.25f), kPlace);
  Random random(1);
  for (int i = 0; i < 500; ++i) {
    const vec3 d = random.direction();
    const vec3 center = at(kPlace, i % 2 ? vec3(4, 0, 0) : vec3(0.0f));
    const auto hit = scene->intersect(Ray{center - 2.0f * d, d});
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->primitive, static_cast<uint32_t>(i % 2));
    EXPECT_NEAR(glm::length(hit->p - center), 0.5f, 1e-5f);
    EXPECT_GT(dot(hit->ng, normalize(hit->p - center)), 1.0f - 1e-5f);
    EXPECT_GT(dot(hit->ng, hit->ns), 1.0f - 1e-6f);
  }
}

TEST(RoundShape, TubeIsAsThickAsItSays) {
  for (const bool straight : {false, true}) {
    RoundDesc desc = wavy(0.05f);
    desc.straight = straight;
    const RoundShape shape("wave", RoundDesc(desc));
    const auto scene = scene_of(desc, kPlace);
    Random random(2);
    int hits = 0;
    for (int i = 0; i < 2000; ++i) {
      const auto piece = static_cast<uint32_t>(i % 3);
      const vec3 target = at(kPlace, shape.place(piece, random.in(0.1f, 0.9f)).center);
      const vec3 d = random.direction();
      const auto hit = scene->intersect(Ray{target - 1.5f * d, d});
      if (!hit || hit->primitive >= shape.pieces().size()) {  // past it, or on its end
        continue;
      }
      ++hits;
      const auto place = shape.place(hit->primitive, hit->barycentric.x);
      const vec3 center = at(kPlace, place.center);
      EXPECT_NEAR(glm::length(hit->p - center), 0.1f, 1e-4f);
      EXPECT_LE(dot(hit->ng, d), 1e-3f);
      EXPECT_GT(dot(hit->ns, normalize(hit->p - center)), 0.999f);
      EXPECT_GT(dot(hit->ng, hit->ns), 0.999f);  // it does not grow thinner
    }
    EXPECT_GT(hits, 1800);
  }
}

// Where a tube grows thinner, the geometric normal leans and the shading normal does not.
TEST(RoundShape, ConeHasALeaningNormal) {
  RoundDesc cone = strand({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, 0.0f);
  cone.radii = {0.4f, 0.2f, 0.0f};
  const auto scene = scene_of(cone);
  const auto hit = scene->intersect(Ray{{1.0f, -3, 0}, {0, 1, 0}});
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->p.y, -0.2f, 1e-3f);
  EXPECT_NEAR(hit->ns.x, 0.0f, 1e-3f);
  EXPECT_NEAR(hit->ng.x, std::sin(std::atan(0.2f)), 5e-3f);
}

TEST(RoundShape, IsNotSeenFromWithin) {
  const auto ball = scene_of(balls({{0, 0, 0}}, 1.0f));
  EXPECT_FALSE(ball->intersect(Ray{{0.1f, 0.2f, 0}, {1, 0, 0}}));
  EXPECT_FALSE(ball->occluded({0, 0, 0}, {5, 0, 0}));
  EXPECT_TRUE(ball->occluded({5, 0, 0}, {0, 0, 0}));
  const auto tube = scene_of(strand({{-3, 0, 0}, {0, 0, 0}, {3, 0, 0}}, 0.5f));
  EXPECT_FALSE(tube->intersect(Ray{{0, 0, 0.1f}, normalize(vec3(0.2f, 1, 0))}));
  EXPECT_TRUE(tube->intersect(Ray{{0, -2, 0.1f}, normalize(vec3(0.2f, 1, 0))}));
}

// Two points see each other or they do not, whichever looks: the ends of tubes are closed.
TEST(RoundShape, IsSeenAlikeFromBothEndsOfARay) {
  for (const bool straight : {false, true}) {
    RoundDesc desc = wavy(0.3f);
    desc.straight = straight;
    desc.radii[2] = 0.1f;
    const auto scene = scene_of(desc, kPlace);
    Random random(5);
    int blocked = 0;
    for (int i = 0; i < 4000; ++i) {
      const vec3 middle = at(kPlace, vec3(random.in(-0.2f, 3.2f), random.in(-0.4f, 0.4f), 0.1f));
      const vec3 d = random.direction();
      const vec3 a = middle - 9.0f * d, b = middle + 9.0f * d;
      const bool there = scene->occluded(a, b);
      EXPECT_EQ(there, scene->occluded(b, a)) << i;
      blocked += there;
    }
    EXPECT_GT(blocked, 1000);
    EXPECT_LT(blocked, 3900);
  }
}

TEST(RoundShape, DiskAtTheEnd) {
  const auto scene = scene_of(strand({{0, 0, 0}, {2, 0, 0}}, 0.5f), kPlace);
  const vec3 from = at(kPlace, {3, 0.3f, 0.1f});
  const vec3 d = normalize(vec3(kPlace * vec4(-1, 0, 0, 0)));
  const auto hit = scene->intersect(Ray{from, d});
  ASSERT_TRUE(hit);
  EXPECT_LT(glm::length(hit->p - at(kPlace, {2, 0.3f, 0.1f})), 1e-5f);
  EXPECT_GT(dot(hit->ng, -d), 1.0f - 1e-6f);
  EXPECT_GT(dot(hit->ns, -d), 1.0f - 1e-6f);
  EXPECT_EQ(hit->primitive, 2u);  // behind the piece and the other disk
}

// It is no light that anybody looks for, but walks that meet it find its light.
TEST(RoundShape, Shines) {
  const auto scene = SceneKit()
                         .add("ball", balls({{0, 0, 0}}, 0.5f), emission(Rgb(1, 2, 3), 1))
                         .camera({0, -2, 0}, {0, 0, 0}, 0.1f)
                         .build();
  ASSERT_EQ(scene->lights.size(), 1u);
  EXPECT_EQ(scene->lights[0]->power(), 0.0f);
  for (const auto integrator : {IntegratorType::PathTracer, IntegratorType::Bdpt}) {
    EXPECT_NEAR(quarters(scene, small_picture(integrator, 4), 4)[0].mean(), luminance(Rgb(1, 2, 3)),
                1e-4);
  }
}

// A ray that leaves does not meet where it started, outward or inward, near the origin or far.
TEST(RoundShape, RaysLeave) {
  for (const float far : {0.0f, 100.0f}) {
    const mat4 place = translation({far, -far, 2 * far}) * rotation({1, 2, 3}, 0.7f);
    const float radius = far > 0.0f ? 0.005f : 1e-4f;
    const auto scene = scene_of(strand({{-1, 0, 0}, {0, 0, 0}, {1, 0, 0}}, radius), place);
    Random random(3);
    for (int i = 0; i < 1000; ++i) {
      vec3 d = random.direction();
      d = normalize(vec3(0.3f * d.x, d.y, d.z));
      const vec3 target = at(place, vec3(random.in(-0.5f, 0.5f), 0, 0));
      const auto hit = scene->intersect(Ray{target - 0.5f * d, d});
      if (!hit) {
        continue;
      }
      const vec3 leaving = random.direction();
      const vec3 origin = offset_origin(hit->p, hit->ng, hit->offset, leaving);
      EXPECT_FALSE(scene->intersect(Ray{origin, leaving})) << i;
    }
  }
}

TEST(RoundShape, BoundsEncloseItAtAllTimes) {
  RoundDesc desc = wavy(0.1f);
  desc.motion = {{desc.positions, {}}, {desc.positions, {}}};
  for (vec3& p : desc.motion[1].positions) {
    p += vec3(0, 0, 2);
  }
  const RoundShape shape("wave", std::move(desc));
  EXPECT_TRUE(shape.moves());
  for (const float time : {0.0f, 0.3f, 1.0f}) {
    const auto now = shape.at(time);
    for (uint32_t piece = 0; piece < shape.primitives(); ++piece) {
      for (float u = 0; u <= 1.0f; u += 0.05f) {
        const auto place = now->round()->place(piece, u);
        EXPECT_NEAR(place.center.z - shape.place(piece, u).center.z, 2 * time, 1e-5f);
        const vec3 lower = place.center - place.radius, upper = place.center + place.radius;
        EXPECT_LE(max_component(shape.bounds().lower - lower), 1e-5f);
        EXPECT_LE(max_component(upper - shape.bounds().upper), 1e-5f);
      }
    }
  }
}

TEST(RoundShape, CurvesGoThroughTheirKeys) {
  const std::vector<vec3> keys = wavy(0.1f).positions;
  const RoundShape shape("wave", wavy(0.1f));
  ASSERT_EQ(shape.pieces().size(), keys.size() - 1);
  for (uint32_t i = 0; i < shape.pieces().size(); ++i) {
    EXPECT_LT(glm::length(shape.place(i, 0.0f).center - keys[i]), 1e-6f);
    EXPECT_LT(glm::length(shape.place(i, 1.0f).center - keys[i + 1]), 1e-6f);
    EXPECT_NEAR(shape.place(i, 0.5f).radius, 0.1f, 1e-6f);
    const float step = 1e-3f;
    const vec3 slope =
        (shape.place(i, 0.5f + step).center - shape.place(i, 0.5f - step).center) / (2 * step);
    EXPECT_LT(glm::length(slope - shape.place(i, 0.5f).along), 1e-3f);
  }
}

TEST(RoundShape, AttributesOfPointsAndCurves) {
  RoundDesc desc = wavy(0.1f);
  desc.attributes = {{"along", AttributeDomain::Point, 1, {0, 1, 2, 3}},
                     {"curve", AttributeDomain::Face, 1, {7}}};
  const RoundShape shape("wave", std::move(desc));
  ShadingPoint point{};
  const AttributeDesc* attributes[] = {shape.attribute("along"), shape.attribute("curve")};
  point.attributes = attributes;
  point.triangle = shape.indices(1);
  point.barycentric = vec2(0.25f, 0.0f);
  EXPECT_FLOAT_EQ(point.attribute(0).x, 1.25f);
  EXPECT_FLOAT_EQ(point.attribute(1).x, 7.0f);
}

TEST(RoundShape, LeavesOutWhatIsNothing) {
  RoundDesc desc =
      strand({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}, {NAN, 0, 0}}, 0.1f);
  desc.curves = {0, 2, 3, 3, 4, 6};  // a curve, single keys, none, one that is not finite
  desc.material_indices = {0, 1, 2, 3, 4};
  const RoundShape shape("hair", std::move(desc));
  EXPECT_EQ(shape.pieces().size(), 1u);
  EXPECT_EQ(shape.disks().size(), 2u);
  ASSERT_EQ(shape.diagnostics().size(), 1u);
  EXPECT_EQ(shape.diagnostics()[0].message, "1 curves that are not finite are left out");
  RoundDesc thin = balls({{0, 0, 0}, {1, 0, 0}}, 0.1f);
  thin.radii[0] = 0.0f;
  EXPECT_EQ(RoundShape("points", std::move(thin)).primitives(), 1u);
}

TEST(RoundShape, WrongLengthsAreNamed) {
  const auto path_of = [](RoundDesc desc) {
    try {
      RoundShape("hair", std::move(desc));
    } catch (const SceneError& error) {
      return error.path;
    }
    return std::string("none");
  };
  RoundDesc desc = wavy(0.1f);
  desc.radii.pop_back();
  EXPECT_EQ(path_of(desc), "radii");
  desc = wavy(0.1f);
  desc.curves = {0, 3};
  EXPECT_EQ(path_of(desc), "curves");
  desc.curves = {0, 4, 2, 4};
  EXPECT_EQ(path_of(desc), "curves");
  desc = wavy(0.1f);
  desc.material_indices = {0, 0};
  EXPECT_EQ(path_of(desc), "material_indices");
  desc = wavy(0.1f);
  desc.attributes = {{"a", AttributeDomain::Point, 1, {1, 2}}};
  EXPECT_EQ(path_of(desc), "attributes[a]");
  desc.attributes = {{"a", AttributeDomain::Corner, 1, {1, 2, 3, 4}}};
  EXPECT_EQ(path_of(desc), "attributes[a]");
  desc = wavy(0.1f);
  desc.motion = {{desc.positions, {}}, {{vec3(0.0f)}, {}}};
  EXPECT_EQ(path_of(desc), "motion");
}

}  // namespace
}  // namespace janus::test
