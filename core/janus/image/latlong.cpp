// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/image/latlong.h"

#include <algorithm>
#include <cmath>

#include "janus/math/warp.h"

namespace janus {

namespace {

constexpr double kPi2 = 6.283185307179586;

}  // namespace

vec2 direction_to_latlong(vec3 d) {
  const double x = d.x, y = d.y, z = d.z;
  const double u = 0.5 - std::atan2(y, x) / kPi2;
  const double v = 0.5 + std::atan2(z, std::sqrt(x * x + y * y)) / (0.5 * kPi2);
  return vec2(static_cast<float>(u), static_cast<float>(v));
}

vec2 direction_to_sphere(vec3 d) {
  const float length = glm::length(d);
  vec2 uv(0.0f);
  if (length > 0.0f) {
    uv.x = d.x == 0.0f && d.y == 0.0f ? 0.0f : 0.5f * (1.0f - std::atan2(d.x, d.y) * kInvPi);
    uv.y = 1.0f - std::acos(std::clamp(d.z / length, -1.0f, 1.0f)) * kInvPi;
  }
  return uv;
}

vec3 latlong_to_direction(double u, double z) {
  const double azimuth = kPi2 * (0.5 - u), r = std::sqrt(std::max(0.0, (1.0 - z) * (1.0 + z)));
  return vec3(r * std::cos(azimuth), r * std::sin(azimuth), z);
}

double latlong_z(double v) { return -std::cos(0.5 * kPi2 * v); }

}  // namespace janus
