// SPDX-License-Identifier: GPL-3.0-or-later
//
// Random numbers in [0, 1] for points, by the bits of their coordinates: Cycles' numbers.
#pragma once

#include "janus/math/hash.h"
#include "janus/math/vec.h"

namespace janus {

// In one to four dimensions.
template <int D>
using Coordinates = glm::vec<D, float>;

inline float white_number(Coordinates<1> p) { return jenkins_number(p.x); }
inline float white_number(vec2 p) { return jenkins_number(p.x, p.y); }
inline float white_number(vec3 p) { return jenkins_number(p.x, p.y, p.z); }
inline float white_number(vec4 p) { return jenkins_number(p.x, p.y, p.z, p.w); }

// Green and blue have one number more, but for four dimensions: these are turned.
inline vec3 white_color(Coordinates<1> p) {
  return vec3(white_number(p), jenkins_number(p.x, 1.0f), jenkins_number(p.x, 2.0f));
}
inline vec3 white_color(vec2 p) {
  return vec3(white_number(p), jenkins_number(p.x, p.y, 1.0f), jenkins_number(p.x, p.y, 2.0f));
}
inline vec3 white_color(vec3 p) {
  return vec3(white_number(p), jenkins_number(p.x, p.y, p.z, 1.0f),
              jenkins_number(p.x, p.y, p.z, 2.0f));
}
inline vec3 white_color(vec4 p) {
  return vec3(white_number(p), jenkins_number(p.z, p.x, p.w, p.y),
              jenkins_number(p.w, p.z, p.y, p.x));
}

// As many numbers as there are dimensions.
inline Coordinates<1> white_point(Coordinates<1> p) { return Coordinates<1>(white_number(p)); }
inline vec2 white_point(vec2 p) { return vec2(white_color(p)); }
inline vec3 white_point(vec3 p) { return white_color(p); }
inline vec4 white_point(vec4 p) {
  return vec4(white_number(p), jenkins_number(p.w, p.x, p.y, p.z),
              jenkins_number(p.z, p.w, p.x, p.y), jenkins_number(p.y, p.z, p.w, p.x));
}

}  // namespace janus
