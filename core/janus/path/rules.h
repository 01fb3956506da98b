// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which paths count. The rules are functions of the finished, labelled path, the same for every
// technique (s,t); a technique may look at a part of the path early, to give up on what can never
// be completed.
#pragma once

#include <algorithm>

#include "janus/path/label.h"

namespace janus {

// Cycles' limits of bounces by label. Of the scattering vertices z_1 ... z_{k-1}, all but z_1,
// which the light shines on, are bounces: a limit of 0 leaves direct light.
class BounceCaps {
 public:
  BounceCaps() : BounceCaps(1024, 1024, 1024) {}
  BounceCaps(int diffuse, int glossy, int transmission)
      : caps_{diffuse, glossy, transmission}, least_(std::min({diffuse, glossy, transmission})) {}

  int least() const { return least_; }
  int operator[](int label) const { return caps_[label]; }
  bool allow(const BounceCounts& counts) const {
    return counts.of[0] <= caps_[0] && counts.of[1] <= caps_[1] && counts.of[2] <= caps_[2];
  }
  // The share of a path with `counts` and a vertex more that is allowed.
  float share(const BounceCounts& counts, const LabelShares& vertex) const {
    float sum = 0.0f;
    for (int i = 0; i < 3; ++i) {
      const auto label = static_cast<RayType>(i);
      sum += vertex.of[i] > 0.0f && allow(counts.with(label)) ? vertex.of[i] : 0.0f;
    }
    return sum;
  }
  // And with two vertices more.
  float share(const BounceCounts& counts, const LabelShares& a, const LabelShares& b) const {
    float sum = 0.0f;
    for (int i = 0; i < 3; ++i) {
      if (a.of[i] > 0.0f) {
        sum += a.of[i] * share(counts.with(static_cast<RayType>(i)), b);
      }
    }
    return sum;
  }

 private:
  int caps_[3];  // by RayType
  int least_;
};

class PathAutomaton;

struct PathRules {
  int max_edges = 14;     // edges of a whole path; Cycles' max_bounces + 2
  int max_crossings = 8;  // of transparent surfaces on a whole path
  BounceCaps caps;
  // Of clear views (path/clear_view.h): are there surfaces that hold out; is the background left
  // out; and lobes of glass up to which squared GGX width are clear. Below 0: none is.
  bool holdouts = false, film_transparent = false;
  float clear_glass = -1.0f;
  bool catchers = false;   // are there shadow catchers that the camera may see (path/catching.h)
  bool ray_types = false;  // Scene::has_ray_types: what is met depends on the labels
  bool by_path = false;    // Scene::has_by_path: what it does, on the path that leads there
  // The light path expressions that paths are sorted by; null: none.
  const PathAutomaton* expressions = nullptr;

  // Can a limit by label forbid a path of so many edges?
  bool caps_bind(int edges) const { return edges - 2 > caps.least(); }
  // Or any path at all? If not, nobody needs to count.
  bool counts() const { return caps_bind(max_edges); }
  // Do vertices depend on whether the view to them is clear?
  bool clear_views() const { return holdouts || clear_glass >= 0.0f; }
  // Must walks know their labels?
  bool labels() const { return ray_types || by_path || counts(); }
};

}  // namespace janus
