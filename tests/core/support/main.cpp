// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "support/statistics.h"

namespace janus::test {
namespace {

// Which failures count: of a test that was cut short, none. A sanitizer ends the process by itself.
class Verdict : public ::testing::EmptyTestEventListener {
 public:
  void OnTestStart(const ::testing::TestInfo&) override { shortened = false; }
  void OnTestEnd(const ::testing::TestInfo& test) override {
    failed_ = failed_ || (test.result()->Failed() && !shortened);
  }
  bool failed() const { return failed_; }

 private:
  bool failed_ = false;
};

int run() {
  auto* verdict = new Verdict;  // whose owner is the list
  ::testing::UnitTest::GetInstance()->listeners().Append(verdict);
  const int result = RUN_ALL_TESTS();
  return brief() ? static_cast<int>(verdict->failed()) : result;
}

}  // namespace
}  // namespace janus::test

int main(int count, char** arguments) {
  ::testing::InitGoogleTest(&count, arguments);
  return janus::test::run();
}
