// SPDX-License-Identifier: GPL-3.0-or-later
//
// How paths are sorted by light path expressions. A vertex that scatters in two kinds at once, say
// by a diffuse and by a glossy lobe, makes two paths of one, each with its share of the value by
// channel: f_l / f. So a subpath is in several states of the automaton, each with a share, which
// together are the whole.
#pragma once

#include <algorithm>
#include <span>

#include "janus/path/automaton.h"
#include "janus/sampling/sampler.h"

namespace janus {

// A vertex that neither side of the automaton has read yet.
struct UnreadVertex {
  uint32_t instance;
  ScatterShares shares;
};

struct WeightedState {
  PathAutomaton::State state;
  Rgb share;
};

// The states of a subpath.
class PathStates {
 public:
  PathStates() {}  // not `= default`, which would have the array set to zero
  explicit PathStates(PathAutomaton::State state) { add(state, Rgb(1.0f)); }

  std::span<const WeightedState> all() const { return {states_, static_cast<size_t>(count_)}; }

  // Those that `before` turn into after `vertex`, read by `next(state, event, instance)`.
  // `sampler`: for subpaths in more states than there is room for, of which one is then dropped by
  // chance in favour of another.
  template <class Next>
  void read(const PathStates& before, const UnreadVertex& vertex, Next&& next, Sampler& sampler) {
    count_ = 0;
    vertex.shares.for_each([&](int event, Rgb share) {
      for (const WeightedState& s : before.all()) {
        add(next(s.state, event, vertex.instance), s.share * share, sampler);
      }
    });
  }

 private:
  static constexpr int kMost = 6;

  // True if the state was there, or there was room.
  bool add(PathAutomaton::State state, Rgb share) {
    if (state == PathAutomaton::kDead || is_black(share)) {
      return true;
    }
    for (int i = 0; i < count_; ++i) {
      if (states_[i].state == state) {
        states_[i].share += share;
        return true;
      }
    }
    if (count_ == kMost) {
      return false;
    }
    states_[count_++] = {state, share};
    return true;
  }
  void add(PathAutomaton::State state, Rgb share, Sampler& sampler) {
    if (add(state, share)) {
      return;
    }
    WeightedState& rival = *std::ranges::min_element(
        states_, {}, [](const auto& s) { return max_component(s.share); });
    const float own = max_component(share), others = max_component(rival.share);
    const float pmf = own / (own + others);
    if (sampler.next_1d() < pmf) {
      rival = {state, share / pmf};
    } else {
      rival.share /= 1.0f - pmf;
    }
  }

  WeightedState states_[kMost];  // not initialised beyond the count
  int count_ = 0;
};

// What has been read of a subpath.
class PathTrace {
 public:
  explicit PathTrace(PathAutomaton::State start) : read_{PathStates(start), PathStates()} {}

  // Of all vertices so far; of all but the last one; and that.
  std::span<const WeightedState> states() const { return read_[now_].all(); }
  std::span<const WeightedState> before() const { return read_[1 - now_].all(); }
  const UnreadVertex& vertex() const { return vertex_; }

  // The subpath goes on from `at`, its vertex number `edges`, of whose shares `read` count for what
  // comes next. Numbers are drawn apart: the picture does not depend on who looks at it.
  template <class Next>
  void go_on(const UnreadVertex& at, const ScatterShares& read, int edges, Next&& next,
             Sampler sampler) {
    constexpr uint32_t kBlock = 1 << 20;  // far beyond those of vertices
    sampler.start_block(kBlock + static_cast<uint32_t>(edges));
    vertex_ = at;
    const PathStates& before = read_[now_];
    now_ = 1 - now_;
    read_[now_].read(before, {at.instance, read}, next, sampler);
  }

 private:
  PathStates read_[2];  // taking turns, because copies cost
  int now_ = 0;
  UnreadVertex vertex_;
};

// The vertices of a finished path that neither side has read, from the light to the camera.
struct UnreadVertices {
  UnreadVertex vertices[2];  // not initialised beyond the count
  int count = 0;

  UnreadVertices() {}
  explicit UnreadVertices(const UnreadVertex& one) { set(one); }
  void set(const UnreadVertex& one) {
    vertices[0] = one;
    count = 1;
  }
  void set(const UnreadVertex& one, const UnreadVertex& other) {
    vertices[0] = one;
    vertices[1] = other;
    count = 2;
  }
};

// A finished path for the automaton.
struct SortedPath {
  std::span<const WeightedState> light, camera;  // what both sides have read
  UnreadVertices unread;
  bool caught = false;  // it belongs to a shadow catcher
};

// Calls f(expressions, share) for the parts of a path that belong to expressions.
template <class F>
void for_each_match(const PathAutomaton& automaton, const SortedPath& path, F&& f) {
  const UnreadVertex* unread = path.unread.vertices;
  for (const WeightedState& light : path.light) {
    for (const WeightedState& camera : path.camera) {
      // Most ends match nothing: shares are multiplied late.
      const auto report = [&](PathAutomaton::State read, Rgb part) {
        if (const ExpressionMask expressions = automaton.completed(read, camera.state)) {
          f(expressions, light.share * camera.share * part);
        }
      };
      if (path.unread.count == 0) {
        report(light.state, Rgb(1.0f));
        continue;
      }
      unread[0].shares.for_each([&](int event, Rgb part) {
        const auto read = automaton.forward(light.state, event, unread[0].instance);
        if (path.unread.count == 1) {
          report(read, part);
          return;
        }
        unread[1].shares.for_each([&](int second, Rgb second_part) {
          report(automaton.forward(read, second, unread[1].instance), part * second_part);
        });
      });
    }
  }
}

}  // namespace janus
