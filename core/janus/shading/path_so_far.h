// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a path says of itself, between the camera and a point that it comes to (the node Light
// Path). Light subpaths do not know it: what asks for it is for the camera's side to evaluate.
#pragma once

#include <cstdint>

#include "janus/scene/ray_type.h"

namespace janus {

// Bounces of a part of a path by label.
struct BounceCounts {
  uint16_t of[3] = {};

  BounceCounts with(RayType label) const {
    BounceCounts more = *this;
    ++more.of[static_cast<int>(label)];
    return more;
  }
  BounceCounts operator+(const BounceCounts& o) const {
    BounceCounts sum;
    for (int i = 0; i < 3; ++i) {
      sum.of[i] = static_cast<uint16_t>(of[i] + o.of[i]);
    }
    return sum;
  }
};

// As in Cycles, the ray between a light and the vertex that looks for it is past that vertex, but
// its label does not count yet; to worlds it does. What is met otherwise, and seen in a mirror, is
// past the vertex by all counts. Which it is belongs to the path, not to the technique: light that
// only chance finds, and light behind a delta, is not looked for.
struct PathSoFar {
  float ray_length = 0.0f;          // metres from the last vertex, or the camera; maybe infinite
  uint16_t depth = 0;               // vertices
  BounceCounts bounces;             // of these, by label
  uint16_t crossings = 0;           // of transparent surfaces
  bool looks = false;               // for a light
  RayType last = RayType::Diffuse;  // if it looks: the label that `bounces` leaves out

  BounceCounts all_bounces() const { return looks ? bounces.with(last) : bounces; }

  // Further along the same ray.
  PathSoFar after(int more_crossings, float length) const {
    PathSoFar result = *this;
    result.crossings = static_cast<uint16_t>(crossings + more_crossings);
    result.ray_length = length;
    return result;
  }
  // The same ray, from a vertex with `label`, as it looks for a light.
  PathSoFar looking(RayType label) const {
    PathSoFar result = *this;
    --result.bounces.of[static_cast<int>(label)];
    result.looks = true;
    result.last = label;
    return result;
  }
};

// For guesses of how bright something is which depends on the path: one that asks at the first,
// second ... surface.
inline constexpr int kUsualPaths = 4;
inline PathSoFar usual_path(int i, float ray_length) {
  PathSoFar path;
  path.ray_length = ray_length;
  path.depth = path.bounces.of[0] = static_cast<uint16_t>(i);
  return path;
}

}  // namespace janus
