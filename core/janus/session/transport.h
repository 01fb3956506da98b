// SPDX-License-Identifier: GPL-3.0-or-later
//
// Dual photography (Sen et al. 2005): captures the light transport matrix between the pixels of a
// projector and those of the camera.
#pragma once

#include "janus/film/transport_sums.h"
#include "janus/render/under_projector.h"
#include "janus/session/session.h"

namespace janus {

struct TransportSettings {
  // Larger matrices would take hours and gigabytes.
  static constexpr int kMostCameraSide = 512, kMostProjectorSide = 256;

  std::string projector;        // name of a spot or area light
  int width = 64, height = 64;  // of its picture, pixels
  // For the sums of the matrix, bytes: half for entries, at most half for the shares. More of it
  // makes smaller blocks.
  size_t memory = size_t{256} << 20;

  // Throws SceneError naming the setting.
  void validate() const;
};

// A capture on threads of its own: first a few passes that show where the matrix needs small
// blocks, then the passes of which it is made. Methods may be called from any thread.
class TransportSession {
 public:
  // Renders with `settings`, but for what would make the matrix another one: pixels are boxes, all
  // of the frame, nothing is clamped or stops early, and there are no passes beside the picture.
  // Throws SceneError for what cannot be captured, naming lamp or settings and the setting.
  TransportSession(std::shared_ptr<const Scene> scene, const RenderSettings& settings,
                   TransportSettings transport);
  // Cancels and joins.
  ~TransportSession();
  TransportSession(const TransportSession&) = delete;
  TransportSession& operator=(const TransportSession&) = delete;

  void start();
  // Waits up to `seconds` for the end; true if it has come.
  bool wait(double seconds);
  // Whole passes are kept.
  void cancel();
  // Samples of the first passes count, too.
  Progress progress() const;
  Statistics statistics() const;  // of the passes that the matrix is made of
  // Waits for the end and rethrows what the threads threw. A cancelled capture is no error.
  void finish();

  // The camera's picture while every pixel of the projector shines with one watt: RGBA, bottom row
  // first. Black before the first pass that counts.
  Image snapshot() const;
  // After the end; of the whole passes so far.
  TransportMatrix matrix() const;

  const ProjectorDesc& projector() const { return projector_; }
  const LampWatts& watts() const { return watts_; }
  const CameraDesc& camera() const { return scene_->camera; }
  int width() const { return settings_.width; }
  int height() const { return settings_.height; }
  int pilot_samples() const { return pilot_samples_; }

 private:
  void run();
  void run(RenderSession& session);

  TransportSettings transport_;
  RenderSettings settings_;
  ProjectorDesc projector_;
  LampWatts watts_;
  std::shared_ptr<const Scene> scene_;  // under the projector
  int shares_size_;
  int pilot_samples_;
  CancelToken cancel_;
  std::thread thread_;

  mutable std::mutex mutex_;  // guards all below
  std::condition_variable ended_;
  std::unique_ptr<TransportPilot> pilot_;
  std::unique_ptr<TransportSums> sums_;
  std::unique_ptr<RenderSession> session_;  // the one that runs, or has run
  bool counts_ = false;                     // do its samples count?
  Progress::State state_ = Progress::State::Waiting;
  std::exception_ptr error_;
  double pilot_seconds_ = 0.0;
};

}  // namespace janus
