// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/util/parallel.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "janus/util/memory.h"

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace janus {

namespace {

// Denormals are slow and never matter in a picture. Set per thread and restored, because the
// calling thread may be Blender's.
class FlushDenormals {
 public:
#if defined(__SSE2__)
  FlushDenormals() : saved_(_mm_getcsr()) { _mm_setcsr(saved_ | 0x8040); }
  ~FlushDenormals() { _mm_setcsr(saved_); }

 private:
  unsigned saved_;
#endif
};

}  // namespace

std::thread start_thread(std::function<void()> body) {
  // Where the C library has no memory for a thread's own data, when it is first asked for, it ends
  // the process. The data of this library are asked for at once.
  constexpr size_t kRoom = size_t{64} << 20;
  require_memory(kRoom);
  return std::thread([body = std::move(body)] {
    if (std::uncaught_exceptions() == 0) {
      body();
    }
  });
}

ThreadPool::ThreadPool(int threads) {
  const int hardware = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  size_ = threads > 0 ? threads : hardware;
  threads_.reserve(size_ - 1);
  try {
    for (int i = 1; i < size_; ++i) {
      threads_.push_back(start_thread([this] { worker(); }));
    }
  } catch (const std::exception&) {  // the system has no more of them: fewer do the same work
    size_ = static_cast<int>(threads_.size()) + 1;
  }
}

ThreadPool::~ThreadPool() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_all();
  for (std::thread& thread : threads_) {
    thread.join();
  }
}

void ThreadPool::parallel_for(size_t count, const std::function<void(size_t)>& body) {
  if (count == 0) {
    return;
  }
  {
    const std::lock_guard lock(mutex_);
    body_ = &body;
    next_ = 0;
    count_ = count;
    error_ = nullptr;
  }
  wake_.notify_all();
  drain();
  std::unique_lock lock(mutex_);
  done_.wait(lock, [this] { return busy_ == 0; });
  body_ = nullptr;
  if (error_) {
    std::rethrow_exception(error_);
  }
}

void ThreadPool::worker() {
  std::unique_lock lock(mutex_);
  for (;;) {
    wake_.wait(lock, [this] { return stop_ || (body_ && next_ < count_); });
    if (stop_) {
      return;
    }
    lock.unlock();
    drain();
    lock.lock();
  }
}

void ThreadPool::drain() {
  const FlushDenormals flush;
  std::unique_lock lock(mutex_);
  while (body_ && next_ < count_) {
    const size_t index = next_++;
    ++busy_;
    const std::function<void(size_t)>& body = *body_;
    lock.unlock();
    std::exception_ptr error;
    try {
      body(index);
    } catch (...) {
      error = std::current_exception();
    }
    lock.lock();
    if (error) {
      next_ = count_;
      if (!error_) {
        error_ = error;
      }
    }
    if (--busy_ == 0 && next_ >= count_) {
      done_.notify_all();
    }
  }
}

}  // namespace janus
