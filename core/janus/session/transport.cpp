// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/session/transport.h"

#include <algorithm>

#include "janus/util/error.h"
#include "janus/util/memory.h"
#include "janus/util/parallel.h"

namespace janus {

namespace {

// Passes that show where small blocks are needed: a share of those that count.
constexpr int kPilotShare = 8, kFewestPilots = 4, kMostPilots = 16;

RenderSettings of_matrix(RenderSettings s) {
  if (s.integrator != IntegratorType::Bdpt) {
    throw SceneError("settings", "integrator", "a matrix is captured by bdpt only");
  }
  if (std::max(s.width, s.height) > TransportSettings::kMostCameraSide) {
    throw SceneError("settings", s.width > s.height ? "width" : "height",
                     "the camera of a matrix has at most 512 x 512 pixels");
  }
  s.crop.reset();
  s.filter = FilterType::Box;
  s.filter_width = 1.0f;
  s.noise_threshold = 0.0f;
  s.clamp_direct = s.clamp_indirect = 0.0f;
  s.expressions.clear();
  s.light_passes.clear();
  s.strategy_images = 0;
  s.shadow_catcher = false;
  s.data = {};
  s.film_exposure = 1.0f;
  s.film_transparent = false;
  return s;
}

}  // namespace

void TransportSettings::validate() const {
  const auto require = [&](bool ok, const char* setting, const char* message) {
    if (!ok) {
      throw SceneError("settings", setting, message);
    }
  };
  require(width >= 1 && width <= kMostProjectorSide, "projector_width",
          "must be from 1 to 256 pixels");
  require(height >= 1 && height <= kMostProjectorSide, "projector_height",
          "must be from 1 to 256 pixels");
  const size_t most = physical_memory();
  require(memory >= size_t{1} << 20, "memory", "must be at least 1 MB");
  require(most == 0 || memory <= most / 10 * 6, "memory",
          "must be at most 60 % of the machine's: the finished matrix needs room beside it");
}

TransportSession::TransportSession(std::shared_ptr<const Scene> scene,
                                   const RenderSettings& settings, TransportSettings transport)
    : transport_((transport.validate(), std::move(transport))), settings_(of_matrix(settings)) {
  projector_ = find_projector(*scene, transport_.projector, transport_.width, transport_.height);
  watts_ = lamp_watts(*scene, projector_);
  scene_ = under_projector(scene, projector_);
  const CameraTiles tiles{settings_.width, settings_.height};
  shares_size_ = TransportSums::shares_size_for(tiles, transport_.width, transport_.height,
                                                transport_.memory / 2);
  if (TransportSums::blocks_for(transport_.memory / 2) < tiles.count()) {
    throw SceneError("settings", "memory",
                     "is too little for so many camera pixels, even in the largest blocks");
  }
  pilot_samples_ = std::clamp(settings_.samples / kPilotShare, kFewestPilots, kMostPilots);
  pilot_ = std::make_unique<TransportPilot>(settings_.width, settings_.height, transport_.width,
                                            transport_.height, shares_size_);
  RenderSettings first = settings_;
  first.samples = pilot_samples_;
  first.seconds /= kPilotShare;
  first.seed = ~settings_.seed;  // other samples than those that count
  session_ = std::make_unique<RenderSession>(scene_, first, pilot_.get());
}

TransportSession::~TransportSession() {
  cancel();
  if (thread_.joinable()) {
    thread_.join();
  }
}

void TransportSession::start() {
  const std::lock_guard lock(mutex_);
  if (state_ != Progress::State::Waiting) {
    throw Error("the capture was started before");
  }
  thread_ = start_thread([this] {
    std::exception_ptr error;
    try {
      run();
    } catch (const Cancelled&) {
    } catch (...) {
      error = std::current_exception();
    }
    const std::lock_guard guard(mutex_);
    error_ = error;
    state_ = error                 ? Progress::State::Failed
             : cancel_.cancelled() ? Progress::State::Cancelled
                                   : Progress::State::Done;
    ended_.notify_all();
  });
  state_ = Progress::State::Rendering;  // now that there is a thread, which cannot end before
}

void TransportSession::run(RenderSession& session) {
  {
    const std::lock_guard lock(mutex_);
    cancel_.throw_if_cancelled();
    session.start();
  }
  session.finish();
  cancel_.throw_if_cancelled();
}

void TransportSession::run() {
  run(*session_);
  ThreadPool pool(settings_.threads);
  TransportBlocks blocks =
      pilot_->choose(TransportSums::blocks_for(transport_.memory / 2), pool, cancel_);
  auto sums = std::make_unique<TransportSums>(settings_.width, settings_.height, transport_.width,
                                              transport_.height, shares_size_, std::move(blocks));
  auto session = std::make_unique<RenderSession>(scene_, settings_, sums.get());
  {
    const std::lock_guard lock(mutex_);
    pilot_seconds_ = session_->progress().seconds;
    std::swap(session_, session);
    sums_ = std::move(sums);
    counts_ = true;
  }
  session.reset();
  pilot_.reset();
  run(*session_);
}

void TransportSession::cancel() {
  const std::lock_guard lock(mutex_);
  cancel_.cancel();
  session_->cancel();
}

bool TransportSession::wait(double seconds) {
  std::unique_lock lock(mutex_);
  return ended_.wait_for(lock, std::chrono::duration<double>(seconds),
                         [this] { return state_ > Progress::State::Rendering; });
}

Progress TransportSession::progress() const {
  const std::lock_guard lock(mutex_);
  Progress progress = session_->progress();
  progress.samples += counts_ ? pilot_samples_ : 0;
  progress.seconds += pilot_seconds_;
  progress.target_samples = pilot_samples_ + settings_.samples;
  if (!counts_ && progress.samples > 0) {
    progress.remaining =
        progress.seconds * (progress.target_samples - progress.samples) / progress.samples;
  }
  progress.state = state_;
  return progress;
}

Statistics TransportSession::statistics() const {
  const std::lock_guard lock(mutex_);
  return counts_ ? session_->statistics() : Statistics{};
}

void TransportSession::finish() {
  std::unique_lock lock(mutex_);
  if (state_ == Progress::State::Waiting) {
    return;
  }
  ended_.wait(lock, [this] { return state_ > Progress::State::Rendering; });
  if (error_) {
    std::rethrow_exception(error_);
  }
}

Image TransportSession::snapshot() const {
  const std::lock_guard lock(mutex_);
  return counts_ ? session_->snapshot() : Image(settings_.width, settings_.height, 4);
}

TransportMatrix TransportSession::matrix() const {
  const std::lock_guard lock(mutex_);
  if (state_ <= Progress::State::Rendering) {
    throw Error("the matrix is there after the end of the capture");
  }
  if (!sums_ || sums_->passes() == 0) {
    throw Error("the capture ended before its first sample: there is no matrix");
  }
  return sums_->matrix();
}

}  // namespace janus
