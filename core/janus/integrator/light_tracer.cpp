// SPDX-License-Identifier: GPL-3.0-or-later
//
// Light tracing, with next event estimation to the camera: each vertex of a light path is splatted.
// It never finds what reaches the camera by way of a smooth mirror or glass, where no direction but
// one has a value. Without, light paths have to hit the lens by themselves (t=0), as camera paths
// hit lights in a path tracer without next event estimation: that finds all, if the camera has a
// lens, and seldom. Light that the camera sees directly comes from one camera ray per pixel.
#include "janus/integrator/pass.h"
#include "janus/integrator/splats.h"
#include "janus/path/connect.h"

namespace janus {

namespace {

class LightTracer final : public PassIntegrator {
 public:
  using PassIntegrator::PassIntegrator;

  void begin_pass(int) override { light_paths_ = light_path_count(settings_.light_paths); }
  void render_wave(const Wave& wave) override {
    trace_lights(wave);
    trace_directly_visible(wave);
  }
  void end_pass() override { first_light_path_ += light_paths_; }

 private:
  // Weights are not used: every path has one technique here.
  const Mis mis_{Heuristic::Balance, SampleCounts{}};
  Splats splats_;
  size_t light_paths_ = 0;         // of the pass
  uint64_t first_light_path_ = 0;  // of the pass, among all

  void trace_lights(const Wave& wave) {
    const size_t count = light_paths_;
    const size_t begin = wave.begin(count), end = wave.end(count);
    const float margin = context_.film.filter().radius();
    const size_t blocks = (end - begin + kLightBlock - 1) / kLightBlock;
    splats_.start(blocks);
    context_.pool.parallel_for(blocks, [&](size_t block) {
      context_.cancel.throw_if_cancelled();
      Counters counters;
      const auto add_splat = [&](vec2 raster, Rgb value, const SortedPath& path) {
        if (settings_.layers.any()) {
          splats_.add(block, raster, value, [&](auto&& add) { sort(value, path, add); });
        } else {
          splats_.add(block, raster, value);
        }
      };
      const size_t block_begin = begin + block * kLightBlock;
      for (size_t i = block_begin; i < std::min(end, block_begin + kLightBlock); ++i) {
        Sampler sampler(settings_.seed, Stream::Light, 0, first_light_path_ + i);
        if (settings_.next_event) {
          trace_light_subpath(context_.scene(), mis_, settings_.walk, sampler, counters,
                              [&](const PathVertex& v, Sampler& walk) {
                                splat(v, walk, margin, count, counters, add_splat);
                              });
        } else {
          trace_light_subpath(
              context_.scene(), mis_, settings_.walk, sampler, counters,
              [](const PathVertex&, Sampler&) {},
              [&](const Ray& ray, float t_begin, float t_end, const PathVertex& v) {
                hit_lens(ray, t_begin, t_end, v, margin, count, counters, add_splat);
              });
        }
      }
      add(counters);
    });
    splats_.add_to(context_.film, context_.pool);
  }

  // t=0.
  template <class AddSplat>
  void hit_lens(const Ray& ray, float t_begin, float t_end, const PathVertex& v, float margin,
                size_t count, Counters& counters, AddSplat&& add_splat) const {
    const auto lens = context_.camera().hit_lens(ray, t_begin, t_end, margin);
    if (!lens) {
      return;
    }
    Rgb value = settings_.clamp(v.beta * lens->importance / static_cast<float>(count), v.edges + 1);
    if (usable(value, counters)) {
      const bool caught =
          settings_.walk.catchers && catch_segment(context_.scene(), ray.origin, lens->position,
                                                   v.caught, settings_.walk, value);
      add_splat(lens->raster, value, {states(v.trace), camera_state(), {}, caught});
    }
  }

  // Adds the parts of `value` to the layers that its path belongs to.
  template <class Add>
  void sort(Rgb value, const SortedPath& path, Add&& add) const {
    // There are no images of strategies here: which it is does not matter.
    settings_.layers.spread(value, 1.0f, {}, settings_.walk.expressions, path, add);
  }

  template <class AddSplat>
  void splat(const PathVertex& v, Sampler& sampler, float margin, size_t count, Counters& counters,
             AddSplat&& add_splat) const {
    UnreadVertices unread;
    const auto s = connect_to_camera(v, context_.camera(), sampler.next_2d(), margin, mis_,
                                     settings_.walk, reads(unread));
    const int crossings = settings_.walk.max_crossings - v.crossings;
    if (!s || crossings < 0 || !usable(s->connection.value, counters)) {
      return;
    }
    ++counters.splat_rays;
    const Connection& c = s->connection;
    Rgb value = c.value * c.transmittance(context_.scene(), crossings);
    if (!is_black(value)) {
      const bool caught = settings_.walk.catchers && catch_segment(context_.scene(), c.from, c.to,
                                                                   v.caught, settings_.walk, value);
      add_splat(s->raster, settings_.clamp(value / static_cast<float>(count), v.edges + 1),
                {states(v.trace), camera_state(), unread, caught});
    }
  }

  void trace_directly_visible(const Wave& wave) {
    WalkSettings walk = settings_.walk;
    if (walk.clear_glass < 0.0f) {  // else alpha needs what is behind glass
      walk.max_edges = settings_.layers.colors ? 2 : 1;
    }
    for_each_pixel(wave, [&](size_t i, size_t, Counters& counters) {
      Sampler sampler = camera_sampler(i, wave.pass);
      sampler.start_block(0);
      const vec2 raster = context_.film.sample_position(i, sampler.next_2d());
      Rgb sum(0.0f);
      const ViewCoverage coverage = trace_camera_subpath(
          context_.scene(), context_.camera(), raster, mis_, walk, sampler, counters,
          [&](const LightFound& found) {
            if (found.edges == 1) {
              const Rgb value = settings_.clamp(found.beta * found.hit.radiance, 1);
              sum += value;
              if (settings_.layers.any() && is_finite(value)) {
                const WeightedState light = light_state(found.light);
                const std::span<Rgb> layers = context_.film.layers_at(i);
                sort(value, path_of_light(found, light), [&](LayerMask mask, Rgb part) {
                  mask.for_each([&](size_t layer) { layers[layer] += part; });
                });
              }
            }
          },
          [&](const PathVertex& v, Sampler&) { see(v, i); });
      add_sample(i, usable(sum, counters) ? sum : Rgb(0.0f), coverage);
    });
  }
};

}  // namespace

std::unique_ptr<Integrator> make_light_tracer(const RenderContext& context,
                                              const IntegratorSettings& settings) {
  return std::make_unique<LightTracer>(context, settings);
}

}  // namespace janus
