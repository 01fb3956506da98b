// SPDX-License-Identifier: GPL-3.0-or-later
//
// Light tracing with next event estimation to the camera: each vertex of a light path is splatted.
// A pinhole cannot be hit, so what reaches the camera by way of a smooth mirror or glass is not
// found. Light that the camera sees directly comes from one camera ray per pixel.
#include "janus/integrator/pass.h"
#include "janus/path/connect.h"

namespace janus {

namespace {

class LightTracer final : public PassIntegrator {
 public:
  using PassIntegrator::PassIntegrator;

  void render_pass(int pass) override {
    trace_lights(pass);
    trace_directly_visible(pass);
  }

 private:
  // Weights are not used: every path has one technique here.
  const Mis mis_{Heuristic::Balance, SampleCounts{}};

  void trace_lights(int pass) {
    const size_t count = light_path_count(settings_.light_paths);
    const float margin = context_.film.filter().radius();
    std::vector<std::vector<Splat>> splats((count + kLightBlock - 1) / kLightBlock);
    context_.pool.parallel_for(splats.size(), [&](size_t block) {
      context_.cancel.throw_if_cancelled();
      Counters counters;
      const size_t end = std::min(count, (block + 1) * kLightBlock);
      for (size_t i = block * kLightBlock; i < end; ++i) {
        Sampler sampler(settings_.seed, Stream::Light, 0, static_cast<uint64_t>(pass) * count + i);
        trace_light_subpath(context_.scene, mis_, settings_.walk, sampler, counters,
                            [&](const PathVertex& v, Sampler& walk) {
                              splat(v, walk, margin, count, splats[block], counters);
                            });
      }
      add(counters);
    });
    context_.film.add_splats(splats, context_.pool);
  }

  void splat(const PathVertex& v, Sampler& sampler, float margin, size_t count,
             std::vector<Splat>& out, Counters& counters) const {
    const auto s =
        connect_to_camera(v, context_.camera, sampler.next_2d(), margin, mis_, settings_.walk);
    const int crossings = settings_.walk.max_crossings - v.crossings;
    if (!s || crossings < 0 || !usable(s->connection.value, counters)) {
      return;
    }
    ++counters.splat_rays;
    const Connection& c = s->connection;
    const Rgb value =
        c.value * context_.scene.transmittance(c.from, c.to, c.type, crossings, c.camera);
    if (!is_black(value)) {
      out.push_back({s->raster, settings_.clamp(value / static_cast<float>(count), v.edges + 1)});
    }
  }

  void trace_directly_visible(int pass) {
    const size_t width = context_.film.rect().width();
    WalkSettings walk = settings_.walk;
    if (walk.clear_glass < 0.0f) {  // else alpha needs what is behind glass
      walk.max_edges = 1;
    }
    for_each_row([&](size_t row, Counters& counters) {
      for (size_t i = row * width; i < (row + 1) * width; ++i) {
        Sampler sampler = camera_sampler(i, pass);
        sampler.start_block(0);
        const vec2 raster = context_.film.sample_position(i, sampler.next_2d());
        Rgb sum(0.0f);
        const float alpha = trace_camera_subpath(
            context_.scene, context_.camera, raster, mis_, walk, sampler, counters,
            [&](const LightFound& found) {
              if (found.edges == 1) {
                sum += settings_.clamp(found.beta * found.hit.radiance, 1);
              }
            },
            [](const PathVertex&, Sampler&) {});
        context_.film.add_sample(i, usable(sum, counters) ? sum : Rgb(0.0f), alpha);
      }
    });
  }
};

}  // namespace

std::unique_ptr<Integrator> make_light_tracer(const RenderContext& context,
                                              const IntegratorSettings& settings) {
  return std::make_unique<LightTracer>(context, settings);
}

}  // namespace janus
