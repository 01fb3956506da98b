// SPDX-License-Identifier: GPL-3.0-or-later
//
// Vertex merging in bdpt (Georgiev et al. 2012): which radius a pass has, and what a camera vertex
// gathers.
#pragma once

#include <numbers>

#include "janus/integrator/clamp.h"
#include "janus/integrator/vertex_grid.h"

namespace janus {

class Merging {
 public:
  // `radius`: of the first pass, scene units; 0: nothing is ever merged.
  explicit Merging(float radius) : first_radius_(radius), radius_(radius) {}

  bool used() const { return first_radius_ > 0.0f; }

  // The square of the radius shrinks as pass^(alpha - 1), with the paper's alpha.
  void begin_pass(int pass) {
    constexpr float kAlpha = 0.75f;
    radius_ = first_radius_ * std::pow(pass + 1.0f, 0.5f * (kAlpha - 1.0f));
  }
  // SampleCounts::merge where the vertices of so many light paths are at hand.
  float count(float light_paths) const { return area() * light_paths; }

  // Takes in the vertices of `light_paths` light paths.
  void build(const VertexCache& cache, size_t light_paths) {
    grid_.build(cache, radius_);
    scale_ = 1.0f / (area() * static_cast<float>(light_paths));
  }

  Rgb gather(const PathVertex& v, const Mis& mis, const PathRules& rules, const Clamp& clamp,
             Counters& counters) const {
    Rgb sum(0.0f);
    grid_.for_each_near(v.hit.p, [&](const LightVertex& l) {
      if (const auto merged = merge_vertices(l, v, mis, rules, scale_)) {
        ++counters.merges;
        sum += clamp(merged->value * merged->weight.value, l.edges + v.edges);
      }
    });
    return sum;
  }

 private:
  float area() const { return std::numbers::pi_v<float> * radius_ * radius_; }

  float first_radius_, radius_;
  float scale_ = 0.0f;
  VertexGrid grid_;
};

}  // namespace janus
