// SPDX-License-Identifier: GPL-3.0-or-later
//
// HSV and HSL as Blender computes them; colours beyond [0, 1] go in and out as there.
#pragma once

#include <algorithm>
#include <cmath>

#include "janus/math/vec.h"

namespace janus {

inline vec3 rgb_to_hsv(vec3 rgb) {
  const float high = std::max({rgb.x, rgb.y, rgb.z}), low = std::min({rgb.x, rgb.y, rgb.z});
  const float delta = high - low;
  float h = 0.0f;
  const float s = high != 0.0f ? delta / high : 0.0f;
  if (s != 0.0f) {
    const vec3 c = (vec3(high) - rgb) / delta;
    h = rgb.x == high ? c.z - c.y : rgb.y == high ? 2.0f + c.x - c.z : 4.0f + c.y - c.x;
    h /= 6.0f;
    h += h < 0.0f ? 1.0f : 0.0f;
  }
  return vec3(h, s, high);
}

inline vec3 hsv_to_rgb(vec3 hsv) {
  const float s = hsv.y, v = hsv.z;
  if (s == 0.0f) {
    return vec3(v);
  }
  const float h = (hsv.x == 1.0f ? 0.0f : hsv.x) * 6.0f;
  const float i = std::floor(h), f = h - i;
  const float p = v * (1.0f - s), q = v * (1.0f - s * f), t = v * (1.0f - s * (1.0f - f));
  if (i == 0.0f) {
    return vec3(v, t, p);
  }
  if (i == 1.0f) {
    return vec3(q, v, p);
  }
  if (i == 2.0f) {
    return vec3(p, v, t);
  }
  if (i == 3.0f) {
    return vec3(p, q, v);
  }
  return i == 4.0f ? vec3(t, p, v) : vec3(v, p, q);
}

inline vec3 rgb_to_hsl(vec3 rgb) {
  const float high = std::max({rgb.x, rgb.y, rgb.z}), low = std::min({rgb.x, rgb.y, rgb.z});
  const float l = std::min(1.0f, 0.5f * (high + low)), delta = high - low;
  if (delta == 0.0f) {
    return vec3(0.0f, 0.0f, l);
  }
  const float s = l > 0.5f ? delta / (2.0f - high - low) : delta / (high + low);
  const float h = rgb.x == high   ? (rgb.y - rgb.z) / delta + (rgb.y < rgb.z ? 6.0f : 0.0f)
                  : rgb.y == high ? (rgb.z - rgb.x) / delta + 2.0f
                                  : (rgb.x - rgb.y) / delta + 4.0f;
  return vec3(h / 6.0f, s, l);
}

inline vec3 hsl_to_rgb(vec3 hsl) {
  const float h = 6.0f * hsl.x, chroma = (1.0f - std::abs(2.0f * hsl.z - 1.0f)) * hsl.y;
  const vec3 n(std::abs(h - 3.0f) - 1.0f, 2.0f - std::abs(h - 2.0f), 2.0f - std::abs(h - 4.0f));
  return (glm::clamp(n, 0.0f, 1.0f) - 0.5f) * chroma + hsl.z;
}

}  // namespace janus
