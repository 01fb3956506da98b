// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>

#include "janus/util/error.h"

namespace janus {

// Set by one thread, polled by the workers. Long loops call throw_if_cancelled() often enough for
// an answer within 0.2 s.
class CancelToken {
 public:
  void cancel() { cancelled_.store(true, std::memory_order_relaxed); }
  bool cancelled() const { return cancelled_.load(std::memory_order_relaxed); }
  void throw_if_cancelled() const {
    if (cancelled()) {
      throw Cancelled();
    }
  }

 private:
  std::atomic<bool> cancelled_{false};
};

}  // namespace janus
