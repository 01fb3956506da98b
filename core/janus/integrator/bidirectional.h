// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the bidirectional integrators share: what a join adds to the picture and to its layers. How
// they find joins is their own business.
#pragma once

#include "janus/integrator/pass.h"
#include "janus/integrator/roulette_map.h"
#include "janus/integrator/splats.h"
#include "janus/integrator/vertex_cache.h"

namespace janus {

class BidirectionalIntegrator : public PassIntegrator {
 public:
  BidirectionalIntegrator(const RenderContext& context, const IntegratorSettings& settings)
      : PassIntegrator(context, settings), mis_(settings.heuristic, counts_) {
    counts_.nee = settings.next_event ? 1.0f : 0.0f;
    renew_weights();
  }

 protected:
  // A pixel's sample in the making.
  struct Sample {
    size_t index;
    Rgb sum = Rgb(0.0f);
  };

  void renew_weights() { mis_ = Mis(settings_.heuristic, counts_); }

  float weight(const MisWeight& weight, Technique technique) const {
    return settings_.strategies ? settings_.strategies->weight(technique.s, technique.t)
                                : weight.value;
  }

  // Nothing is splatted yet; so many blocks will be.
  void start_splats(size_t blocks) {
    splats_.start(blocks);
    if (context_.transport) {
      context_.transport->start_splats(blocks);
    }
  }

  // What arrives of a connection's weighted `value` over its shadow ray, which completes a path of
  // `edges` edges; `samples` and `rays` are counted.
  Rgb arriving(Rgb value, const Connection& c, int edges, const Roulette& roulette,
               Sampler& sampler, uint64_t& samples, uint64_t& rays) const {
    if (is_black(value)) {
      return value;
    }
    ++samples;
    float scale = c.made_up;
    const int crossings = settings_.walk.max_crossings - c.crossings;
    if (crossings < 0 || !roulette.survives(scale * max_component(value), sampler, scale)) {
      return Rgb(0.0f);
    }
    ++rays;
    const Rgb arrived = value * c.transmittance(context_.scene(), crossings);
    return settings_.clamp(arrived, edges) * scale;
  }

  // Adds `value`, to which `weight` has been applied, to the sample. path() is called for layers.
  // `source`: the projector's pixel in which the path starts.
  template <class Path>
  void gather(Rgb value, float weight, Technique technique, uint32_t source, Sample& sample,
              Counters& counters, Path&& path) {
    if (!usable(value, counters)) {
      return;
    }
    sample.sum += value;
    if (context_.transport) {
      context_.transport->add(sample.index, source, value);
    }
    if (settings_.layers.any()) {
      add_to_layers(value, weight, technique, path(), sample.index);
    }
  }

  // Out of the way of renders without layers.
  [[gnu::noinline]] void add_to_layers(Rgb value, float weight, Technique technique,
                                       const SortedPath& path, size_t index) {
    const std::span<Rgb> layers = context_.film.layers_at(index);
    settings_.layers.spread(value, weight, technique, settings_.walk.expressions, path,
                            [&](LayerMask mask, Rgb part) {
                              mask.for_each([&](size_t layer) { layers[layer] += part; });
                            });
  }

  // s=0. `share`: of what is found over deltas alone.
  Rgb gather_light(const LightFound& found, float share, Sample& sample, Counters& counters) {
    const Technique technique{0, found.edges + 1};
    const float w = weight(found.weight, technique);
    const Rgb value = settings_.clamp(found.beta * found.hit.radiance * w, found.edges) * share;
    WeightedState light;
    gather(value, w, technique, 0, sample, counters, [&] {
      light = light_state(found.light);
      return path_of_light(found, light);
    });
    return value;
  }

  // s=1. Returns what was added, and sets `found`.
  Rgb gather_next_event(const PathVertex& v, const Roulette& roulette, Sampler& sampler,
                        Sample& sample, Counters& counters, MisWeight& found) {
    if (!settings_.next_event || !context_.scene().light_sampler.illuminates()) {
      return Rgb(0.0f);
    }
    UnreadVertices unread;
    const auto nee =
        connect_to_light(context_.scene(), v, mis_, settings_.walk, sampler, reads(unread));
    if (!nee) {
      return Rgb(0.0f);
    }
    const Connection& c = nee->connection;
    const Technique technique{1, v.edges + 1};
    const float w = weight(c.weight, technique);
    const Rgb value = arriving(c.value * w, c, v.edges + 1, roulette, sampler, counters.nee_samples,
                               counters.nee_rays);
    WeightedState light;
    const uint32_t source =
        context_.transport ? context_.scene().lights[nee->light]->pixel(v.hit.p) : 0;
    gather(value, w, technique, source, sample, counters, [&] {
      light = light_state(nee->light);
      return SortedPath{{&light, 1}, states(v.trace), unread, v.caught};
    });
    found = c.weight;
    return value;
  }

  // s, t >= 2: joins with one vertex of a light subpath, where `scale` is the estimator's factor.
  Rgb gather_connection(const LightVertex& l, const CacheBlock& block, const PathVertex& v,
                        float scale, const Roulette& roulette, Sampler& sampler, Sample& sample,
                        Counters& counters, MisWeight& found) {
    ++counters.connections;
    const int edges = l.edges + v.edges + 1;
    if (edges > l.max_edges) {
      return Rgb(0.0f);
    }
    const BsdfView light_bsdf = block.bsdf(l);
    __builtin_prefetch(light_bsdf.lobes().data());
    if (settings_.walk.expressions) {
      __builtin_prefetch(block.states_of(l).data());
    }
    UnreadVertices unread;
    const auto c = connect_vertices(context_.scene(), l, light_bsdf, v, mis_, settings_.walk, scale,
                                    roulette, sampler, counters, reads(unread));
    if (!c) {
      return Rgb(0.0f);
    }
    uint64_t with_value = 0;
    const Technique technique{l.edges + 1, v.edges + 1};
    const float w = weight(c->weight, technique);
    const Rgb value =
        arriving(c->value * w, *c, edges, roulette, sampler, with_value, counters.connection_rays);
    gather(value, w, technique, l.pixel, sample, counters,
           [&] { return SortedPath{block.states_of(l), states(v.trace), unread, v.caught}; });
    found = c->weight;
    return value;
  }

  // t=1, for one of `light_paths` light paths, those of a block by one thread. Calls
  // on_splat(raster, value, weight).
  template <class OnSplat>
  void splat(const PathVertex& v, float light_paths, const RouletteMap& roulettes, float margin,
             Sampler& sampler, size_t block, Counters& counters, OnSplat&& on_splat) {
    UnreadVertices unread;
    const auto s = connect_to_camera(v, context_.camera(), sampler.next_2d(), margin, mis_,
                                     settings_.walk, reads(unread));
    if (!s) {
      return;
    }
    const Connection& c = s->connection;
    const Technique technique{v.edges + 1, 1};
    const float w = weight(c.weight, technique);
    Rgb value = arriving(c.value * w / light_paths, c, v.edges + 1, roulettes.at(s->raster),
                         sampler, counters.splats, counters.splat_rays);
    if (!usable(value, counters)) {
      return;
    }
    const bool caught = settings_.walk.catchers && catch_segment(context_.scene(), c.from, c.to,
                                                                 v.caught, settings_.walk, value);
    if (is_black(value)) {
      return;
    }
    if (context_.transport) {
      context_.transport->add_splat(block, s->raster, v.pixel, value);
    }
    if (settings_.layers.any()) {
      splats_.add(block, s->raster, value, [&](auto&& add) {
        const SortedPath path{states(v.trace), camera_state(), unread, caught};
        settings_.layers.spread(value, w, technique, settings_.walk.expressions, path, add);
      });
    } else {
      splats_.add(block, s->raster, value);
    }
    on_splat(s->raster, value, c.weight);
  }

  SampleCounts counts_;
  Mis mis_;
  Splats splats_;
};

}  // namespace janus
