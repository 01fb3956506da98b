// SPDX-License-Identifier: GPL-3.0-or-later
//
// Outside the field of view of a fisheye the picture is black and, as in Cycles, opaque, though
// there is a world all around and the film is transparent.
#include <algorithm>

#include "support/pictures.h"
#include "support/scene_kit.h"

namespace janus::test {
namespace {

// A fisheye in a grey world, before a wall: its field takes up the middle 8 by 8 pixels.
std::shared_ptr<const Scene> through_a_fisheye() {
  SceneKit kit;
  kit.add("wall", plane(8, 8), diffuse(Rgb(0.8f, 0.4f, 0.2f)), translation({0, 0, -2}));
  kit.world(Rgb(0.5f));
  CameraDesc desc;
  desc.name = "Camera";
  desc.type = CameraType::FisheyeEquidistant;
  desc.fisheye.fov = 1.0f;
  desc.left = desc.bottom = -1.0f;
  desc.right = desc.top = 1.0f;
  kit.builder.set_camera(desc);
  return kit.build();
}

TEST(BlindFilm, IsBlackAndOpaque) {
  const auto scene = through_a_fisheye();
  for (const auto type :
       {IntegratorType::PathTracer, IntegratorType::LightTracer, IntegratorType::Bdpt}) {
    for (const bool transparent : {false, true}) {
      RenderSettings settings = small_picture(type, 4);
      settings.film_transparent = transparent;
      const Image image = render(scene, settings);
      for (const auto& [x, y] : {std::pair(0, 0), {8, 1}, {15, 8}, {11, 11}, {4, 4}}) {
        const float* p = &image.pixels[4 * (static_cast<size_t>(y) * image.width + x)];
        EXPECT_EQ(vec4(p[0], p[1], p[2], p[3]), vec4(0, 0, 0, 1)) << x << " " << y;
      }
      float sum = 0.0f;
      for (size_t i = 0; i < image.pixels.size(); i += 4) {
        sum += image.pixels[i];
      }
      EXPECT_GT(sum, 0.0f);
    }
  }
}

TEST(BlindFilm, HasNoData) {
  RenderSettings settings = small_picture(IntegratorType::PathTracer, 4);
  std::ranges::fill(settings.data.passes, true);
  RenderSession session(through_a_fisheye(), settings);
  session.start();
  session.finish();
  for (const char* name : {"Position", "Normal", "Denoising Albedo", "Denoising Normal"}) {
    const Image image = session.snapshot(name);
    for (int channel = 0; channel < image.channels; ++channel) {
      EXPECT_EQ(image.pixels[channel], 0.0f) << name;
    }
  }
  // The distance, not the depth along the view axis.
  const Image depth = session.snapshot("Depth");
  EXPECT_GT(depth.pixels[8 * 16 + 11], 2.1f);
  EXPECT_NEAR(depth.pixels[8 * 16 + 8], 2.0f, 0.05f);
}

}  // namespace
}  // namespace janus::test
