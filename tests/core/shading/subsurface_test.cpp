// SPDX-License-Identifier: GPL-3.0-or-later
//
// Light below surfaces: directions of entries, walks in a medium, and what comes back.
#include "janus/shading/subsurface.h"

#include "janus/math/warp.h"
#include "support/pictures.h"
#include "support/scene_kit.h"
#include "support/statistics.h"

namespace janus::test {
namespace {

const vec3 kUp(0.0f, 0.0f, 1.0f);

Lobe wax(SubsurfaceMethod method, float alpha, float ior, float g = 0.0f) {
  return subsurface_lobe(method, Rgb(0.9f, 0.5f, 0.2f), Rgb(0.9f, 0.5f, 0.2f), Rgb(0.3f, 0.1f, 1),
                         g, ior, alpha);
}

// The means of test functions over drawn directions are those of the density.
TEST(SubsurfaceEntry, DirectionsHaveTheirDensity) {
  for (const auto method : {SubsurfaceMethod::Legacy, SubsurfaceMethod::Skin}) {
    for (const float alpha : {0.2f, 0.6f, 1.0f}) {
      for (const float cos : {1.0f, 0.6f, 0.15f}) {
        const Lobe lobe = wax(method, alpha, 1.5f);
        const vec3 wo(std::sqrt(1 - cos * cos), 0, cos);
        const auto functions = [](vec3 d, Mean(&means)[4], double weight) {
          means[0].add(weight);
          means[1].add(weight * d.x);
          means[2].add(weight * d.z * d.z);
          means[3].add(d.z < 0 ? 0 : weight);
        };
        Mean drawn[4], expected[4];
        Random random(7);
        for (int i = 0; i < 100000; ++i) {
          const auto d = sample_entry(lobe, kUp, wo, random.next_2d());
          ASSERT_TRUE(d);
          functions(*d, drawn, 1);
          const vec3 any = random.direction();
          functions(any, expected, entry_density(lobe, kUp, wo, any) * 4 * kPi);
        }
        for (int k = 0; k < 4; ++k) {
          const double error = std::hypot(drawn[k].error(), expected[k].error());
          EXPECT_NEAR(drawn[k].mean(), expected[k].mean(), 4.5 * error + 1e-6)
              << static_cast<int>(method) << " " << alpha << " " << cos << " " << k;
        }
      }
    }
  }
}

// Nothing is lost in a medium without end: with its value over its density, each step passes on the
// albedo of single scattering of each channel, however it was drawn.
TEST(SubsurfaceWalker, StepsHaveTheirDensity) {
  for (const float g : {0.0f, 0.6f}) {
    const Lobe lobe = wax(SubsurfaceMethod::Legacy, 1, 1.4f, g);
    const SubsurfaceMedium medium(lobe);
    Random random(3);
    Mean steps[4][3], forward;
    for (int i = 0; i < 200000; ++i) {
      SubsurfaceWalker walker(medium, kUp);
      vec3 direction(0, 0, -1);
      for (auto& step : steps) {
        const vec3 before = direction;
        const float u_channel = random.next(), u_length = random.next(), u_guide = random.next();
        const auto segment =
            walker.sample(direction, u_channel, u_length, u_guide, random.next_2d());
        direction = segment.direction;
        walker.advance(segment, false);
        for (int c = 0; c < 3; ++c) {
          step[c].add(walker.throughput()[c]);
        }
        if (&step == &steps[1]) {
          forward.add(walker.throughput().x * dot(before, direction));
        }
      }
    }
    for (int c = 0; c < 3; ++c) {
      const double albedo = steps[0][c].mean();  // of one step: the same in all walks
      EXPECT_GT(albedo, 0.2);
      EXPECT_LT(albedo, 1.01);
      for (int k = 1; k < 4; ++k) {
        EXPECT_LT(std::abs(z_score(steps[k][c], std::pow(albedo, k + 1))), 4.5) << g << k << c;
      }
    }
    const double albedo = steps[0][0].mean();
    EXPECT_LT(std::abs(z_score(forward, g * albedo * albedo)), 4.5) << g;  // mean cosine of HG
  }
}

// A half space where light enters by the cosine reflects what its colour says, as good as the fits
// are.
TEST(SubsurfaceMedium, ReflectsAsMuchAsItsColourSays) {
  for (const auto method : {SubsurfaceMethod::RandomWalk, SubsurfaceMethod::Legacy}) {
    for (const float g : {0.0f, 0.5f}) {
      const Rgb color(0.8f, 0.5f, 0.1f);
      const SubsurfaceMedium medium(subsurface_lobe(method, color, color, Rgb(1), g, 1.4f, 1));
      Mean reflected[3];
      Random random(5);
      for (int i = 0; i < 40000; ++i) {
        SubsurfaceWalker walker(medium, kUp);
        vec3 direction = -square_to_cosine_hemisphere(random.next_2d());
        double z = 0;
        bool arrived = false;
        for (int k = 0; k < 256 && !arrived; ++k) {
          const float u_channel = random.next(), u_length = random.next(), u = random.next();
          auto segment = walker.sample(direction, u_channel, u_length, u, random.next_2d());
          direction = segment.direction;
          arrived = z + segment.length * direction.z > 0;
          segment.length = arrived ? static_cast<float>(-z / direction.z) : segment.length;
          walker.advance(segment, arrived);
          z += segment.length * direction.z;
        }
        for (int c = 0; c < 3; ++c) {
          reflected[c].add(arrived ? color[c] * medium.scale()[c] * walker.throughput()[c] : 0);
        }
      }
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(reflected[c].mean(), color[c], 0.05 * color[c] + 4 * reflected[c].error())
            << static_cast<int>(method) << " " << g << " " << color[c];
        EXPECT_LT(reflected[c].error(), 0.02 * color[c]);
      }
    }
  }
}

// Tiny radii are a diffuse surface, channel by channel.
TEST(Subsurface, NoRadiusIsDiffuse) {
  const auto floor = [](const NodeGraph& graph) {
    SceneKit kit;
    kit.add("floor", plane(4, 4), graph).light("l", point_light({0.5f, 0, 1}, 20));
    const auto scene = kit.camera({0, -1, 1}, {0, 0, 0}).build();
    return render(scene, small_picture(IntegratorType::PathTracer, 4)).pixels;
  };
  const Rgb color(0.8f, 0.5f, 0.2f);
  EXPECT_EQ(floor(subsurface(color, {{"Scale", 0.0f}})), floor(diffuse(color)));
}

// Light that falls on one side of a slab comes out of the other.
TEST(Subsurface, GoesThrough) {
  const auto brightness = [](float scale) {
    SceneKit kit;
    kit.add("slab", cuboid({-3, -3, -0.05f}, {3, 3, 0.05f}),
            subsurface(Rgb(0.9f), {{"Scale", scale}, {"Radius", vec3(1)}}));
    kit.light("below", area_light({0, 0, -1}, {0, 0, 0}, 1, 40)).camera({0, 0, 1}, {0, 0, 0}, 0.2f);
    return quarters(kit.build(), small_picture(IntegratorType::PathTracer, samples(16)))[0].mean();
  };
  EXPECT_GT(brightness(1.0f), 0.1);
  EXPECT_LT(brightness(0.05f), 0.05 * brightness(1.0f));
}

}  // namespace
}  // namespace janus::test
