// SPDX-License-Identifier: GPL-3.0-or-later
//
// Commits of a builder after the first, and on threads of their own.
#include "janus/render/commit_task.h"

#include <gtest/gtest.h>

#include "janus/util/error.h"
#include "support/scene_kit.h"

namespace janus::test {
namespace {

// What has not changed is shared with the scene before, and nobody sees it in the picture.
TEST(Commit, SharesMeshesWithTheSceneBefore) {
  SceneKit kit;
  kit.add("ball", ball(1, 16, true), {}).add("floor", plane(4, 4), {});
  auto first = kit.build();
  EXPECT_EQ(first->accel->built(), 2u);
  kit.add("floor", plane(4, 4), {}, translation({0, 0, -1}));  // set again: another mesh
  InstanceDesc moved;
  moved.mesh = "ball";
  moved.transform = translation({3, 0, 0});
  kit.builder.set_instance("ball", moved);
  auto second = kit.build();
  EXPECT_EQ(second->accel->built(), 1u);
  EXPECT_EQ(second->shapes[0], first->shapes[0]);
  EXPECT_NE(second->shapes[1], first->shapes[1]);
  const auto hits = [](const Scene& scene, float x, float height) {
    const auto hit = scene.intersect(Ray{vec3(x, 0.01f, 9), vec3(0, 0, -1)});
    return hit && std::abs(hit->p.z - height) < 0.01f;
  };
  EXPECT_TRUE(hits(*first, 0, 1));
  EXPECT_TRUE(hits(*second, 3, 1));
  EXPECT_TRUE(hits(*second, 0, -1));
  first.reset();  // the hierarchies that are shared outlive the scene that built them
  EXPECT_TRUE(hits(*second, 3, 1));
  const auto third = kit.build();
  EXPECT_EQ(third->accel->built(), 0u);
  second.reset();
  EXPECT_TRUE(hits(*third, 3, 1));
  kit.builder.remove("ball");
  kit.builder.remove("floor");
  EXPECT_TRUE(hits(*third, 3, 1));
}

TEST(Commit, RepeatsWhatIsToBeSaidOfSharedMeshes) {
  MeshDesc mesh = plane(1, 1);
  add_quad(mesh, {0, 0, 1}, {1, 0, NAN}, {1, 1, 1}, {0, INFINITY, 1});
  const SceneKit kit = SceneKit().add("thing", mesh, {});
  const auto first = kit.build(), second = kit.build();
  EXPECT_EQ(second->accel->built(), 0u);
  ASSERT_EQ(second->diagnostics.size(), 1u);
  EXPECT_EQ(second->diagnostics[0], first->diagnostics[0]);
}

TEST(Commit, CommitsOnAThreadOfItsOwn) {
  SceneKit kit = SceneKit().add("thing", ball(1, 64), {});
  CommitTask task(kit.builder);
  kit.builder.remove("thing");  // has no say in it
  EXPECT_EQ(task.scene()->instances.size(), 1u);
  EXPECT_TRUE(task.wait(0.0));
  CommitTask cancelled(SceneKit().add("thing", ball(1, 64), {}).builder);
  cancelled.cancel();
  EXPECT_THROW(cancelled.scene(), Cancelled);
  CommitTask refused((SceneBuilder()));
  EXPECT_THROW(refused.scene(), SceneError);
}

}  // namespace
}  // namespace janus::test
