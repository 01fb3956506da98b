// SPDX-License-Identifier: GPL-3.0-or-later
//
// Scenes at one time of the shutter, and the times that a picture is taken at.
#include "janus/render/time_slice.h"

#include <gtest/gtest.h>

#include "janus/render/exposure.h"
#include "support/scene_kit.h"

namespace janus::test {
namespace {

constexpr vec3 kDown(0, 0, -1);

float height(const Scene& scene, float x, float y) {
  const auto hit = scene.intersect(Ray{vec3(x, y, 50), kDown});
  return hit ? hit->p.z : -kInfinity;
}

SceneKit moving_plate(std::vector<mat4> keys) {
  SceneKit kit;
  kit.add("plate", plane(2, 1), diffuse(Rgb(0.5f)), keys[keys.size() / 2]);
  kit.builder.set_instance_motion("plate", std::move(keys));
  return kit;
}

TEST(Motion, GoesStraightAndTurnsOnAnArc) {
  const auto turned = [](float angle) { return rotation({0, 0, 1}, angle); };
  const Motion motion({translation({0, 0, 0}), translation({2, 0, 0}) * turned(1),
                       translation({2, 4, 0}) * turned(1) * scaling({3, 1, 5})});
  const auto expect = [&](float time, const mat4& m) {
    const mat4 at = motion.at(time);
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < 4; ++j) {
        EXPECT_NEAR(at[i][j], m[i][j], 1e-5f) << time << " " << i << " " << j;
      }
    }
  };
  expect(0, mat4(1));
  expect(0.125f, translation({0.5f, 0, 0}) * turned(0.25f));
  expect(0.5f, translation({2, 0, 0}) * turned(1));
  expect(0.75f, translation({2, 2, 0}) * turned(1) * scaling({2, 1, 3}));
  expect(1, translation({2, 4, 0}) * turned(1) * scaling({3, 1, 5}));
  expect(2, translation({2, 4, 0}) * turned(1) * scaling({3, 1, 5}));  // no farther
}

// By the shorter way round, where quaternions would go by the longer one.
TEST(Motion, TurnsByTheShorterWay) {
  const Motion motion({rotation({0, 0, 1}, 3.0f), rotation({0, 0, 1}, 3.4f)});
  const mat4 half = motion.at(0.5f), expected = rotation({0, 0, 1}, 3.2f);
  EXPECT_NEAR(half[0][0], expected[0][0], 1e-5f);
  EXPECT_NEAR(half[0][1], expected[0][1], 1e-5f);
}

TEST(Motion, SweepsWhatItCovers) {
  const Bounds box{{1, -1, 0}, {2, 1, 0.5f}};
  for (const auto& keys : {std::vector<mat4>{translation({0, 0, 0}), translation({1, 2, 3})},
                           {mat4(1), rotation({0, 0, 1}, 2), scaling({2, 1, 1})},
                           {scaling({1, 3, 1}), translation({5, 0, 0})}}) {
    const Motion motion(keys);
    const Bounds swept = motion.swept(box);
    for (int i = 0; i <= 100; ++i) {
      const Bounds at = transformed(box, motion.at(0.01f * static_cast<float>(i)));
      EXPECT_TRUE(glm::all(glm::greaterThanEqual(at.lower, swept.lower - 1e-5f))) << i;
      EXPECT_TRUE(glm::all(glm::lessThanEqual(at.upper, swept.upper + 1e-5f))) << i;
    }
  }
  EXPECT_EQ(Motion({mat4(1), translation({1, 0, 0})}).swept(box).upper, vec3(3, 1, 0.5f));
}

TEST(TimeSlice, MovesInstancesAndTheCamera) {
  SceneKit kit = moving_plate({translation({0, 0, 0}), translation({4, 0, 2})});
  kit.add("floor", plane(20, 20), diffuse(Rgb(0.5f)), translation({0, 0, -1}));
  kit.camera({0, 0, 9}, {0, 0, 0});
  kit.builder.set_camera_motion(
      {{translation({0, 0, 9}), -1, 1, -1, 1}, {translation({2, 0, 9}), -2, 2, -2, 4}});
  const auto scene = kit.build();
  EXPECT_TRUE(moves(*scene));
  const auto early = at_time(scene, 0, {}), middle = at_time(scene, 0.5f, {});
  EXPECT_FALSE(moves(*early));
  EXPECT_EQ(height(*scene, 4, 0.1f), 2);
  EXPECT_EQ(height(*early, 0, 0.1f), 0);
  EXPECT_EQ(height(*early, 4, 0.1f), -1);
  EXPECT_EQ(height(*middle, 2, 0.1f), 1);
  EXPECT_EQ(middle->camera.transform[3].x, 1);
  EXPECT_EQ(middle->camera.left, -1.5f);
  EXPECT_EQ(middle->camera.top, 2.5f);
  EXPECT_EQ(middle->accel->built(), 0u);  // each mesh has its hierarchy
}

// Where a scene is made of what stands as it does at that time, hits are the same to the last bit.
TEST(TimeSlice, IsTheSceneOfThatTime) {
  const mat4 a = translation({-1, 0, 0}), b = translation({1, 2, 0.5f});
  const auto slice = at_time(moving_plate({a, b}).build(), 0.25f, {});
  SceneKit kit;
  kit.add("plate", plane(2, 1), diffuse(Rgb(0.5f)), translation({-0.5f, 0.5f, 0.125f}));
  const auto still = kit.build();
  for (const vec2 p : {vec2(0.1f, 0.3f), vec2(-1.2f, 0.7f), vec2(0.4f, 0.9f)}) {
    const auto x = slice->intersect(Ray{vec3(p, 3), kDown});
    const auto y = still->intersect(Ray{vec3(p, 3), kDown});
    ASSERT_TRUE(x && y);
    EXPECT_EQ(x->p, y->p);
    EXPECT_EQ(x->ng, y->ng);
    EXPECT_EQ(x->offset, y->offset);
  }
}

TEST(TimeSlice, DeformsMeshes) {
  MeshDesc mesh = plane(2, 2);
  mesh.vertex_normals.assign(4, vec3(0, 0, 1));
  MeshKey flat{mesh.positions, mesh.vertex_normals}, tilted = flat;
  for (size_t i = 0; i < 4; ++i) {
    tilted.positions[i].z = 1 + tilted.positions[i].x;
    tilted.normals[i] = normalize(vec3(-1, 0, 1));
  }
  mesh.motion = {flat, tilted};
  SceneKit kit;
  kit.add("sheet", mesh, diffuse(Rgb(0.5f)));
  const auto scene = kit.build(), half = at_time(scene, 0.5f, {});
  EXPECT_EQ(height(*scene, 0.5f, 0.25f), 0);  // the mesh itself, which is of the centre
  EXPECT_NEAR(height(*half, 0.5f, 0.25f), 0.75f, 1e-6f);
  EXPECT_EQ(half->accel->built(), 1u);
  EXPECT_EQ(&half->shapes[0]->mesh()->triangles(), &scene->shapes[0]->mesh()->triangles());
  const auto hit = half->intersect(Ray{vec3(0.5f, 0.25f, 9), kDown});
  EXPECT_NEAR(glm::length(hit->ns), 1, 1e-6f);
  EXPECT_NEAR(hit->ns.x, normalize(vec3(0, 0, 1) + normalize(vec3(-1, 0, 1))).x, 1e-6f);
  EXPECT_NEAR(hit->ng.x, normalize(vec3(-0.5f, 0, 1)).x, 1e-6f);
}

// Lights that move are other lights under their old numbers; the others are shared.
TEST(TimeSlice, MovesLights) {
  SceneKit kit =
      moving_plate({translation({0, 0, 0}), translation({0, 0, 1}) * scaling({3, 1, 1})});
  kit.builder.set_material("plate", {"plate", emission(Rgb(1), 1)});
  kit.add("still", plane(1, 1), emission(Rgb(2), 1), translation({9, 0, 0}));
  kit.light("lamp", point_light({0, 0, 3}, 10));
  const auto scene = kit.build(), early = at_time(scene, 0, {}), late = at_time(scene, 1, {});
  ASSERT_EQ(early->lights.size(), scene->lights.size());
  const int plate = scene->instances[0].light;
  ASSERT_EQ(scene->lights[plate]->name, "plate");
  EXPECT_NEAR(late->lights[plate]->power() / early->lights[plate]->power(), 3, 1e-5);
  EXPECT_EQ(late->lights[plate]->name, "plate");
  for (size_t i = 0; i < scene->lights.size(); ++i) {
    EXPECT_EQ(early->lights[i] == scene->lights[i], i != static_cast<size_t>(plate));
  }
}

TEST(TimeSlice, NamesMotionThatIsNone) {
  SceneKit kit;
  kit.add("thing", plane(1, 1), {});
  EXPECT_THROW(kit.builder.set_instance_motion("other", {}), SceneError);
  EXPECT_THROW(kit.builder.set_mesh_motion("other", {}), SceneError);
  kit.builder.set_instance_motion("thing", {mat4(1), scaling({1, 0, 1})});
  auto scene = kit.build();
  ASSERT_EQ(scene->diagnostics.size(), 1u);
  EXPECT_EQ(scene->diagnostics[0].object, "thing");
  EXPECT_FALSE(moves(*scene));
  EXPECT_THROW(kit.builder.set_mesh_motion("thing", {}), SceneError);  // it is in use
  MeshDesc mesh = plane(1, 1);
  const MeshKey here{mesh.positions, {}};
  const auto build = [&](std::vector<MeshKey> motion) {
    kit.builder.set_mesh("thing", plane(1, 1));
    kit.builder.set_mesh_motion("thing", std::move(motion));
    return kit.build();
  };
  EXPECT_THROW(build({here}), SceneError);
  EXPECT_THROW(build({here, {{vec3(0)}, {}}}), SceneError);
  EXPECT_THROW(build({here, {mesh.positions, {vec3(0)}}}), SceneError);
  mesh.positions[1].x = NAN;
  EXPECT_EQ(build({here, {mesh.positions, {}}})->diagnostics.size(), 2u);
  kit.builder.set_mesh("thing", plane(1, 1));
  kit.builder.set_camera_motion({{}, {scaling({0, 1, 1})}});
  EXPECT_THROW(kit.build(), SceneError);
  kit.builder.set_camera_motion({{}});
  EXPECT_THROW(kit.build(), SceneError);
  kit.builder.set_camera_motion({});
  kit.builder.set_shutter({0, 0});
  EXPECT_THROW(kit.build(), SceneError);
}

// --- Times of a picture ---

Exposure exposure(std::vector<float> shutter, uint32_t seed, size_t pixels = 1 << 20) {
  SceneKit kit = moving_plate({mat4(1), translation({1, 0, 0})});
  kit.builder.set_shutter(std::move(shutter));
  return {kit.build(), 64, 64, pixels, true, seed};
}

TEST(Exposure, HasOneTimeWhereNothingMoves) {
  const auto still = SceneKit().add("thing", plane(1, 1), {}).build();
  EXPECT_EQ(Exposure(still, 8, 8, 64, true, 0).times(), 1u);
  const auto moving = moving_plate({mat4(1), translation({1, 0, 0})}).build();
  Exposure frozen(moving, 8, 8, 64, false, 0);
  EXPECT_EQ(frozen.times(), 1u);
  frozen.open(0, 0, {});
  EXPECT_EQ(&frozen.scene(), moving.get());
  EXPECT_EQ(Exposure(moving, 8, 8, 80, true, 0).times(), 16u);
}

// Where there is much to build for each time, there are fewer of them.
TEST(Exposure, HasFewerTimesOfLargeMeshes) {
  MeshDesc mesh = ball(1, 64);
  mesh.motion = {{mesh.positions, {}}, {mesh.positions, {}}};
  const size_t triangles = mesh.triangles.size();
  const auto scene = SceneKit().add("ball", mesh, {}).build();
  EXPECT_EQ(Exposure(scene, 64, 64, 100 * triangles, true, 0).times(), 16u);
  EXPECT_EQ(Exposure(scene, 64, 64, 50 * triangles, true, 0).times(), 9u);
  EXPECT_EQ(Exposure(scene, 64, 64, triangles, true, 0).times(), 4u);
}

// The share of times before `until`, of the waves of a pass and of a wave's passes.
TEST(Exposure, SpreadsItsTimes) {
  for (const uint32_t seed : {0u, 1u, 77u}) {
    const Exposure even = exposure({}, seed);
    const Exposure late = exposure({0, 0, 1, 3}, seed);  // 1/4 from 0.5 to 0.75, 3/4 after
    for (const float until : {0.2f, 0.5f, 0.6f, 0.9f}) {
      const float expected = until < 0.5f    ? 0.0f
                             : until < 0.75f ? until - 0.5f
                                             : 0.25f + 3 * (until - 0.75f);
      int of_pass = 0, of_wave = 0, of_late = 0;
      for (int i = 0; i < 64; ++i) {
        of_pass +=
            even.time(5, static_cast<size_t>(i) % 16 + 16 * (static_cast<size_t>(i) / 16)) < until;
        of_wave += even.time(i, 3) < until;
        of_late += late.time(i, 3) < until;
      }
      EXPECT_NEAR(of_pass / 64.0, until, 0.04) << seed;
      EXPECT_NEAR(of_wave / 64.0, until, 0.04) << seed;
      EXPECT_NEAR(of_late / 64.0, expected, 0.04) << seed;
    }
  }
  EXPECT_NE(exposure({}, 0).time(0, 0), exposure({}, 1).time(0, 0));
}

}  // namespace
}  // namespace janus::test
