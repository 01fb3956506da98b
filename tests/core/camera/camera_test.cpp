// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/camera/camera.h"

#include <gtest/gtest.h>

#include "support/scene_kit.h"
#include "support/statistics.h"

namespace janus::test {
namespace {

constexpr int kWidth = 40, kHeight = 30;

CameraDesc shifted_camera() {  // off-centre window, scaled object, pixels that are not square
  CameraDesc desc;
  desc.transform = look_at({1, -2, 3}, {0.3f, 0.2f, 0}) * scaling({2, 3, 0.5f});
  desc.left = -0.3f, desc.right = 0.6f, desc.bottom = -0.5f, desc.top = 0.2f;
  desc.clip_start = 0.5f, desc.clip_end = 20;
  return desc;
}

TEST(Camera, ConnectInvertsSampleRay) {
  const auto camera = make_camera(shifted_camera(), kWidth, kHeight);
  Random random(6);
  for (int i = 0; i < 1000; ++i) {
    const vec2 raster = random.next_2d() * vec2(kWidth, kHeight);
    const CameraRay ray = camera->sample_ray(raster, vec2(0.5f));
    const vec3 p = ray.ray.origin + random.in(0.01f, 0.99f) * ray.ray.t_max * ray.ray.direction;
    const auto c = camera->connect(p, vec2(0.5f), 1e-3f);
    ASSERT_TRUE(c);
    EXPECT_NEAR(c->raster.x, raster.x, 1e-3);
    EXPECT_NEAR(c->raster.y, raster.y, 1e-3);
    EXPECT_NEAR(c->density.value / ray.density.value, 1, 1e-5);
    EXPECT_NEAR(glm::length(c->wo + ray.ray.direction), 0, 1e-5);
    EXPECT_NEAR(glm::length(c->target - ray.ray.origin), 0, 1e-4);
    EXPECT_NEAR(c->distance2 / length2(p - ray.lens), 1, 1e-5);
  }
}

// One film position per pixel: over the sphere, the density integrates to the number of pixels.
TEST(Camera, DensityIsPerPixel) {
  const auto camera = make_camera(shifted_camera(), kWidth, kHeight);
  const vec3 center = camera->sample_ray(vec2(0), vec2(0.5f)).lens;
  double sum = 0;
  constexpr int kCells = 1500;
  for (int i = 0; i < kCells; ++i) {
    const float z = -1 + 2 * (i + 0.5f) / kCells, r = std::sqrt(1 - z * z);
    for (int j = 0; j < kCells; ++j) {
      const float phi = 2 * kPi * (j + 0.5f) / kCells;
      const auto c = camera->connect(center + 5.0f * vec3(r * std::cos(phi), r * std::sin(phi), z),
                                     vec2(0.5f), 0.0f);
      sum += c ? c->density.value : 0.0;
    }
  }
  EXPECT_NEAR(sum * 4 * kPi / (kCells * kCells) / (kWidth * kHeight), 1, 0.003);
}

TEST(Camera, ClipsAndCrops) {
  const CameraDesc desc = shifted_camera();
  const auto camera = make_camera(desc, kWidth, kHeight);
  const CameraRay ray = camera->sample_ray(vec2(3, 4), vec2(0.5f));
  const vec3 axis = -normalize(vec3(desc.transform[2]));
  const vec3 d = ray.ray.direction / dot(ray.ray.direction, axis);  // per unit of depth
  EXPECT_FALSE(camera->connect(ray.lens + 0.499f * d, vec2(0.5f), 0));
  EXPECT_TRUE(camera->connect(ray.lens + 0.501f * d, vec2(0.5f), 0));
  EXPECT_TRUE(camera->connect(ray.lens + 19.99f * d, vec2(0.5f), 0));
  EXPECT_FALSE(camera->connect(ray.lens + 20.01f * d, vec2(0.5f), 0));
  EXPECT_FALSE(camera->connect(ray.lens - 5.0f * d, vec2(0.5f), 0));  // behind
  const CameraRay out = camera->sample_ray(vec2(-1.5f, 4), vec2(0.5f));
  EXPECT_FALSE(camera->connect(out.ray.origin + out.ray.direction, vec2(0.5f), 1.0f));
  EXPECT_TRUE(camera->connect(out.ray.origin + out.ray.direction, vec2(0.5f), 2.0f));
}

}  // namespace
}  // namespace janus::test
