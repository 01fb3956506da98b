// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/sampling/sampler.h"

#include <gtest/gtest.h>

#include <set>

#include "support/statistics.h"

namespace janus::test {
namespace {

// Each elementary interval of area 2^-k holds exactly one of the first 2^k points.
TEST(Sampler, PairsAreNets) {
  constexpr int kLog = 8, kCount = 1 << kLog;
  for (int dimension = 0; dimension < 4; ++dimension) {
    std::vector<vec2> points;
    for (int i = 0; i < kCount; ++i) {
      Sampler sampler(5, Stream::Camera, 17, i);
      sampler.start_block(2);
      vec2 u;
      for (int d = 0; d <= dimension; ++d) {
        u = sampler.next_2d();
      }
      points.push_back(u);
    }
    for (int k = 0; k <= kLog; ++k) {
      std::set<std::pair<int, int>> cells;
      for (const vec2 u : points) {
        cells.emplace(u.x * (1 << k), u.y * (1 << (kLog - k)));
      }
      EXPECT_EQ(cells.size(), kCount) << "dimension " << dimension << ", split " << k;
    }
  }
}

TEST(Sampler, NumbersDependOnTheirNamesOnly) {
  Sampler a(1, Stream::Light, 0, 9), b(1, Stream::Light, 0, 9);
  a.start_block(1);
  for (int i = 0; i < 20; ++i) {
    a.next_2d();  // must not show in block 3
  }
  a.start_block(3);
  b.start_block(3);
  for (int i = 0; i < 8; ++i) {
    const vec2 x = a.next_2d(), y = b.next_2d();
    EXPECT_EQ(x.x, y.x);
    EXPECT_EQ(x.y, y.y);
    EXPECT_TRUE(x.x >= 0 && x.x < 1 && x.y >= 0 && x.y < 1);
  }
}

// Correlation of first numbers over an index; shared dimensions would give 1.
TEST(Sampler, StreamsSeedsSequencesAndDimensionsAreIndependent) {
  const auto first = [](uint32_t seed, Stream stream, uint64_t sequence, uint32_t block) {
    std::vector<float> out;
    for (uint64_t i = 0; i < 4096; ++i) {
      Sampler sampler(seed, stream, sequence, i);
      sampler.start_block(block);
      out.push_back(sampler.next_1d());
    }
    return out;
  };
  const auto base = first(1, Stream::Camera, 3, 1);
  for (const auto& other :
       {first(1, Stream::Light, 3, 1), first(1, Stream::Pilot, 3, 1),
        first(2, Stream::Camera, 3, 1), first(1, Stream::Camera, 4, 1),
        first(1, Stream::Camera, uint64_t{3} << 32, 1), first(1, Stream::Camera, 3, 2)}) {
    double covariance = 0;
    for (size_t i = 0; i < base.size(); ++i) {
      covariance += (base[i] - 0.5) * (other[i] - 0.5) * 12 / base.size();
    }
    EXPECT_LT(std::abs(covariance), 4 / std::sqrt(4096.0));
  }
}

TEST(Sampler, LongIndicesDoNotRepeat) {
  Sampler a(1, Stream::Light, 0, 7), b(1, Stream::Light, 0, 7 + (uint64_t{1} << 32));
  EXPECT_NE(a.next_1d(), b.next_1d());
}

}  // namespace
}  // namespace janus::test
