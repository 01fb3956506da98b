// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "janus/film/film.h"
#include "janus/integrator/data_passes.h"
#include "janus/integrator/integrator.h"

namespace janus {

enum class IntegratorType { Bdpt, PathTracer, LightTracer };

// bdpt: a cache of light vertices for all pixels, or a light path for each camera path.
enum class ConnectionMode { Cache, Classic };

// A picture beside the main one, of the paths that a light path expression describes.
struct ExpressionPass {
  std::string name, expression;
  bool operator==(const ExpressionPass&) const = default;
};

// What to render; the scene says of what.
struct RenderSettings {
  int width = 640, height = 360;  // full frame, pixels
  std::optional<FilmRect> crop;   // the part to render
  int samples = 64;               // passes
  // Adaptive sampling, as in Cycles: pixels with less noise take part in no more passes. 0: all do.
  float noise_threshold = 0.0f;
  int min_samples = 0;   // that a pixel gets before it may stop; 0: by the threshold
  double seconds = 0.0;  // time limit; 0: none. The first pass always completes
  uint32_t seed = 0;
  int threads = 0;                 // 0: one per hardware thread
  int max_bounces = 12;            // as in Cycles: 0 is direct light only
  int max_diffuse_bounces = 1024;  // of them by kind, with no limit of their own
  int max_glossy_bounces = 1024;
  int max_transmission_bounces = 1024;
  int transparent_max_bounces = 8;  // surfaces that a path passes by alpha or transparency
  // Most that a contribution of direct or of indirect light adds to a sample; 0: no limit.
  float clamp_direct = 0.0f, clamp_indirect = 0.0f;
  IntegratorType integrator = IntegratorType::Bdpt;
  FilterType filter = FilterType::BlackmanHarris;
  float filter_width = 1.5f;     // pixels
  float light_paths = 1.0f;      // per pixel
  float connections = 1.0f;      // per camera vertex
  float merge_radius = 0.0f;     // bdpt: IntegratorSettings::merge_radius
  bool adaptive_counts = false;  // bdpt: IntegratorSettings::adaptive_counts
  Heuristic heuristic = Heuristic::Balance;
  std::optional<Strategies> strategies;  // bdpt: IntegratorSettings::strategies
  ConnectionMode connection_mode = ConnectionMode::Cache;
  bool next_event = true;                   // IntegratorSettings::next_event
  std::vector<ExpressionPass> expressions;  // at most PathAutomaton::kMostExpressions
  std::vector<std::string> light_passes;    // Cycles' passes of light, by names in light_passes()
  int strategy_images = 0;                  // bdpt: Layers::longest
  // The pass "Shadow Catcher". The picture is then without what it shows.
  bool shadow_catcher = false;
  DataChoice data;  // passes of what the camera sees
  DataSettings data_settings;
  bool motion_blur = true;     // of what moves in the scene
  float film_exposure = 1.0f;  // a factor of the finished picture's colour
  bool film_transparent = false;
  // On a transparent film: the world is not seen through glass of up to this roughness either.
  bool film_transparent_glass = false;
  float film_transparent_roughness = 0.1f;
  bool roulette = true;        // Russian roulette on walks and on contributions
  bool check_weights = false;  // debug: IntegratorSettings::check_weights
  size_t cache_bytes = size_t{256} << 20;

  bool adaptive() const { return noise_threshold > 0.0f; }
  // min_samples, or Cycles' number.
  int least_samples() const;

  FilmRect rect() const { return crop.value_or(FilmRect{0, 0, width, height}); }

  // Throws SceneError naming the setting.
  void validate() const;
};

}  // namespace janus
