// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pixels that stop: when, and what the film does without them.
#include <gtest/gtest.h>

#include "janus/film/film.h"

namespace janus {
namespace {

// 12 by 4 pixels; the left half is 1 in all passes, the right half now 0, now 2.
class AdaptiveFilm : public ::testing::Test {
 protected:
  static constexpr int kWidth = 12, kHeight = 4;

  void pass(float noise) {
    film.begin_pass();
    for (size_t i = 0; i < film.rect().pixels(); ++i) {
      const bool right = i % kWidth >= kWidth / 2;
      const float value = right ? 1.0f + (passes % 2 ? noise : -noise) : 1.0f;
      film.add_sample(i, Rgb(value), 1.0f);
      film.layers_at(i)[0] += Rgb(value);
    }
    const std::vector<Splat> splats{{{1.5f, 1.5f}, Rgb(0.5f)}, {{10.5f, 1.5f}, Rgb(0.5f)}};
    film.add_splats(std::span(&splats, 1), pool);
    film.end_pass(pool);
    ++passes;
  }
  static float at(const Image& image, int x, int y) {
    return image.pixels[image.channels * (static_cast<size_t>(y) * image.width + x)];
  }

  ThreadPool pool{2};
  Film film{{0, 0, kWidth, kHeight}, Filter(FilterType::Box, 1.0f), 1, true};
  int passes = 0;
};

TEST_F(AdaptiveFilm, StopsPixelsWithoutNoise) {
  for (int i = 0; i < 4; ++i) {
    pass(0.5f);
  }
  // The left half but for the column beside the noise.
  film.stop_converged(0.05f, 1.0f, pool);
  EXPECT_EQ(film.active_pixels(), 4u * 7);
  EXPECT_FALSE(film.active(0));
  EXPECT_TRUE(film.active(5) && film.active(11));
  film.stop_converged(5.0f, 1.0f, pool);
  EXPECT_EQ(film.active_pixels(), 0u);
}

// What a pixel gets after it has stopped does not count, and what it has is divided by its passes.
TEST_F(AdaptiveFilm, LeavesThemAlone) {
  for (int i = 0; i < 4; ++i) {
    pass(0.5f);
  }
  const Image before = film.develop();
  film.stop_converged(0.05f, 1.0f, pool);
  for (int i = 0; i < 4; ++i) {
    pass(0.25f);
  }
  const Image after = film.develop(), layer = film.develop_layer(0);
  EXPECT_EQ(at(after, 0, 0), 1.0f);
  EXPECT_EQ(at(after, 1, 1), at(before, 1, 1));
  EXPECT_EQ(at(after, 1, 1), 1.5f);
  EXPECT_EQ(at(after, 10, 1), 1.5f);
  EXPECT_EQ(at(layer, 1, 1), 1.0f);
  EXPECT_EQ(at(layer, 10, 1), 1.0f);
  EXPECT_EQ(after.pixels[3], 1.0f);
  EXPECT_EQ(film.mean(0), Rgb(1.0f));
}

// A pixel whose neighbour turns out to be noisy goes on.
TEST_F(AdaptiveFilm, GoesOnBesideNoise) {
  for (int i = 0; i < 4; ++i) {
    pass(0.001f);
  }
  film.stop_converged(0.0005f, 1.0f, pool);
  EXPECT_EQ(film.active_pixels(), 4u * 7);
  film.stop_converged(1.0f, 1.0f, pool);
  EXPECT_EQ(film.active_pixels(), 0u);
  film.stop_converged(1e-9f, 1.0f, pool);
  EXPECT_EQ(film.active_pixels(), 0u);  // those that have stopped have nothing new
}

TEST(Film, StopsNothingUnlessAsked) {
  ThreadPool pool(1);
  Film film({0, 0, 2, 2}, Filter(FilterType::Box, 1.0f));
  film.stop_converged(1.0f, 1.0f, pool);
  EXPECT_EQ(film.active_pixels(), 4u);
  EXPECT_TRUE(film.active(0));
}

}  // namespace
}  // namespace janus
