// SPDX-License-Identifier: GPL-3.0-or-later
//
// Embree's errors, cancellation and memory as ours. For accel.cpp alone.
#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <atomic>
#include <cstdlib>
#include <mutex>
#include <string>
#include <utility>

#include "janus/util/cancel.h"
#include "janus/util/error.h"
#include "janus/util/memory.h"

namespace janus {

inline bool on_progress(void* cancel, double /*fraction*/) {
  return !static_cast<const CancelToken*>(cancel)->cancelled();
}

// Where there is no memory for what Embree needs beside its hierarchies, such as threads, it hangs
// or ends the process: kToStart, and kToEnd of that.
inline constexpr size_t kToStart = size_t{96} << 20, kToEnd = size_t{16} << 20;

// Embree itself, for all hierarchies that share some.
class Device {
 public:
  Device() {
    require_memory(kToStart);
    // The setting lets a thread sanitizer run keep Embree's own threads out of the picture.
    handle_ = rtcNewDevice(std::getenv("JANUS_EMBREE_CONFIG"));
    if (!handle_) {
      throw Error("Embree could not be started (error " +
                  std::to_string(static_cast<int>(rtcGetDeviceError(nullptr))) + ")");
    }
    rtcSetDeviceErrorFunction(handle_, on_error, this);
    rtcSetDeviceMemoryMonitorFunction(handle_, on_memory, &bytes_);
  }
  ~Device() { rtcReleaseDevice(handle_); }
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  RTCDevice handle() const { return handle_; }
  size_t bytes() const { return static_cast<size_t>(bytes_.load()); }

  RTCScene new_scene() const {
    RTCScene scene = rtcNewScene(handle_);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    return scene;
  }

  // Throws Cancelled, or Error.
  void commit(RTCScene scene, const CancelToken& cancel) {
    require_memory(kToStart);
    rtcSetSceneProgressMonitorFunction(scene, on_progress, const_cast<CancelToken*>(&cancel));
    rtcCommitScene(scene);
    rtcSetSceneProgressMonitorFunction(scene, nullptr, nullptr);
    cancel.throw_if_cancelled();
    const std::lock_guard lock(mutex_);
    if (!error_.empty()) {
      throw Error("building the ray acceleration structure failed: " + std::exchange(error_, {}));
    }
  }

 private:
  // Embree reports errors to a callback; the first one is kept until a build ends.
  static void on_error(void* user, RTCError code, const char* message) {
    auto* device = static_cast<Device*>(user);
    const std::lock_guard lock(device->mutex_);
    if (code != RTC_ERROR_CANCELLED && device->error_.empty()) {
      device->error_ = code == RTC_ERROR_OUT_OF_MEMORY ? "there is not enough memory"
                       : message                       ? message
                                                       : "unknown error";
    }
  }
  static bool on_memory(void* user, ssize_t bytes, bool after) {
    if (bytes > 0 && !after && !has_memory(static_cast<size_t>(bytes) + kToStart)) {
      return false;
    }
    static_cast<std::atomic<ssize_t>*>(user)->fetch_add(bytes, std::memory_order_relaxed);
    return true;
  }

  RTCDevice handle_;
  std::mutex mutex_;
  std::string error_;
  std::atomic<ssize_t> bytes_{0};
};

}  // namespace janus
