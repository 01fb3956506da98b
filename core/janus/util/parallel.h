// SPDX-License-Identifier: GPL-3.0-or-later
//
// A small thread pool. Which thread runs which index is never defined, so work must write its
// results to places owned by the index; then the result does not depend on the thread count.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace janus {

// A thread that calls `body`, which throws nothing. Throws std::bad_alloc or std::system_error if
// there is no room for it.
std::thread start_thread(std::function<void()> body);

class ThreadPool {
 public:
  // `threads` workers; 0 means one per hardware thread. With 1 the caller does all the work.
  explicit ThreadPool(int threads);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  int size() const { return size_; }

  // Calls body(i) once for each i in [0, count), on the workers and the calling thread, and
  // returns when all have ended. The first exception stops the handing out of further indices
  // and is rethrown here. Not reentrant.
  void parallel_for(size_t count, const std::function<void(size_t)>& body);

 private:
  void worker();
  void drain();

  int size_;
  std::vector<std::thread> threads_;
  std::mutex mutex_;
  std::condition_variable wake_, done_;
  const std::function<void(size_t)>* body_ = nullptr;
  size_t next_ = 0, count_ = 0;
  int busy_ = 0;
  bool stop_ = false;
  std::exception_ptr error_;
};

}  // namespace janus
