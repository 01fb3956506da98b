// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/render/commit_task.h"

#include <chrono>

#include "janus/util/parallel.h"

namespace janus {

CommitTask::CommitTask(SceneBuilder builder) : builder_(std::move(builder)) {
  thread_ = start_thread([this] {
    std::shared_ptr<const Scene> scene;
    std::exception_ptr error;
    try {
      scene = builder_.commit(cancel_);
    } catch (...) {
      error = std::current_exception();
    }
    const std::lock_guard lock(mutex_);
    scene_ = std::move(scene);
    error_ = error;
    done_ = true;
    ended_.notify_all();
  });
}

CommitTask::~CommitTask() {
  cancel();
  thread_.join();
}

bool CommitTask::wait(double seconds) {
  std::unique_lock lock(mutex_);
  return ended_.wait_for(lock, std::chrono::duration<double>(seconds), [this] { return done_; });
}

std::shared_ptr<const Scene> CommitTask::scene() {
  std::unique_lock lock(mutex_);
  ended_.wait(lock, [this] { return done_; });
  if (cancel_.cancelled()) {  // also if asked for too late to be heard
    throw Cancelled();
  }
  if (error_) {
    std::rethrow_exception(error_);
  }
  return scene_;
}

}  // namespace janus
