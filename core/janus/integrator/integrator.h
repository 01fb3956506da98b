// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "janus/film/film.h"
#include "janus/film/transport_film.h"
#include "janus/integrator/adaptive_counts.h"
#include "janus/integrator/clamp.h"
#include "janus/integrator/layers.h"
#include "janus/integrator/strategies.h"
#include "janus/integrator/wave.h"
#include "janus/path/counters.h"
#include "janus/path/mis.h"
#include "janus/path/subpath.h"
#include "janus/render/exposure.h"
#include "janus/util/cancel.h"
#include "janus/util/parallel.h"

namespace janus {

struct IntegratorSettings {
  WalkSettings walk;
  Clamp clamp;
  Heuristic heuristic = Heuristic::Balance;
  // Next event estimation: to the lights, and in light tracing to the camera. Without it, a path
  // tracer knows only light that its walks hit, and a light tracer only paths that hit the lens.
  bool next_event = true;
  std::optional<Strategies> strategies;  // bdpt: these alone, without weights
  Layers layers;                         // of the film, beside the picture
  float light_paths = 1.0f;              // per pixel
  float connections = 1.0f;              // per camera vertex, expected
  // bdpt: how far apart vertices may be to be merged in the first pass, scene units; 0: not at all.
  float merge_radius = 0.0f;
  // bdpt: the first two passes have these counts, and the others what these passes recommend.
  bool adaptive_counts = false;
  uint32_t seed = 0;
  size_t cache_bytes = size_t{256} << 20;  // upper bound for the light-vertex cache
  bool check_weights = false;  // debug: compare weights of sampled paths with the oracle
  bool contribution_roulette = true;
};

// What an integrator renders with; everything outlives it.
struct RenderContext {
  const Exposure& exposure;
  Film& film;
  ThreadPool& pool;
  const CancelToken& cancel;
  // Gets every contribution, too, by the pixel of the projector that its path starts in: of a scene
  // that is under_projector(), from bdpt. Null: nobody asks.
  TransportFilm* transport = nullptr;

  // What stands before the camera now: for a wave they stay the same.
  const Scene& scene() const { return exposure.scene(); }
  const Camera& camera() const { return exposure.camera(); }
};

// Renders whole passes: one camera sample per pixel, and light paths in proportion.
class Integrator {
 public:
  virtual ~Integrator() = default;

  // Passes come in order, from 0, each as begin_pass(), all of its waves in order, end_pass().
  virtual void begin_pass(int pass) { (void)pass; }
  // Adds a part of the pass to the film, which expects that. Depends on scene, settings and what
  // was before. Throws Cancelled.
  virtual void render_wave(const Wave& wave) = 0;
  virtual void end_pass() {}

  // Over all passes so far. Not within one.
  virtual Counters counters() const = 0;

  // Largest |weight - definition| seen by check_weights, over `paths` joins.
  virtual double weight_error() const { return 0.0; }

  // Most bytes that the light-vertex cache has held.
  virtual size_t cache_bytes() const { return 0; }

  // What the next pass will do, per pixel and camera vertex.
  virtual Effort effort() const { return {0.0f, 0.0f}; }
};

std::unique_ptr<Integrator> make_path_tracer(const RenderContext& context,
                                             const IntegratorSettings& settings);
std::unique_ptr<Integrator> make_light_tracer(const RenderContext& context,
                                              const IntegratorSettings& settings);
std::unique_ptr<Integrator> make_bdpt(const RenderContext& context,
                                      const IntegratorSettings& settings);
// bdpt as it was first described: without a cache, each light path belongs to one pixel.
std::unique_ptr<Integrator> make_classic_bdpt(const RenderContext& context,
                                              const IntegratorSettings& settings);

}  // namespace janus
