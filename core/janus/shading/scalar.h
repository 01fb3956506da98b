// SPDX-License-Identifier: GPL-3.0-or-later
//
// Functions of numbers as Blender defines them, where the standard library's would not be finite.
#pragma once

#include <algorithm>
#include <cmath>

namespace janus {

// The second where one is no number, as in Cycles' vectors.
inline float lower(float a, float b) { return a < b ? a : b; }
inline float upper(float a, float b) { return a > b ? a : b; }

// What is no number becomes the lower limit, as in Cycles.
inline float limited(float x, float low, float high) { return x > low ? std::min(x, high) : low; }
inline float clamp01(float x) { return limited(x, 0.0f, 1.0f); }

inline float safe_divide(float a, float b) { return b != 0.0f ? a / b : 0.0f; }

// Negative bases have whole powers only.
inline float safe_power(float a, float b) {
  if (a < 0.0f && b != std::trunc(b)) {
    return 0.0f;
  }
  const float x = std::pow(a, b);
  return std::isfinite(x) ? x : 0.0f;
}

inline float safe_logarithm(float a, float base) {
  return a > 0.0f && base > 0.0f ? safe_divide(std::log(a), std::log(base)) : 0.0f;
}

inline float safe_modulo(float a, float b) { return b != 0.0f ? std::fmod(a, b) : 0.0f; }

inline float safe_floored_modulo(float a, float b) {
  return b != 0.0f ? a - std::floor(a / b) * b : 0.0f;
}

inline float wrap(float x, float high, float low) {
  const float range = high - low;
  return range != 0.0f ? x - range * std::floor((x - low) / range) : low;
}

inline float ping_pong(float a, float b) {
  if (b == 0.0f) {
    return 0.0f;
  }
  const float x = (a - b) / (2.0f * b);
  return std::abs((x - std::floor(x)) * 2.0f * b - b);
}

// From 0 at a to 1 at b, without slope there.
inline float smoothstep(float x, float a, float b) {
  const float t = a == b ? 0.0f : std::clamp((x - a) / (b - a), 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

// The polynomial smooth minimum (I. Quilez), cubic.
inline float smooth_minimum(float a, float b, float c) {
  if (c == 0.0f) {
    return std::min(a, b);
  }
  const float h = std::max(c - std::abs(a - b), 0.0f) / c;
  return std::min(a, b) - h * h * h * c * (1.0f / 6.0f);
}

}  // namespace janus
