// SPDX-License-Identifier: GPL-3.0-or-later
//
// Light path expressions in the path tracer, which does without the walks of path/. Kept out of its
// way: nothing here is in line.
#pragma once

#include <span>

#include "janus/film/film.h"
#include "janus/path/match.h"
#include "janus/path/rules.h"

namespace janus {

class CameraTrace {
 public:
  // Of a walk from the camera; its light goes to the `layers` of its pixel.
  CameraTrace(const Scene& scene, const PathRules& rules, std::span<Rgb> layers)
      : scene_(scene), rules_(rules), layers_(layers), trace_(rules.expressions->from_camera()) {}

  // The walk goes on from `vertex`, whose event has got `label`.
  [[gnu::noinline]] void read(const UnreadVertex& vertex, RayType label, int edges,
                              const Sampler& sampler) {
    trace_.go_on(
        vertex, rules_.ray_types ? vertex.shares.labelled(label) : vertex.shares, edges,
        [&](PathAutomaton::State state, int event, uint32_t instance) {
          return rules_.expressions->reverse(state, event, instance);
        },
        sampler);
  }

  // The walk has found light of source `light`, on a path with so many edges.
  [[gnu::noinline]] void found(size_t light, Rgb value, int edges) {
    if (edges == 1) {
      add(light, value, trace_.states(), {});
    } else {
      add(light, value, trace_.before(), lit(trace_.vertex(), light));
    }
  }

  // Light of source `light` was looked for at `vertex`, where the walk is.
  [[gnu::noinline]] void joined(size_t light, Rgb value, const UnreadVertex& vertex) {
    add(light, value, trace_.states(), lit(vertex, light));
  }

 private:
  UnreadVertices lit(UnreadVertex vertex, size_t light) const {
    if (rules_.ray_types) {
      vertex.shares = vertex.shares.lit(scene_.lights[light]->visibility);
    }
    return UnreadVertices(vertex);
  }

  void add(size_t light, Rgb value, std::span<const WeightedState> camera,
           const UnreadVertices& unread) {
    if (!is_finite(value)) {
      return;
    }
    const WeightedState start{rules_.expressions->from_light(light), Rgb(1.0f)};
    for_each_match(
        *rules_.expressions, {{&start, 1}, camera, unread}, [&](ExpressionMask which, Rgb share) {
          LayerMask{which}.for_each([&](size_t layer) { layers_[layer] += value * share; });
        });
  }

  const Scene& scene_;
  const PathRules& rules_;
  std::span<Rgb> layers_;
  PathTrace trace_;
};

}  // namespace janus
