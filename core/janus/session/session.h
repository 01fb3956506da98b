// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <condition_variable>
#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "janus/image/image.h"
#include "janus/session/passes.h"
#include "janus/session/settings.h"

namespace janus {

struct Progress {
  int samples = 0, target_samples = 0;
  double seconds = 0.0;             // since start()
  std::optional<double> remaining;  // seconds, once a pass has been timed
  enum class State { Waiting, Rendering, Done, Cancelled, Failed } state = State::Waiting;
};

struct Statistics {
  int samples = 0;       // whole passes in the image
  double seconds = 0.0;  // of rendering, the scene's set-up apart
  Counters counters;
  double weight_error = 0.0;  // with check_weights
  size_t cache_bytes = 0;     // most that the light-vertex cache has held
  Effort effort{0.0f, 0.0f};  // of the passes to come
};

// One render on threads of its own. All methods may be called from any thread; none of them waits
// for more than a copy of the image, except wait() and finish().
class RenderSession {
 public:
  // Throws SceneError for settings that cannot be rendered, or not of this scene. `transport`,
  // which outlives the session, gets all contributions, too (RenderContext::transport).
  RenderSession(std::shared_ptr<const Scene> scene, RenderSettings settings,
                TransportFilm* transport = nullptr);
  // Cancels and joins.
  ~RenderSession();
  RenderSession(const RenderSession&) = delete;
  RenderSession& operator=(const RenderSession&) = delete;

  void start();

  // Waits up to `seconds` for the render to end; true if it has.
  bool wait(double seconds);

  // Asks the render to stop. Whole passes are kept, the running one is dropped.
  void cancel() { cancel_.cancel(); }

  Progress progress() const;
  Statistics statistics() const;

  // The mean of the whole passes so far: RGBA of the crop, scene linear, bottom row first.
  Image snapshot() const;
  // Of the pass called `name`: RGBA of "Combined", RGB of those of light, and what kDataPasses says
  // of those of data. Throws Error for a name that is not in passes().
  Image snapshot(const std::string& name) const;

  // The names of all pictures: "Combined", then those that the settings ask for.
  std::vector<std::string> passes() const;

  // The names that Cryptomatte passes of this kind know, with their hashes.
  std::map<std::string, std::string> manifest(MatteKind kind) const;

  // What of the settings has no effect in this scene.
  const Diagnostics& diagnostics() const { return diagnostics_; }

  // Waits for the end and rethrows what the render threads threw. A cancelled render is no error.
  void finish();

 private:
  void check_memory() const;
  void check_strategies();
  void check_lights();
  void run();
  IntegratorSettings integrator_settings(const Scene& scene, const Layers& layers) const;
  std::unique_ptr<Integrator> make_integrator(const RenderContext& context,
                                              const IntegratorSettings& settings) const;
  void end(Progress::State state, std::exception_ptr error);

  std::shared_ptr<const Scene> scene_;
  RenderSettings settings_;
  RenderPasses passes_;
  Diagnostics diagnostics_;
  TransportFilm* transport_;
  CancelToken cancel_;
  std::thread thread_;

  mutable std::mutex mutex_;  // guards all below
  std::condition_variable ended_;
  std::optional<Film> film_;
  std::optional<Film> catcher_film_;   // of Scene::catchers_alone
  std::optional<DataFilm> data_film_;  // guards itself
  Progress::State state_ = Progress::State::Waiting;
  std::exception_ptr error_;
  Statistics statistics_;
  double start_time_ = 0.0, end_time_ = 0.0;
};

}  // namespace janus
