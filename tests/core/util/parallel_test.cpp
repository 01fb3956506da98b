// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/util/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>

namespace janus {
namespace {

class Pool : public ::testing::TestWithParam<int> {};

TEST_P(Pool, RunsEachIndexOnce) {
  ThreadPool pool(GetParam());
  EXPECT_EQ(pool.size(), GetParam());
  for (const size_t count : {0, 1, 2, 1000}) {
    std::vector<std::atomic<int>> calls(count);
    pool.parallel_for(count, [&](size_t i) { ++calls[i]; });
    for (const auto& c : calls) {
      EXPECT_EQ(c, 1);
    }
  }
}

TEST_P(Pool, RethrowsAndGoesOn) {
  ThreadPool pool(GetParam());
  std::atomic<int> calls = 0;
  const auto fail = [&](size_t i) {
    ++calls;
    if (i == 10) {
      throw std::runtime_error("ten");
    }
  };
  EXPECT_THROW(pool.parallel_for(1'000'000, fail), std::runtime_error);
  EXPECT_LT(calls, 1'000'000);  // no further indices are handed out
  calls = 0;
  pool.parallel_for(100, [&](size_t) { ++calls; });
  EXPECT_EQ(calls, 100);
}

INSTANTIATE_TEST_SUITE_P(Sizes, Pool, ::testing::Values(1, 2, 5));

}  // namespace
}  // namespace janus
