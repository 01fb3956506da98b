// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/film/film.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/statistics.h"

namespace janus::test {
namespace {

class Filters : public ::testing::TestWithParam<std::pair<FilterType, float>> {
 protected:
  const Filter filter_{GetParam().first, GetParam().second};
};

// Sampling and evaluation must be one function: camera samples draw from it, splats weigh by it.
TEST_P(Filters, SamplesFollowTheDensity) {
  constexpr int kCells = 16, kGrid = 64;
  const float r = filter_.radius();
  std::vector<double> expected(kCells), counts(kCells);
  double integral = 0;
  const float cell = 2 * r / (kCells * kGrid);
  const float at_zero = filter_.evaluate(vec2(0));
  for (int i = 0; i < kCells * kGrid; ++i) {
    const float x = -r + (i + 0.5f) * cell;
    const double density = filter_.evaluate(vec2(x, 0)) / std::sqrt(at_zero) * cell;
    integral += density;
    expected[i / kGrid] += density;
  }
  EXPECT_NEAR(integral, 1, 1e-3);
  Random random(4);
  constexpr int kCount = 50000;
  Mean mean;
  for (int i = 0; i < kCount; ++i) {
    const vec2 d = filter_.sample(random.next_2d());
    ++counts[std::clamp(static_cast<int>((d.x + r) / (2 * r) * kCells), 0, kCells - 1)];
    mean.add(d.y);
  }
  for (double& e : expected) {
    e *= kCount;
  }
  EXPECT_LT(chi_square_z(counts, expected), 4.0);
  EXPECT_LT(std::abs(z_score(mean, 0.0)), 4.0);
  EXPECT_EQ(filter_.evaluate(vec2(1.01f * r, 0)), 0.0f);
}

// A flat field of splats gives a flat image, and camera samples of it the same: h(x) is normalised
// as an integral, not by the sum of its taps.
TEST_P(Filters, SplatsKeepTheirEnergy) {
  Film film({0, 0, 24, 24}, filter_);
  ThreadPool pool(2);
  constexpr int kPerPixel = 24, kBorder = 6, kSide = 24 + 2 * kBorder;
  std::vector<std::vector<Splat>> blocks(1);
  for (int i = 0; i < kSide * kPerPixel; ++i) {
    for (int j = 0; j < kSide * kPerPixel; ++j) {
      blocks[0].push_back({vec2(i + 0.5f, j + 0.5f) / float(kPerPixel) - float(kBorder),
                           Rgb(1.0f / (kPerPixel * kPerPixel))});
    }
  }
  film.begin_pass();
  film.add_splats(blocks, pool);
  film.end_pass(pool);
  const Image image = film.develop();
  for (size_t i = 0; i < image.pixels.size(); i += 4) {
    EXPECT_NEAR(image.pixels[i], 1, 0.01);
    EXPECT_EQ(image.pixels[i + 3], 0.0f);  // alpha belongs to the camera samples
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, Filters,
                         ::testing::Values(std::pair(FilterType::Box, 1.0f),
                                           std::pair(FilterType::Box, 2.0f),
                                           std::pair(FilterType::Gaussian, 1.5f),
                                           std::pair(FilterType::BlackmanHarris, 1.5f),
                                           std::pair(FilterType::BlackmanHarris, 3.0f)));

std::vector<std::vector<Splat>> random_splats() {
  Random random(5);
  std::vector<std::vector<Splat>> blocks(7);
  for (auto& block : blocks) {
    for (int i = 0; i < 500; ++i) {
      block.push_back({vec2(random.in(-3, 83), random.in(-3, 63)),
                       Rgb(random.next(), 1e3f * random.next(), 1e-3f * random.next())});
    }
  }
  return blocks;
}

TEST(Film, SplatsDoNotDependOnThreads) {
  const auto splats = random_splats();
  std::vector<float> first;
  for (const int threads : {1, 2, 3, 7}) {
    ThreadPool pool(threads);
    Film film({0, 0, 80, 60}, Filter(FilterType::BlackmanHarris, 1.5f));
    film.begin_pass();
    film.add_splats(splats, pool);
    film.end_pass(pool);
    const auto pixels = film.develop().pixels;
    if (first.empty()) {
      first = pixels;
    }
    EXPECT_EQ(pixels, first) << threads;
  }
}

TEST(Film, CropShowsTheSameSplats) {
  const auto splats = random_splats();
  ThreadPool pool(2);
  const auto render = [&](FilmRect rect) {
    Film film(rect, Filter(FilterType::BlackmanHarris, 1.5f));
    film.begin_pass();
    film.add_splats(splats, pool);
    film.end_pass(pool);
    return film.develop();
  };
  const Image all = render({0, 0, 80, 60}), part = render({11, 17, 50, 41});
  for (int y = 0; y < part.height; ++y) {
    for (int x = 0; x < part.width; ++x) {
      EXPECT_EQ(part.pixels[4 * (y * part.width + x)],
                all.pixels[4 * ((y + 17) * all.width + x + 11)]);
    }
  }
}

TEST(Film, AnAbandonedPassLeavesNoTrace) {
  ThreadPool pool(1);
  Film film({0, 0, 2, 1}, Filter(FilterType::Box, 1.0f));
  const auto pass = [&](float value) {
    film.begin_pass();
    film.add_sample(0, Rgb(value), 1.0f);
    const std::vector<std::vector<Splat>> splat = {{{vec2(1.5f, 0.5f), Rgb(value)}}};
    film.add_splats(splat, pool);
  };
  EXPECT_EQ(film.develop().pixels[0], 0.0f);
  pass(1);
  film.end_pass(pool);
  pass(100);  // abandoned
  pass(3);
  film.end_pass(pool);
  EXPECT_EQ(film.passes(), 2);
  const Image image = film.develop();
  EXPECT_FLOAT_EQ(image.pixels[0], 2.0f);
  EXPECT_FLOAT_EQ(image.pixels[3], 1.0f);
  EXPECT_FLOAT_EQ(image.pixels[4], 2.0f);
}

}  // namespace
}  // namespace janus::test
