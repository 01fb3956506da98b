// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/session/session.h"

#include <algorithm>
#include <chrono>

#include "janus/session/footage.h"
#include "janus/util/error.h"
#include "janus/util/memory.h"
#include "janus/util/parallel.h"

namespace janus {

namespace {

// Cycles looks at the noise every so many samples, and takes so many times its threshold.
constexpr int kAdaptiveStep = 16;
constexpr float kThresholdScale = 5.0f;

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

RenderSession::RenderSession(std::shared_ptr<const Scene> scene, RenderSettings settings,
                             TransportFilm* transport)
    : scene_(std::move(scene)),
      settings_((settings.validate(), std::move(settings))),
      passes_(settings_, *scene_),
      diagnostics_(passes_.diagnostics()),
      transport_(transport) {
  check_memory();
  check_strategies();
  check_lights();
  film_.emplace(settings_.rect(), Filter(settings_.filter, settings_.filter_width),
                passes_.layers().count(), settings_.adaptive());
  if (scene_->catchers_alone) {
    catcher_film_.emplace(settings_.rect(), film_->filter(), layers_of_catchers().count(),
                          settings_.adaptive());
  }
  if (settings_.data.any()) {
    data_film_.emplace(settings_.rect(), settings_.data);
  }
}

// A system that promises more than it has would end the process later, and Blender with it.
void RenderSession::check_memory() const {
  const size_t most = physical_memory();
  const size_t needed =
      Film::bytes(settings_.rect(), passes_.layers().count(), settings_.adaptive()) +
      (scene_->catchers_alone
           ? Film::bytes(settings_.rect(), layers_of_catchers().count(), settings_.adaptive())
           : 0) +
      DataFilm::bytes(settings_.rect(), settings_.data);
  if (most > 0 && needed > most / 10 * 9) {
    const auto gigabytes = [](size_t bytes) { return std::to_string((bytes >> 30) + 1) + " GB"; };
    throw SceneError("settings", "passes",
                     "the picture with its " + std::to_string(passes_.layers().count()) +
                         " layers would take " + gigabytes(needed) + ", and the machine has " +
                         gigabytes(most) +
                         ": render fewer passes, shorter strategies or less "
                         "resolution");
  }
}

// Those without which the settings leave nothing to render.
void RenderSession::check_strategies() {
  if (!settings_.strategies) {
    return;
  }
  const bool classic = settings_.connection_mode == ConnectionMode::Classic;
  const bool light_paths = classic || settings_.light_paths > 0.0f;
  settings_.strategies->limit(
      settings_.next_event, classic || (light_paths && settings_.connections > 0.0f), light_paths);
  if (!settings_.strategies->any()) {
    throw SceneError("settings", "strategies",
                     "none of the chosen strategies is left: next event estimation (s=1), light "
                     "paths (t=1) or connections are switched off");
  }
}

// Some strategies need what can be hit.
void RenderSession::check_lights() {
  if (settings_.integrator == IntegratorType::LightTracer && !settings_.next_event &&
      !make_camera(scene_->camera, 1, 1)->hittable()) {
    throw SceneError(scene_->camera.name, "depth of field",
                     "light paths cannot hit this camera (t=0): without next event estimation, "
                     "light tracing needs a perspective camera with depth of field");
  }
  const bool only_hits = settings_.integrator == IntegratorType::PathTracer
                             ? !settings_.next_event
                             : settings_.strategies && settings_.strategies->only_hits();
  if (!only_hits) {
    return;
  }
  size_t hittable = 0;
  for (const auto& light : scene_->lights) {
    hittable += light->hittable() ? 1 : 0;
    if (!light->hittable()) {
      diagnostics_.push_back({Severity::Warning, light->name, "", "",
                              "the light is a point, which no path hits (s=0): it is not rendered "
                              "without next event estimation"});
    }
  }
  if (hittable == 0 && !scene_->lights.empty()) {
    throw SceneError("settings", settings_.strategies ? "strategies" : "next_event",
                     "all lights of the scene are points, which no path hits (s=0): give them a "
                     "radius, or use next event estimation (s=1)");
  }
}

RenderSession::~RenderSession() {
  cancel();
  if (thread_.joinable()) {
    thread_.join();
  }
}

void RenderSession::start() {
  const std::lock_guard lock(mutex_);
  if (state_ != Progress::State::Waiting) {
    throw Error("the session was started before");
  }
  start_time_ = now();
  thread_ = start_thread([this] {
    try {
      run();
      end(cancel_.cancelled() ? Progress::State::Cancelled : Progress::State::Done, nullptr);
    } catch (const Cancelled&) {
      end(Progress::State::Cancelled, nullptr);
    } catch (...) {
      end(Progress::State::Failed, std::current_exception());
    }
  });
  state_ = Progress::State::Rendering;  // now that there is a thread, which cannot end before
}

std::unique_ptr<Integrator> RenderSession::make_integrator(
    const RenderContext& context, const IntegratorSettings& settings) const {
  switch (settings_.integrator) {
    case IntegratorType::PathTracer:
      return make_path_tracer(context, settings);
    case IntegratorType::LightTracer:
      return make_light_tracer(context, settings);
    case IntegratorType::Bdpt:
      break;
  }
  return settings_.connection_mode == ConnectionMode::Classic ? make_classic_bdpt(context, settings)
                                                              : make_bdpt(context, settings);
}

IntegratorSettings RenderSession::integrator_settings(const Scene& scene,
                                                      const Layers& layers) const {
  IntegratorSettings result;
  // Cycles counts bounces between the first surface and the light: 0 leaves camera, surface, light.
  result.walk.max_edges = settings_.max_bounces + 2;
  result.walk.max_crossings = settings_.transparent_max_bounces;
  result.walk.caps = BounceCaps(settings_.max_diffuse_bounces, settings_.max_glossy_bounces,
                                settings_.max_transmission_bounces);
  result.clamp = Clamp(settings_.clamp_direct, settings_.clamp_indirect);
  result.walk.ray_types = scene.has_ray_types;
  result.walk.by_path = scene.has_by_path;
  result.walk.holdouts = scene.has_holdouts;
  result.walk.catchers = layers.caught;
  result.walk.film_transparent = settings_.film_transparent;
  if (settings_.film_transparent && settings_.film_transparent_glass) {
    // A lobe's width is the square of a node's roughness; squares compare as Cycles does.
    result.walk.clear_glass = sqr(sqr(settings_.film_transparent_roughness));
  }
  result.walk.roulette = settings_.roulette;
  result.contribution_roulette = settings_.roulette;
  result.walk.expressions = layers.expressions > 0 ? passes_.automaton() : nullptr;
  result.layers = layers;
  result.strategies = settings_.strategies;
  result.next_event = settings_.next_event;
  result.heuristic = settings_.heuristic;
  result.light_paths = settings_.light_paths;
  result.connections = settings_.connections;
  result.merge_radius = settings_.merge_radius;
  result.adaptive_counts = settings_.adaptive_counts;
  result.seed = settings_.seed;
  result.cache_bytes = settings_.cache_bytes;
  result.check_weights = settings_.check_weights;
  return result;
}

void RenderSession::run() {
  ThreadPool pool(settings_.threads);
  Exposure exposure(scene_, settings_.width, settings_.height, settings_.rect().pixels(),
                    settings_.motion_blur, settings_.seed);
  const RenderContext context{exposure, *film_, pool, cancel_, transport_};
  const IntegratorSettings how = integrator_settings(*scene_, passes_.layers());
  const auto integrator = make_integrator(context, how);
  const auto data =
      data_film_ ? make_data_passes(context, how, settings_.data_settings, *data_film_) : nullptr;
  // Shadow catchers alone, with the same samples: where nothing changes their light, it is the
  // same.
  std::optional<Exposure> footage;
  std::unique_ptr<Integrator> footage_integrator;
  if (catcher_film_) {
    footage.emplace(exposure);
    footage_integrator =
        make_integrator(RenderContext{*footage, *catcher_film_, pool, cancel_},
                        integrator_settings(*scene_->catchers_alone, layers_of_catchers()));
  }

  for (int pass = 0; pass < settings_.samples; ++pass) {
    cancel_.throw_if_cancelled();
    // Only this thread and its pool write a pass, and nobody reads one that has not ended.
    film_->begin_pass();
    if (transport_) {
      transport_->begin_pass();
    }
    integrator->begin_pass(pass);
    if (footage) {
      catcher_film_->begin_pass();
      footage_integrator->begin_pass(pass);
    }
    for (size_t i = 0; i < exposure.times(); ++i) {
      exposure.open(pass, i, cancel_);
      const Wave wave{pass, i, exposure.times()};
      integrator->render_wave(wave);
      if (data) {
        data->render_wave(wave);
      }
      if (footage) {
        footage->open(pass, i, cancel_);
        footage_integrator->render_wave(wave);
      }
    }
    integrator->end_pass();
    if (footage) {
      footage_integrator->end_pass();
    }
    if (transport_) {
      transport_->end_pass(pool);
    }
    const std::lock_guard lock(mutex_);
    film_->end_pass(pool);
    statistics_.samples = pass + 1;
    statistics_.seconds = now() - start_time_;
    statistics_.counters = integrator->counters();
    if (footage) {
      catcher_film_->end_pass(pool);
      statistics_.counters += footage_integrator->counters();
    }
    statistics_.weight_error = integrator->weight_error();
    statistics_.cache_bytes = integrator->cache_bytes();
    statistics_.effort = integrator->effort();
    // Stop where the next whole pass would overshoot the limit by more than half of itself.
    const double per_pass = statistics_.seconds / (pass + 1);
    if (settings_.seconds > 0.0 && statistics_.seconds + 0.5 * per_pass > settings_.seconds) {
      break;
    }
    if (settings_.adaptive() && pass + 1 >= settings_.least_samples() &&
        (pass + 1) % kAdaptiveStep == 0) {
      film_->stop_converged(kThresholdScale * settings_.noise_threshold, settings_.film_exposure,
                            pool);
      if (footage) {
        catcher_film_->stop_with(*film_);
      }
      if (film_->active_pixels() == 0) {
        break;
      }
    }
  }
}

void RenderSession::end(Progress::State state, std::exception_ptr error) {
  const std::lock_guard lock(mutex_);
  state_ = state;
  error_ = error;
  end_time_ = now();
  ended_.notify_all();
}

bool RenderSession::wait(double seconds) {
  std::unique_lock lock(mutex_);
  return ended_.wait_for(lock, std::chrono::duration<double>(seconds),
                         [this] { return state_ > Progress::State::Rendering; });
}

Progress RenderSession::progress() const {
  const std::lock_guard lock(mutex_);
  Progress progress;
  progress.state = state_;
  progress.samples = statistics_.samples;
  progress.target_samples = settings_.samples;
  if (state_ == Progress::State::Waiting) {
    return progress;
  }
  progress.seconds = (state_ == Progress::State::Rendering ? now() : end_time_) - start_time_;
  if (state_ != Progress::State::Rendering) {
    progress.remaining = 0.0;
  } else if (statistics_.samples > 0) {
    const double per_pass = statistics_.seconds / statistics_.samples;
    double total = per_pass * settings_.samples;
    if (settings_.seconds > 0.0) {
      total = std::min(total, settings_.seconds);
    }
    progress.remaining = std::max(0.0, total - progress.seconds);
  }
  return progress;
}

Statistics RenderSession::statistics() const {
  const std::lock_guard lock(mutex_);
  return statistics_;
}

Image RenderSession::snapshot() const {
  const std::lock_guard lock(mutex_);
  if (catcher_film_) {
    return lay_over_footage({*film_, *catcher_film_, passes_.layers()}, !settings_.film_transparent,
                            settings_.shadow_catcher, settings_.film_exposure);
  }
  return film_->develop(settings_.film_exposure);
}

std::vector<std::string> RenderSession::passes() const {
  std::vector<std::string> names{"Combined"};
  for (const RenderPasses::Pass& pass : passes_.all()) {
    names.push_back(pass.name);
  }
  if (settings_.shadow_catcher) {
    names.emplace_back(kShadowCatcher);
  }
  for (const std::string& name : settings_.data.names()) {
    names.push_back(name);
  }
  return names;
}

Image RenderSession::snapshot(const std::string& name) const {
  if (name == "Combined") {
    return snapshot();
  }
  if (const auto data = settings_.data.names(); std::ranges::find(data, name) != data.end()) {
    return data_film_->develop(name);
  }
  if (settings_.shadow_catcher && name == kShadowCatcher) {
    const std::lock_guard lock(mutex_);
    if (catcher_film_) {
      return shadows_on_footage({*film_, *catcher_film_, passes_.layers()});
    }
    Image untouched(film_->rect().width(), film_->rect().height(), 3);
    std::ranges::fill(untouched.pixels, 1.0f);
    return untouched;
  }
  const auto pass = std::ranges::find(passes_.all(), name, &RenderPasses::Pass::name);
  if (pass == passes_.all().end()) {
    throw Error("there is no pass '" + name + "'");
  }
  const std::lock_guard lock(mutex_);
  // Colours of surfaces are no light.
  const float exposure = passes_.layers().is_color(pass->layer) ? 1.0f : settings_.film_exposure;
  Image image = film_->develop_layer(pass->layer, exposure);
  if (catcher_film_ && name == "Env") {  // as in Cycles: footage is laid over it, too
    const Image behind = film_->develop_layer(passes_.layers().behind(), exposure);
    for (size_t i = 0; i < image.pixels.size(); ++i) {
      image.pixels[i] += behind.pixels[i];
    }
  }
  if (pass->color) {
    const Image color = film_->develop_layer(*pass->color);
    for (size_t i = 0; i < image.pixels.size(); ++i) {
      image.pixels[i] = color.pixels[i] != 0.0f ? image.pixels[i] / color.pixels[i] : 0.0f;
    }
  }
  return image;
}

std::map<std::string, std::string> RenderSession::manifest(MatteKind kind) const {
  std::map<std::string, std::string> names;
  const auto add = [&](const std::string& name) {
    names.emplace(name, cryptomatte_hex(cryptomatte_hash(name)));
  };
  if (kind == MatteKind::Material) {
    std::ranges::for_each(scene_->surfaces.material_names(), add);
    return names;
  }
  for (const Instance& instance : scene_->instances) {
    const bool own = kind == MatteKind::Object || instance.names->asset.empty();
    add(own ? instance.names->name : instance.names->asset);
  }
  return names;
}

void RenderSession::finish() {
  {
    std::unique_lock lock(mutex_);
    if (state_ == Progress::State::Waiting) {
      return;
    }
    ended_.wait(lock, [this] { return state_ > Progress::State::Rendering; });
    if (error_) {
      std::rethrow_exception(error_);
    }
  }
}

}  // namespace janus
