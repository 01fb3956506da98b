// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/light/scene_box.h"

#include "support/statistics.h"

namespace janus::test {
namespace {

const Bounds kBounds{{-1, -2, 0.5f}, {3, 5, 1.5f}};

// As many parallel rays pass a small ball as its share of the outline, wherever it is.
TEST(SceneBox, SpreadsRaysEvenlyOverItsOutline) {
  constexpr int kRays = 200000;
  const SceneBox box(kBounds);
  Random random(5);
  for (int trial = 0; trial < 12; ++trial) {
    const vec3 direction = trial == 0 ? vec3(0, 0, -1) : random.direction();
    const float radius = 0.3f;
    vec3 ball;
    for (int i = 0; i < 3; ++i) {
      ball[i] = random.in(kBounds.lower[i] + radius, kBounds.upper[i] - radius);
    }
    int passed = 0;
    for (int i = 0; i < kRays; ++i) {
      const vec3 origin = box.sample_entry(direction, random.next_2d());
      const vec3 to_ball = ball - origin;
      const float along = dot(to_ball, direction);
      passed += along > 0.0f && glm::length(to_ball - along * direction) < radius;
    }
    const double share = kPi * radius * radius / box.area(direction);
    EXPECT_NEAR(passed, kRays * share, 4.5 * std::sqrt(kRays * share)) << trial;
  }
}

TEST(SceneBox, MeanAreaIsTheMean) {
  const SceneBox box(kBounds);
  Random random(6);
  Mean area;
  for (int i = 0; i < 100000; ++i) {
    area.add(box.area(random.direction()));
  }
  EXPECT_NEAR(area.mean(), box.mean_area(), 4.5 * area.error());
}

TEST(SceneBox, EveryRayHasADensity) {
  const Bounds flat{{-1, -1, 0}, {1, 1, 0}};
  for (const Bounds& bounds : {Bounds{}, flat}) {
    const SceneBox box(bounds);
    for (const vec3 direction : {vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1)}) {
      EXPECT_GT(box.area(direction), 0.0f);
      EXPECT_TRUE(is_finite(box.sample_entry(direction, vec2(0.999999f, 0.5f))));
    }
  }
}

}  // namespace
}  // namespace janus::test
