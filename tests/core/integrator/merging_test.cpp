// SPDX-License-Identifier: GPL-3.0-or-later
//
// Vertex merging: it finds the same light as the other techniques, but for a blur, and finds
// caustics behind a delta with less noise than anything else.
#include <functional>
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

// A lamp of no size shines through one interface of glass on the floor, and the camera sees the
// floor through another: what is in the picture has been merged.
SceneKit merged_alone(RayMask first = kAllRays) {
  SceneKit kit;
  kit.add("first", plane(8, 8), glass(Rgb(1), 1.1f), translation({0, 0, 1}), first)
      .add("floor", plane(4, 4), diffuse(Rgb(0.8f)))
      .add("second", plane(1.5f, 1.5f), glass(Rgb(1), 1.1f),
           translation({1, 0, 0.5f}) * rotation({0, 1, 0}, 1.4f))
      .light("l", point_light({0, 0, 2}, 50))
      .camera({1.8f, 0, 0.7f}, {0.3f, 0, 0}, 0.2f);
  return kit;
}

double brightness(const SceneKit& kit, const std::function<void(RenderSettings&)>& change) {
  RenderSettings settings = merging(4, 0.1f);
  settings.max_bounces = 2;
  change(settings);
  return quarters(kit.build(), settings, 2)[0].mean();
}

TEST(Merging, IsAloneBetweenDeltas) {
  EXPECT_GT(brightness(merged_alone(), [](RenderSettings&) {}), 0.1);
  EXPECT_EQ(brightness(merged_alone(), [](RenderSettings& s) { s.merge_radius = 0.0f; }), 0.0);
}

TEST(Merging, KeepsLimitsOfBounces) {
  const auto capped = [](int diffuse, int all) {
    return brightness(merged_alone(), [&](RenderSettings& s) {
      s.max_diffuse_bounces = diffuse;
      s.max_bounces = all;
    });
  };
  EXPECT_GT(capped(1, 2), 0.1);
  EXPECT_EQ(capped(0, 2), 0.0);
  EXPECT_EQ(capped(1, 1), 0.0);
}

TEST(Merging, KeepsLimitsOfCrossings) {
  const NodeGraph clear = single("BSDF_TRANSPARENT", {{"Color", vec4(1)}});
  const SceneKit kit =
      merged_alone()
          .add("on the light's side", plane(4, 4), clear, translation({0, 0, 0.95f}))
          .add("on the camera's side", plane(1.5f, 1.5f), clear,
               translation({1.1f, 0, 0.5f}) * rotation({0, 1, 0}, 1.4f));
  const auto limited = [&](int crossings) {
    return brightness(kit, [&](RenderSettings& s) { s.transparent_max_bounces = crossings; });
  };
  EXPECT_GT(limited(2), 0.1);
  EXPECT_EQ(limited(1), 0.0);
}

TEST(Merging, KeepsRayVisibility) {
  const auto hidden_from = [](RayType type) {
    return brightness(merged_alone(static_cast<RayMask>(kAllRays & ~ray_bit(type))),
                      [](RenderSettings&) {});
  };
  EXPECT_GT(hidden_from(RayType::Glossy), 0.1);
  EXPECT_EQ(hidden_from(RayType::Diffuse), 0.0);
}

// Three panes before the world, the one in the middle rough: where they are clear, a transparent
// film shows nothing of it.
TEST(Merging, KeepsClearViews) {
  const auto upright = [](float y) {
    return translation({0, y, 0}) * rotation({1, 0, 0}, 1.5708f);
  };
  const auto pane = [](float roughness) {  // reflections would show the world
    return single("BSDF_REFRACTION", {{"Roughness", roughness}, {"IOR", 1.1f}});
  };
  SceneKit kit;
  kit.add("near", plane(4, 4), pane(0.0f), upright(-0.5f))
      .add("rough", plane(4, 4), pane(0.3f), upright(0))
      .add("far", plane(4, 4), pane(0.0f), upright(0.5f))
      .world(Rgb(0.5f))
      .camera({0, -2, 0}, {0, 0, 0}, 0.2f);
  const auto clear_up_to = [&](float roughness) {
    return brightness(kit, [&](RenderSettings& s) {
      s.film_transparent = s.film_transparent_glass = true;
      s.film_transparent_roughness = roughness;
    });
  };
  EXPECT_GT(clear_up_to(0.2f), 0.1);
  EXPECT_EQ(clear_up_to(0.4f), 0.0);
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
      grid.for_each_near(p, [&](const LightVertex& v, const CacheBlock& block) {
        found.insert(&v);
        EXPECT_GE(&v, block.vertices.data());
        EXPECT_LT(&v, block.vertices.data() + block.vertices.size());
      });
      cache.for_each([&](const LightVertex& v, uint32_t) {
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
