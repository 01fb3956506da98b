// SPDX-License-Identifier: GPL-3.0-or-later
//
// Bidirectional path tracing with a light-vertex cache (Davidovic et al. 2014). A pass traces N_L
// light paths, splatting each vertex (t=1) and caching it, then one camera path per pixel with
// emission hits (s=0), next event estimation (s=1) and C connections per vertex to cache entries
// picked uniformly. Counts may be zero: without light paths this is a path tracer.
//
// With a merge radius, each camera vertex is also merged with the cached vertices around it
// (Georgiev et al. 2012): that finds caustics which are seen in mirrors or through glass, and blurs
// light by the radius, which shrinks from pass to pass.
//
// Pixels that see smooth glass or a mirror have additional walks: specular_walks.h.
//
// To bound the cache, waves run in parts: a range of light paths with a cache of their own, then an
// interleaved subset of the pixels.
#include "janus/integrator/adaptive_counts.h"
#include "janus/integrator/bidirectional.h"
#include "janus/integrator/merging.h"
#include "janus/integrator/pilot.h"
#include "janus/integrator/specular_walks.h"
#include "janus/path/oracle.h"

namespace janus {

namespace {

constexpr int kMeasuredPass = 1;      // adaptive counts; the pass before it shows what is bright
constexpr size_t kOracleStride = 97;  // debug mode checks every 97th pixel

class Bdpt final : public BidirectionalIntegrator {
 public:
  Bdpt(const RenderContext& context, const IntegratorSettings& settings)
      : BidirectionalIntegrator(context, settings),
        effort_{settings.light_paths, settings.connections},
        merging_(settings.merge_radius, context.scene().accel->bounds()),
        specular_walks_(context.film.rect()),
        specular_(settings.walk) {
    specular_.specular = true;
    if (light_path_count(effort_.light_paths) > 0 &&
        (effort_.connections > 0.0f || merging_.used())) {
      cached_path_ = measure_cached_path(context, settings, mis_, merging_.used());
    }
    set_effort(effort_);
    if (!plain() && !settings_.check_weights && !context.transport) {
      path_tracer_ = make_path_tracer(context, settings);
    }
  }

  void begin_pass(int pass) override {
    if (only_traces_paths()) {
      return;
    }
    if (pixels_ != context_.film.active_pixels()) {
      set_effort(effort_);
    }
    if (settings_.contribution_roulette && !plain()) {
      roulette_.update(context_.film, pass);
    }
    if (pass == kMeasuredPass && adapts()) {
      meter_.emplace(counts_);
    }
    if (walks_more()) {
      specular_walks_.begin_pass(pass, work_);
    }
    before_ = counters();
    if (merges()) {
      merging_.begin_pass(pass);
      counts_.merge =
          merging_.count(static_cast<float>(light_paths_) / static_cast<float>(waves()));
      renew_weights();
    }
  }

  void render_wave(const Wave& wave) override {
    if (only_traces_paths()) {
      path_tracer_->render_wave(wave);
      return;
    }
    for (size_t i = 0; i < parts_; ++i) {
      const Wave part = wave.part(i, parts_);
      trace_lights(part);
      trace_camera(part);
    }
  }

  void end_pass() override {
    if (only_traces_paths()) {
      return;
    }
    first_light_path_ += light_paths_;
    work_ = counters();
    work_ -= before_;
    if (meter_) {
      adapt(work_);
    }
  }

  Counters counters() const override {
    Counters sum = PassIntegrator::counters();
    return path_tracer_ ? sum += path_tracer_->counters() : sum;
  }
  Effort effort() const override { return effort_; }
  double weight_error() const override { return weight_error_; }
  size_t cache_bytes() const override { return cache_bytes_; }

 private:
  // Weights with a square tell less about other counts, and debugging wants the counts given.
  bool adapts() const {
    return settings_.adaptive_counts && settings_.heuristic == Heuristic::Balance && !merges() &&
           !plain() && effort_.light_paths > 0.0f && effort_.connections > 0.0f &&
           light_paths_ > 0 && counts_.connection > 0.0f;
  }

  // Without light paths this is path tracing, at its cost.
  bool only_traces_paths() const { return light_paths_ == 0 && path_tracer_; }

  // Are the strategies to be seen as they are?
  bool plain() const { return settings_.strategies || settings_.layers.longest > 0; }

  // Is there light for specular walks to find?
  bool walks_more() const {
    return context_.scene().surfaces.any_delta() && !plain() &&
           std::ranges::any_of(context_.scene().lights,
                               [](const auto& l) { return l->hittable(); });
  }

  bool merges() const { return merging_.used() && light_paths_ > 0 && !plain(); }

  // Are there paths that camera walks cannot make? A light that cannot be hit, behind a delta.
  bool needs_light_paths() const {
    return context_.scene().surfaces.any_delta() &&
           std::ranges::any_of(context_.scene().lights,
                               [](const auto& l) { return !l->hittable(); });
  }

  void adapt(const Counters& work) {
    const Effort factor = AdaptiveCounts::choose(moments_, work, needs_light_paths());
    set_effort(
        {effort_.light_paths * factor.light_paths,
         std::min(effort_.connections * factor.connections, VertexCache::kMostPicks - 1.0f)});
    meter_.reset();
  }

  void set_effort(const Effort& effort) {
    effort_ = effort;
    pixels_ = context_.film.active_pixels();
    // A wave without light paths would leave its pixels without connections.
    light_paths_ = light_path_count(effort.light_paths);
    if (light_paths_ > 0) {
      light_paths_ = std::max(light_paths_, context_.exposure.times());
    }
    counts_.splat = static_cast<float>(light_paths_);
    const bool connect =
        light_paths_ > 0 && effort.connections > 0.0f && cached_path_.vertices > 0.0f;
    counts_.connection = connect ? effort.connections / cached_path_.vertices : 0.0f;
    const double pass_bytes =
        connect || merges() ? cached_path_.bytes * static_cast<double>(light_paths_) : 0.0;
    const double wave_bytes = pass_bytes / static_cast<double>(context_.exposure.times());
    const size_t wave_paths = light_paths_ / context_.exposure.times();
    parts_ = std::min(1 + static_cast<size_t>(1.1 * wave_bytes / settings_.cache_bytes),
                      std::max<size_t>(1, wave_paths / kLightBlock));
    renew_weights();
  }

  // Of a pass.
  size_t waves() const { return context_.exposure.times() * parts_; }

  void trace_lights(const Wave& wave) {
    const size_t begin = wave.begin(light_paths_), end = wave.end(light_paths_);
    wave_paths_ = end - begin;
    const size_t blocks = (wave_paths_ + kLightBlock - 1) / kLightBlock;
    const float margin = context_.film.filter().radius();
    const bool keep = counts_.connection > 0.0f || merges();
    const std::span<CacheBlock> caches = cache_.start(blocks);
    start_splats(blocks);
    std::vector<AdaptiveCounts::Moments> moments(meter_ ? blocks : 1);
    context_.pool.parallel_for(blocks, [&](size_t block) {
      context_.cancel.throw_if_cancelled();
      caches[block].clear();
      Counters counters;
      const size_t block_end = std::min(end, begin + (block + 1) * kLightBlock);
      for (size_t i = begin + block * kLightBlock; i < block_end; ++i) {
        Sampler sampler(settings_.seed, Stream::Light, 0, first_light_path_ + i);
        trace_light_subpath(context_.scene(), mis_, settings_.walk, sampler, counters,
                            [&](const PathVertex& v, Sampler& walk) {
                              splat(v, static_cast<float>(light_paths_), roulette_, margin, walk,
                                    block, counters, [&](vec2 raster, Rgb value, const auto& w) {
                                      gauge(raster, moments[meter_ ? block : 0]).add(value, w);
                                    });
                              if (keep && worth_caching(v, merging_.used())) {
                                caches[block].add(v);
                              }
                            });
      }
      counters.light_vertices = caches[block].vertices.size();
      add(counters);
    });
    splats_.add_to(context_.film, context_.pool);
    collect(moments);
    cache_.finish();
    cache_bytes_ = std::max(cache_bytes_, cache_.bytes());
    if (merges()) {
      merging_.build(cache_, wave_paths_);
    }
  }

  void trace_camera(const Wave& wave) {
    const size_t width = context_.film.rect().width();
    std::vector<AdaptiveCounts::Moments> moments(meter_ ? context_.film.rect().height() : 1);
    for_each_row([&](size_t row, Counters& counters) {
      AdaptiveCounts::Gauge previous;
      for (size_t x = 0; x < width; ++x) {
        if (wave.includes(x, row) && context_.film.active(row * width + x)) {
          previous = trace_pixel(row * width + x, wave.pass, previous, moments[meter_ ? row : 0],
                                 counters);
        }
      }
    });
    collect(moments);
  }

  // In the order of the blocks, whichever thread filled them.
  void collect(const std::vector<AdaptiveCounts::Moments>& moments) {
    for (const AdaptiveCounts::Moments& m : moments) {
      moments_ += m;
    }
  }

  AdaptiveCounts::Gauge gauge(vec2 raster, AdaptiveCounts::Moments& moments) const {
    return meter_ ? AdaptiveCounts::Gauge(&*meter_, moments, roulette_.value(raster))
                  : AdaptiveCounts::Gauge();
  }

  AdaptiveCounts::Gauge trace_pixel(size_t index, int pass, const AdaptiveCounts::Gauge& previous,
                                    AdaptiveCounts::Moments& moments, Counters& counters) {
    Sampler sampler = camera_sampler(index, pass);
    sampler.start_block(0);
    const vec2 raster = context_.film.sample_position(index, sampler.next_2d());
    const Roulette roulette = roulette_.at(raster);
    // Where nothing else asks for shadow rays, its one ray costs less than roulette's noise.
    const Roulette nee_roulette = counts_.connection > 0.0f ? roulette : Roulette();
    const float share = specular_walks_.share(index);
    AdaptiveCounts::Gauge meter = gauge(raster, moments);
    Sample sample{index};
    const ViewCoverage coverage = trace_camera_subpath(
        context_.scene(), context_.camera(), raster, mis_, settings_.walk, sampler, counters,
        [&](const LightFound& found) {
          const Rgb value = gather_light(found, found.specular ? share : 1.0f, sample, counters);
          if (found.edges > 1) {  // straight into the light: the same whatever the counts
            meter.add_single(value, found.weight, found.edges, false);
          }
        },
        [&](const PathVertex& v, Sampler& walk) {
          see(v, index);
          if (v.edges == 1 && std::ranges::any_of(v.bsdf().lobes(), is_delta)) {
            specular_walks_.saw(index);
          }
          if (v.bsdf().connectible()) {
            const VertexCache::Picks picks = counts_.connection > 0.0f
                                                 ? cache_.pick(effort_.connections, walk)
                                                 : VertexCache::Picks();
            MisWeight weight;
            const Rgb direct = gather_next_event(v, nee_roulette, walk, sample, counters, weight);
            if (!is_black(direct)) {
              meter.add_single(direct, weight, v.edges + 1, true);
            }
            connect(v, picks, roulette, walk, meter, sample, counters);
            if (merges()) {
              context_.cancel.throw_if_cancelled();  // with a large radius there is much to do
              merging_.gather(v, mis_, settings_.walk, counters,
                              [&](const LightVertex& l, const CacheBlock& block, const Merge& m,
                                  const UnreadVertices& unread) {
                                gather_merge(m, l, v, sample, counters, [&] {
                                  return SortedPath{block.states_of(l), states(v.trace), unread,
                                                    v.caught};
                                });
                              });
            }
          }
        });
    for (int i = 0; i < specular_walks_.count(index); ++i) {
      walk_specular(specular_walks_.first() + i, share, sample, counters);
    }
    add_sample(index, sample.sum, coverage);
    if (settings_.check_weights && index % kOracleStride == 0) {
      check(raster, index, pass);
    }
    meter.pair(previous);
    return meter;
  }

  // What a walk over deltas alone finds, the `number`th additional one of the pixel.
  void walk_specular(uint64_t number, float share, Sample& sample, Counters& counters) {
    Sampler sampler = pixel_sampler(Stream::Specular, sample.index, number);
    sampler.start_block(0);
    const vec2 raster = context_.film.sample_position(sample.index, sampler.next_2d());
    Counters walked;
    trace_camera_subpath(
        context_.scene(), context_.camera(), raster, mis_, specular_, sampler, walked,
        [&](const LightFound& found) {
          if (found.specular) {
            gather_light(found, share, sample, counters);
          }
        },
        [](const PathVertex&, Sampler&) {});
    ++counters.specular_walks;
    counters.specular_rays += walked.camera_rays;
  }

  void connect(const PathVertex& v, const VertexCache::Picks& picks, const Roulette& roulette,
               Sampler& sampler, AdaptiveCounts::Gauge& meter, Sample& sample, Counters& counters) {
    // The actual size belongs to the estimate, the expected one (in counts_) to the weights.
    const float scale =
        static_cast<float>(cache_.size()) / (effort_.connections * static_cast<float>(wave_paths_));
    for (int n = 0; n < picks.count; ++n) {
      const auto& [block, vertex] = picks.entries[n];
      MisWeight weight;
      const Rgb value =
          gather_connection(*vertex, *block, v, scale, roulette, sampler, sample, counters, weight);
      if (!is_black(value)) {
        meter.add(value, weight);
      }
    }
  }

  template <class Path>
  void gather_merge(const Merge& merged, const LightVertex& l, const PathVertex& v, Sample& sample,
                    Counters& counters, Path&& path) {
    const float w = merged.weight.value;
    const Technique technique{l.edges + 1, v.edges};
    gather(settings_.clamp(merged.value * w, technique.edges()), w, technique, l.pixel, sample,
           counters, path);
  }

  void check(vec2 raster, size_t index, int pass) {
    const WeightCheck result =
        check_weights(context_.scene(), context_.camera(), raster, settings_.heuristic, counts_,
                      settings_.walk, settings_.seed + pass, index);
    const std::lock_guard lock(check_mutex_);
    weight_error_ = std::max(weight_error_, result.max_error);
  }

  Effort effort_;
  std::unique_ptr<Integrator> path_tracer_;  // for passes without light paths
  size_t pixels_ = 0, light_paths_ = 0;      // of a pass
  uint64_t first_light_path_ = 0;            // of the pass, among all
  CachedPath cached_path_;
  size_t parts_ = 1;                     // of each wave, so that the cache stays small
  size_t wave_paths_ = 0;                // light paths of the present part
  std::optional<AdaptiveCounts> meter_;  // while the counts are measured
  AdaptiveCounts::Moments moments_;
  VertexCache cache_;
  Merging merging_;
  SpecularWalks specular_walks_;
  WalkSettings specular_;
  Counters before_;         // the pass that runs
  Counters work_;           // of the pass before
  size_t cache_bytes_ = 0;  // the largest so far
  RouletteMap roulette_;
  std::mutex check_mutex_;
  double weight_error_ = 0.0;
};

}  // namespace

std::unique_ptr<Integrator> make_bdpt(const RenderContext& context,
                                      const IntegratorSettings& settings) {
  return std::make_unique<Bdpt>(context, settings);
}

}  // namespace janus
