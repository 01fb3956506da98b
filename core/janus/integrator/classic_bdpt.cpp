// SPDX-License-Identifier: GPL-3.0-or-later
//
// Bidirectional path tracing as Lafortune and Willems (1993) and Veach and Guibas (1994) describe
// it, and as it is taught: for each pixel sample a light path and a camera path are traced, and
// every vertex of the one is joined with every vertex of the other. bdpt.cpp finds the same light
// sooner; this is the one to read first.
#include "janus/integrator/bidirectional.h"

namespace janus {

namespace {

class ClassicBdpt final : public BidirectionalIntegrator {
 public:
  ClassicBdpt(const RenderContext& context, const IntegratorSettings& settings)
      : BidirectionalIntegrator(context, settings) {}

  void begin_pass(int) override {
    // Of a path with k edges, each pair of subpaths tries every strategy once. Only those with one
    // camera vertex (t=1) may fall on any pixel: all light paths of the pass try them.
    light_paths_ = light_path_count(1.0f);
    if (light_paths_ > 0) {
      counts_.connection = 1.0f;
      counts_.splat = static_cast<float>(light_paths_);
    }
    renew_weights();
  }

  void render_wave(const Wave& wave) override {
    start_splats(context_.film.rect().height());
    std::vector<CacheBlock> light_paths(context_.film.rect().height());
    for_each_pixel(wave, [&](size_t i, size_t row, Counters& counters) {
      CacheBlock& light_path = light_paths[row];
      light_path.clear();
      if (light_paths_ > 0) {
        trace_light_path(i, wave.pass, row, light_path, counters);
      }
      trace_camera_path(i, wave.pass, light_path, counters);
    });
    splats_.add_to(context_.film, context_.pool);
  }

  Effort effort() const override { return {light_path_count(1.0f) > 0 ? 1.0f : 0.0f, 1.0f}; }

 private:
  // The light path of pixel `index`: splats each vertex and keeps it.
  void trace_light_path(size_t index, int pass, size_t row, CacheBlock& light_path,
                        Counters& counters) {
    const float margin = context_.film.filter().radius();
    Sampler sampler(settings_.seed, Stream::Light, 0,
                    static_cast<uint64_t>(pass) * context_.film.rect().pixels() + index);
    trace_light_subpath(context_.scene(), mis_, settings_.walk, sampler, counters,
                        [&](const PathVertex& v, Sampler& walk) {
                          splat(v, counts_.splat, roulettes_, margin, walk, row, counters,
                                [](vec2, Rgb, const MisWeight&) {});
                          if (v.bsdf().connectible()) {
                            light_path.add(v);
                          }
                        });
    counters.light_vertices += light_path.vertices.size();
  }

  void trace_camera_path(size_t index, int pass, const CacheBlock& light_path, Counters& counters) {
    Sampler sampler = camera_sampler(index, pass);
    sampler.start_block(0);
    const vec2 raster = context_.film.sample_position(index, sampler.next_2d());
    Sample sample{index};
    const ViewCoverage coverage = trace_camera_subpath(
        context_.scene(), context_.camera(), raster, mis_, settings_.walk, sampler, counters,
        [&](const LightFound& found) { gather_light(found, 1.0f, sample, counters); },
        [&](const PathVertex& v, Sampler& walk) {
          see(v, index);
          if (!v.bsdf().connectible()) {
            return;
          }
          MisWeight weight;
          gather_next_event(v, Roulette(), walk, sample, counters, weight);
          for (const LightVertex& l : light_path.vertices) {
            gather_connection(l, light_path, v, 1.0f, Roulette(), walk, sample, counters, weight);
          }
        });
    add_sample(index, sample.sum, coverage);
  }

  size_t light_paths_ = 0;       // of a pass: one per pixel
  const RouletteMap roulettes_;  // without a picture: none
};

}  // namespace

std::unique_ptr<Integrator> make_classic_bdpt(const RenderContext& context,
                                              const IntegratorSettings& settings) {
  return std::make_unique<ClassicBdpt>(context, settings);
}

}  // namespace janus
