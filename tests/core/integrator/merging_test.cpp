// SPDX-License-Identifier: GPL-3.0-or-later
//
// Vertex merging: it finds the same light as the other techniques, but for a blur, and finds
// caustics behind a delta with less noise than anything else.
#include <set>

#include "janus/integrator/vertex_grid.h"
#include "support/pictures.h"

namespace janus::test {
namespace {

constexpr float kRadius = 0.03f;
constexpr double kTolerance = 0.03;  // the blur is part of it

RenderSettings merging(int count, float radius = kRadius) {
  RenderSettings settings = small_picture(IntegratorType::Bdpt, samples(count));
  settings.merge_radius = radius;
  return settings;
}

// The camera looks through a slab of glass at light that another slab let through.
SceneKit behind_glass(float lamp) {
  return open_box()
      .add("lens", cuboid({-0.9f, -0.9f, 0.2f}, {0.9f, 0.9f, 0.4f}), glass(Rgb(1), 1.5f))
      .add("window", cuboid({-0.99f, -0.9f, -0.99f}, {0.99f, -0.8f, 0.1f}), glass(Rgb(1), 1.5f))
      .light("l", area_light({0, 0, 0.9f}, {0, 0, 0}, lamp, 20));
}

SceneKit lit_room() { return open_box().light("l", area_light({0, 0, 0.9f}, {0, 0, 0}, 0.5f, 20)); }

TEST(Merging, FindsTheSameLight) { expect_as_path_traced(lit_room(), merging(32), 96, kTolerance); }

TEST(Merging, FindsTheSameCaustics) {
  expect_as_path_traced(behind_glass(0.8f), merging(48), 192, kTolerance);
}

TEST(Merging, NeedsNoConnections) {
  RenderSettings settings = merging(48);
  settings.connections = 0.0f;
  expect_as_path_traced(behind_glass(0.8f), settings, 192, kTolerance);
}

// The camera sees the floor alone.
SceneKit floor_and_ceiling() {
  SceneKit kit;
  kit.add("floor", plane(6.0f, 6.0f), diffuse(Rgb(0.8f)))
      .add("ceiling", plane(6.0f, 6.0f), diffuse(Rgb(0.8f)), translation({0, 0, 2}))
      .light("l", area_light({0, 0, 1.9f}, {0, 0, 0}, 1.5f, 20))
      .camera({0, -0.5f, 1.0f}, {0, 0, 0}, 0.4f);
  return kit;
}

// Large radii: nearly all the light comes from merging, and what is missing or counted twice shows.
TEST(Merging, CountsWhatItMerges) {
  RenderSettings settings = merging(48, 0.15f);
  settings.connections = 0.0f;
  expect_as_path_traced(floor_and_ceiling(), settings, 128, kTolerance);
}

// The two walks come to a leaf from different sides.
TEST(Merging, FindsLightThroughLeaves) {
  SceneKit kit;
  kit.add("leaf", plane(6.0f, 6.0f), single("BSDF_TRANSLUCENT", {}))
      .add("floor", plane(6.0f, 6.0f), diffuse(Rgb(0.8f)), translation({0, 0, -1}))
      .light("l", area_light({0, 0, -0.1f}, {0, 0, -1}, 1.5f, 20))
      .camera({0, -0.5f, 2.0f}, {0, 0, 0}, 0.4f);
  RenderSettings settings = merging(48, 0.1f);
  settings.connections = 0.0f;
  expect_as_path_traced(kit, settings, 128, kTolerance);
}

// Smaller than what positions tell apart: the picture is that without merging.
TEST(Merging, TakesTinyRadii) {
  for (const float radius : {1e-30f, 1e-6f}) {
    expect_as_path_traced(lit_room(), merging(32, radius), 96, kTolerance);
  }
}

// As large as the scene at most, whatever is asked for: blurred, but not dark.
TEST(Merging, TakesHugeRadii) {
  const auto scene = floor_and_ceiling().build();
  const double sharp = quarters(scene, merging(2, 0.0f))[0].mean();
  for (const float radius : {1e6f, 1e30f}) {
    EXPECT_GT(quarters(scene, merging(2, radius), 4)[0].mean(), 0.5 * sharp) << radius;
  }
}

TEST(Merging, KeepsTheRulesOfPaths) {
  const NodeGraph pane =
      combine("MIX_SHADER", diffuse(Rgb(0.7f)),
              single("BSDF_TRANSPARENT", {{"Color", vec4(1, 0.9f, 0.8f, 1)}}), 0.7f);
  const SceneKit kit = behind_glass(0.8f).add("pane", plane(1.8f, 1.8f), pane);
  RenderSettings settings = merging(48);
  settings.max_bounces = 3;
  settings.max_diffuse_bounces = 1;
  settings.transparent_max_bounces = 1;
  expect_as_path_traced(kit, settings, 192, kTolerance);
}

TEST(Merging, ManyWaves) {
  RenderSettings settings = merging(8);
  settings.width = settings.height = 64;
  settings.cache_bytes = 1 << 17;
  const auto scene = behind_glass(0.8f).build();
  RenderSettings pt = small_picture(IntegratorType::PathTracer, samples(192));
  expect_agreement(quarters(scene, settings), quarters(scene, pt), kTolerance);
}

// The light of a small lamp behind glass: paths from the camera hit it by chance alone.
TEST(Merging, ClearsCausticsSeenThroughGlass) {
  const auto scene = behind_glass(0.02f).build();
  const Mean with = quarters(scene, merging(32))[0];
  const Mean without = quarters(scene, merging(32, 0.0f))[0];
  EXPECT_LT(with.error() / with.mean(), 0.2 * without.error() / without.mean());
}

TEST(VertexGrid, FindsWhatALoopFinds) {
  Random random(4);
  VertexCache cache;
  const std::span<CacheBlock> blocks = cache.start(3);
  for (CacheBlock& block : blocks) {
    block.clear();
    for (int i = 0; i < 700; ++i) {
      LightVertex v{};
      v.p = vec3(random.in(-1, 1), random.in(-1, 1), 0.1f * random.in(-1, 1));
      v.edges = static_cast<uint16_t>(1 + i % 3);
      block.vertices.push_back(v);
    }
  }
  cache.finish();
  for (const float radius : {0.01f, 0.1f, 0.7f}) {
    VertexGrid grid;
    grid.build(cache, radius);
    for (int n = 0; n < 100; ++n) {
      const vec3 p(random.in(-1.1f, 1.1f), random.in(-1.1f, 1.1f), 0.0f);
      std::multiset<const LightVertex*> found, expected;
      grid.for_each_near(p, [&](const LightVertex& v) { found.insert(&v); });
      cache.for_each([&](const LightVertex& v) {
        if (v.edges > 1 && length2(v.p - p) <= radius * radius) {
          expected.insert(&v);
        }
      });
      EXPECT_EQ(found, expected);
    }
  }
}

}  // namespace
}  // namespace janus::test
