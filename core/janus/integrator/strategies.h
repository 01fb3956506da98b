// SPDX-License-Identifier: GPL-3.0-or-later
//
// The ways to make a path: strategy (s,t) has s vertices on the light's side and t on the camera's.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace janus {

struct Technique {
  int s, t;
  bool operator==(const Technique&) const = default;
  int edges() const { return s + t - 1; }
};

// A choice of strategies that render without weights: of a path's light, each of the chosen ones
// that have its length finds an equal part. So a picture has all light only if each of them can
// make all paths, which a strategy that needs a diffuse vertex, or a light with an area, can not.
class Strategies {
 public:
  // All of them.
  Strategies() : Strategies(kAny, kAny, "") {}
  // One alone.
  Strategies(Technique technique)  // NOLINT(google-explicit-constructor)
      : Strategies(technique.s, technique.t,
                   std::to_string(technique.s) + "," + std::to_string(technique.t)) {}
  // From words like "0,3 2,*", where * is any number; no words: all. Throws Error, with a message
  // for the user, for what is no strategy or none that bdpt has.
  static Strategies parse(std::string_view text);

  // Which of them a render makes at all: those with next event estimation (s=1), with connections
  // (s, t > 1), and those that splat (t=1).
  void limit(bool next_event, bool connections, bool splats) {
    next_event_ = next_event;
    connections_ = connections;
    splats_ = splats;
  }
  // Is one of them made?
  bool any() const {
    return std::ranges::any_of(patterns_, [&](const Pattern& p) {
      for (const int s : {0, 1, 2}) {  // each kind once
        for (const int t : {1, 2}) {
          if (s + t > 1 && made(p.s == kAny ? s : p.s, p.t == kAny ? t : p.t)) {
            return true;
          }
        }
      }
      return false;
    });
  }

  // The part of a path's light that strategy (s,t) finds; 0 if it was not chosen.
  float weight(int s, int t) const {
    if (!chosen(s, t)) {
      return 0.0f;
    }
    const int vertices = s + t;
    int count = 0;
    for (int i = 0; i < vertices; ++i) {
      count += chosen(i, vertices - i) ? 1 : 0;
    }
    return 1.0f / static_cast<float>(count);
  }

  // Are there none but s=0?
  bool only_hits() const {
    return std::ranges::all_of(patterns_, [](const Pattern& p) { return p.s == 0; });
  }

  // As parse() reads it.
  const std::string& text() const { return text_; }

 private:
  static constexpr int kAny = -1;
  struct Pattern {
    int s, t;
  };

  Strategies(int s, int t, std::string text) : text_(std::move(text)), patterns_{{s, t}} {}

  bool made(int s, int t) const {
    if (s == 0) {
      return t > 1;
    }
    return t == 1 ? s > 1 && splats_ : s == 1 ? next_event_ : connections_;
  }
  bool chosen(int s, int t) const {
    if (!made(s, t)) {
      return false;
    }
    for (const Pattern& p : patterns_) {
      if ((p.s == kAny || p.s == s) && (p.t == kAny || p.t == t)) {
        return true;
      }
    }
    return false;
  }

  std::string text_;
  std::vector<Pattern> patterns_;
  bool next_event_ = true, connections_ = true, splats_ = true;
};

}  // namespace janus
