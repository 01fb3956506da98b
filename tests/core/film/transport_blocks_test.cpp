// SPDX-License-Identifier: GPL-3.0-or-later
//
// Partitions of a projector: every pixel lies in one block, whatever made the pilot choose them.
#include <gtest/gtest.h>

#include <algorithm>

#include "janus/film/transport_sums.h"
#include "support/statistics.h"

namespace janus::test {
namespace {

constexpr int kCamera = 20, kWidth = 37, kHeight = 21;

// Passes in which each camera pixel gets a sharp dot of its own and some even light.
TransportBlocks choose(size_t most, int shares_size, float even, int passes = 8) {
  TransportPilot pilot(kCamera, kCamera, kWidth, kHeight, shares_size);
  ThreadPool pool(2);
  Random random(5);
  for (int pass = 0; pass < passes; ++pass) {
    pilot.begin_pass();
    for (uint32_t i = 0; i < kCamera * kCamera; ++i) {
      pilot.add(i, i % kCamera + kWidth * (i / kCamera), Rgb(1.0f));
      const vec2 p = random.next_2d() * vec2(kWidth, kHeight);
      pilot.add(i, static_cast<uint32_t>(p.x) + kWidth * static_cast<uint32_t>(p.y), Rgb(even));
    }
    pilot.end_pass(pool);
  }
  EXPECT_EQ(pilot.seen(), size_t{2} * kCamera * kCamera * passes);
  return pilot.choose(most, pool, CancelToken());
}

void expect_partition(const TransportBlocks& blocks) {
  const CameraTiles tiles{kCamera, kCamera};
  ASSERT_EQ(blocks.first(tiles.count()), blocks.count());
  for (size_t tile = 0; tile < tiles.count(); ++tile) {
    const auto of_tile = blocks.of_tile(tile);
    std::vector<int> covered(static_cast<size_t>(kWidth) * kHeight, 0);
    for (uint32_t b = 0; b < of_tile.size(); ++b) {
      for (int y = of_tile[b].y; y < std::min(of_tile[b].y + of_tile[b].size, kHeight); ++y) {
        for (int x = of_tile[b].x; x < std::min(of_tile[b].x + of_tile[b].size, kWidth); ++x) {
          ++covered[static_cast<size_t>(y) * kWidth + x];
          ASSERT_EQ(blocks.find(tile, x, y), b);
        }
      }
    }
    ASSERT_EQ(std::count(covered.begin(), covered.end(), 1), std::ssize(covered));
  }
}

TEST(TransportBlocks, ArePartitions) {
  expect_partition(TransportBlocks({kCamera, kCamera}, kWidth, kHeight));
  for (const size_t most : {9, 30, 200, 5000}) {
    for (const int shares_size : {1, 4, 64}) {
      const TransportBlocks blocks = choose(most, shares_size, 0.2f);
      EXPECT_LE(blocks.count(), most);
      expect_partition(blocks);
    }
  }
}

// A dot for each pixel: 64 dots in a tile, and few blocks beyond them, whatever else there is.
TEST(TransportBlocks, AreAsFineAsTheLight) {
  const TransportBlocks blocks = choose(kCamera * kCamera + 9 * 40, 1, 0.2f);
  for (uint32_t i = 0; i < kCamera * kCamera; ++i) {
    const size_t tile = CameraTiles{kCamera, kCamera}.tile(i);
    EXPECT_EQ(blocks.of_tile(tile)[blocks.find(tile, i % kCamera, i / kCamera)].size, 1);
  }
}

// Where nothing is seen of a structure, room that is left is used for the brightest.
TEST(TransportBlocks, UseTheirRoomWhereThereIsLight) {
  TransportPilot pilot(kCamera, kCamera, 32, 32, 1);
  ThreadPool pool(1);
  Random random(6);
  for (int pass = 0; pass < 16; ++pass) {
    pilot.begin_pass();
    for (uint32_t i = 0; i < kCamera * kCamera; ++i) {
      const auto source = static_cast<uint32_t>(random.next() * 1024);
      pilot.add(i, source, Rgb(source % 32 < 16 ? 1.0f : 0.01f));
    }
    pilot.end_pass(pool);
  }
  const TransportBlocks blocks = pilot.choose(400, pool, CancelToken());
  EXPECT_GT(blocks.count(), 300u);
  size_t left = 0;
  for (size_t tile = 0; tile < 9; ++tile) {
    for (const SourceBlock& b : blocks.of_tile(tile)) {
      left += b.x < 16 ? 1 : 0;
    }
  }
  EXPECT_GT(left, 0.9 * blocks.count());
}

// Entry by entry what was added, as means over the passes with the variances of these.
TEST(TransportSums, AreMeans) {
  TransportSums sums(3, 2, 4, 4, 2, TransportBlocks({3, 2}, 4, 4));
  ThreadPool pool(2);
  for (int pass = 0; pass < 2; ++pass) {
    sums.begin_pass();
    sums.start_splats(1);
    sums.add(4, 5, Rgb(1.0f, 2.0f, 0.0f));
    sums.add_splat(0, vec2(1.5f, 1.9f), 6, Rgb(1.0f * pass, 0.0f, 2.0f * pass));
    sums.add_splat(0, vec2(3.01f, 1.0f), 6, Rgb(1.0f));  // beside the picture
    sums.end_pass(pool);
  }
  sums.begin_pass();
  sums.add(4, 5, Rgb(100.0f));  // abandoned
  const TransportMatrix m = sums.matrix();
  ASSERT_EQ(m.values.size(), 1u);
  EXPECT_EQ(m.pixels[0], 4u);
  EXPECT_EQ(m.values[0], Rgb(1.5f, 2.0f, 1.0f));
  EXPECT_EQ(m.variances[0], Rgb(0.25f, 0.0f, 1.0f));
  ASSERT_EQ(m.shares.size(), 4u);
  EXPECT_EQ(m.shares[0], Rgb(1.0f, 2.0f, 0.0f));
  EXPECT_EQ(m.shares[1], Rgb(0.5f, 0.0f, 1.0f));
  EXPECT_EQ(m.share_variances[1], Rgb(0.25f, 0.0f, 1.0f));
}

}  // namespace
}  // namespace janus::test
