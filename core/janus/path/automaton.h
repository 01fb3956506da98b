// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which light path expressions a path belongs to. All expressions together are one automaton that
// is run in two directions: forward on light subpaths, which begin with L, and in reverse on camera
// subpaths, which begin with E. A join looks up which expressions a state of the one and a state of
// the other complete. So a path belongs to the same ones whichever technique found it.
//
// Both directions are made deterministic here: a state of a light subpath stands for the symbols
// that it may have read last, a state of a camera subpath for those behind which the rest of its
// path may follow. They meet if they have a symbol in common.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "janus/path/expression.h"
#include "janus/render/scene.h"

namespace janus {

// A set of expressions, by their number.
using ExpressionMask = uint64_t;

class PathAutomaton {
 public:
  static constexpr size_t kMostExpressions = 64;
  // A state of either direction. Dead: no expression can be completed.
  using State = uint16_t;
  static constexpr State kDead = 0;

  // Throws Error if the expressions, which are at most 64, make too many states.
  PathAutomaton(std::span<const Expression> expressions, const Scene& scene);

  // Before the first event: of a light subpath from light `index` of the scene, and of a camera
  // subpath.
  State from_light(size_t index) const { return light_start_[index]; }
  State from_camera() const { return camera_start_; }

  // After `event` (scatter_event()) at an instance.
  State forward(State state, int event, uint32_t instance) const {
    return forward_[state * symbols_ + symbol(event, instance)];
  }
  State reverse(State state, int event, uint32_t instance) const {
    return reverse_[state * symbols_ + symbol(event, instance)];
  }

  // What a path belongs to of which all events have been read by one side or the other.
  ExpressionMask completed(State light, State camera) const {
    return completed_[light * camera_states_ + camera];
  }

  // Names in the expressions that nothing in the scene has.
  const std::vector<std::string>& unknown_names() const { return unknown_names_; }

 private:
  size_t symbol(int event, uint32_t instance) const {
    return object_class_[instance] * size_t{kScatterEvents} + static_cast<size_t>(event);
  }

  std::vector<uint16_t> object_class_;  // by instance: equal for those with the same names
  size_t symbols_ = 0, camera_states_ = 0;
  std::vector<State> light_start_;  // by light
  State camera_start_ = kDead;
  std::vector<State> forward_, reverse_;  // by state and symbol
  std::vector<ExpressionMask> completed_;
  std::vector<std::string> unknown_names_;
};

}  // namespace janus
