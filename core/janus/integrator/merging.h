// SPDX-License-Identifier: GPL-3.0-or-later
//
// Vertex merging in bdpt (Georgiev et al. 2012): which radius a pass has, and what a camera vertex
// gathers.
#pragma once

#include <numbers>

#include "janus/integrator/vertex_grid.h"

namespace janus {

class Merging {
 public:
  // `radius`: of the first pass, scene units; 0: nothing is ever merged.
  Merging(float radius, const Bounds& scene) : first_radius_(radius) {
    const vec3 farthest = glm::max(glm::abs(scene.lower), glm::abs(scene.upper));
    least_ = kResolution * std::max({farthest.x, farthest.y, farthest.z});
    most_ = std::max(2.0f * scene.radius(), least_);
  }

  bool used() const { return first_radius_ > 0.0f; }

  // The square of the radius shrinks as pass^(alpha - 1), with the paper's alpha.
  void begin_pass(int pass) {
    constexpr float kAlpha = 0.75f;
    const float radius = first_radius_ * std::pow(pass + 1.0f, 0.5f * (kAlpha - 1.0f));
    radius_ = std::clamp(radius, least_, most_);
  }
  // SampleCounts::merge where the vertices of so many light paths are at hand.
  float count(float light_paths) const { return area() * light_paths; }

  // Takes in the vertices of `light_paths` light paths.
  void build(const VertexCache& cache, size_t light_paths) {
    grid_.build(cache, radius_);
    scale_ = 1.0f / (area() * static_cast<float>(light_paths));
  }

  // Calls on_merge(light vertex, its block, Merge, UnreadVertices) for all that `v` is merged with.
  template <class OnMerge>
  void gather(const PathVertex& v, const Mis& mis, const PathRules& rules, Counters& counters,
              OnMerge&& on_merge) const {
    grid_.for_each_near(v.hit.p, [&](const LightVertex& l, const CacheBlock& block) {
      UnreadVertices unread;
      if (const auto merged =
              merge_vertices(l, v, mis, rules, scale_, rules.expressions ? &unread : nullptr)) {
        ++counters.merges;
        on_merge(l, block, *merged, unread);
      }
    });
  }

 private:
  // Of coordinates: nearer vertices are at one place, as far as positions can tell.
  static constexpr float kResolution = 1e-6f;

  float area() const { return std::numbers::pi_v<float> * radius_ * radius_; }

  float first_radius_, least_, most_;
  float radius_ = 0.0f, scale_ = 0.0f;  // of the pass
  VertexGrid grid_;
};

}  // namespace janus
