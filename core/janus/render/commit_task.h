// SPDX-License-Identifier: GPL-3.0-or-later
//
// A commit on a thread of its own, for callers with a user interface to keep alive.
#pragma once

#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>

#include "janus/render/builder.h"

namespace janus {

class CommitTask {
 public:
  // Starts to commit what the builder holds now; it may be changed meanwhile.
  explicit CommitTask(SceneBuilder builder);
  // Cancels and joins.
  ~CommitTask();
  CommitTask(const CommitTask&) = delete;
  CommitTask& operator=(const CommitTask&) = delete;

  // Waits up to `seconds` for the end; true if it has come.
  bool wait(double seconds);
  void cancel() { cancel_.cancel(); }

  // Waits for the end. Throws what the commit throws, Cancelled if it was cancelled.
  std::shared_ptr<const Scene> scene();

 private:
  SceneBuilder builder_;
  CancelToken cancel_;
  std::mutex mutex_;  // guards all below
  std::condition_variable ended_;
  bool done_ = false;
  std::shared_ptr<const Scene> scene_;
  std::exception_ptr error_;
  std::thread thread_;
};

}  // namespace janus
