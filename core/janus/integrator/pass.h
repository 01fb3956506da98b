// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the integrators share: how a pass is cut into blocks, and the accounting.
#pragma once

#include <mutex>

#include "janus/integrator/integrator.h"

namespace janus {

// Light paths per block: large enough to hide the hand-over, small enough for quick cancelling.
inline constexpr size_t kLightBlock = 1024;

class PassIntegrator : public Integrator {
 public:
  PassIntegrator(const RenderContext& context, const IntegratorSettings& settings)
      : context_(context), settings_(settings) {
    if (settings.walk.expressions) {
      camera_state_ = PathStates(settings.walk.expressions->from_camera());
    }
  }

  Counters counters() const override { return counters_; }

 protected:
  // Blocks report their counters when they end; sums of integers do not depend on the order.
  void add(const Counters& counters) {
    const std::lock_guard lock(mutex_);
    counters_ += counters;
  }

  // Of a pass: for each pixel that takes part in it.
  size_t light_path_count(float per_pixel) const {
    return context_.scene().light_sampler.emits()
               ? static_cast<size_t>(per_pixel * context_.film.active_pixels() + 0.5)
               : 0;
  }

  // The camera's side of paths that end at nothing but the camera.
  std::span<const WeightedState> camera_state() const { return camera_state_.all(); }

  // The light's side of paths that start with nothing but light `index`.
  WeightedState light_state(size_t index) const {
    const PathAutomaton* automaton = settings_.walk.expressions;
    return {automaton ? automaton->from_light(index) : PathAutomaton::kDead, Rgb(1.0f)};
  }
  // What was read of a subpath before its present vertex.
  static std::span<const WeightedState> states(const PathTrace* trace) {
    return trace ? trace->states() : std::span<const WeightedState>();
  }
  // Where joins keep what is to be read, if anybody reads.
  UnreadVertices* reads(UnreadVertices& unread) const {
    return settings_.walk.expressions ? &unread : nullptr;
  }

  // A path to a light that a camera walk has found; `light`: its state.
  SortedPath path_of_light(const LightFound& found, const WeightedState& light) const {
    if (!found.trace) {
      return {{}, {}, {}, found.caught};
    }
    if (found.edges == 1) {
      return {{&light, 1}, found.trace->states(), {}, found.caught};
    }
    UnreadVertex z_1 = found.trace->vertex();
    if (settings_.walk.ray_types) {
      z_1.shares = z_1.shares.lit(context_.scene().lights[found.light]->visibility);
    }
    return {{&light, 1}, found.trace->before(), UnreadVertices(z_1), found.caught};
  }

  // Keeps the colours of what the camera sees in pixel `index`, if `v` is that.
  void see(const PathVertex& v, size_t index) {
    if (settings_.layers.colors && v.edges == 1 &&
        v.shading.bsdf.kind() != VertexKind::SubsurfaceExit) {
      settings_.layers.add_color(v.bsdf(), v.back, v.beta, context_.film.layers_at(index));
    }
  }

  // The sample of a pixel is complete.
  void add_sample(size_t index, Rgb value, const ViewCoverage& coverage) {
    context_.film.add_sample(index, value, coverage.alpha);
    if (settings_.layers.matte) {
      ViewCoverage seen = coverage;
      seen.behind = settings_.clamp(seen.behind, 1);
      settings_.layers.add_coverage(seen, context_.film.layers_at(index));
    }
  }

  // The sampler of a camera sample. Keyed by the pixel of the full frame: a crop shows the same
  // samples as the whole picture.
  Sampler camera_sampler(size_t index, int pass) const {
    return pixel_sampler(Stream::Camera, index, pass);
  }
  Sampler pixel_sampler(Stream stream, size_t index, uint64_t number) const {
    const FilmRect& rect = context_.film.rect();
    const uint64_t x = rect.x0 + index % rect.width(), y = rect.y0 + index / rect.width();
    return Sampler(settings_.seed, stream, y << 32 | x, number);
  }

  // Calls body(row, Counters&) for all rows.
  template <class Body>
  void for_each_row(Body&& body) {
    context_.pool.parallel_for(context_.film.rect().height(), [&](size_t row) {
      context_.cancel.throw_if_cancelled();
      Counters counters;
      body(row, counters);
      add(counters);
    });
  }

  // Calls body(pixel index, row, Counters&) for the pixels of the wave.
  template <class Body>
  void for_each_pixel(const Wave& wave, Body&& body) {
    const size_t width = context_.film.rect().width();
    for_each_row([&](size_t row, Counters& counters) {
      for (size_t x = 0; x < width; ++x) {
        const size_t index = row * width + x;
        if (wave.includes(x, row) && context_.film.active(index)) {
          body(index, row, counters);
        }
      }
    });
  }

  // A contribution that is not finite is dropped and counted.
  static bool usable(Rgb value, Counters& counters) {
    if (!is_finite(value)) {
      ++counters.dropped;
      return false;
    }
    return !is_black(value);
  }

  RenderContext context_;
  IntegratorSettings settings_;

 private:
  PathStates camera_state_;
  std::mutex mutex_;
  Counters counters_;
};

}  // namespace janus
