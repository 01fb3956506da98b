// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/image/latlong.h"

#include <algorithm>
#include <cmath>

#include "janus/math/warp.h"

namespace janus {

namespace {

constexpr double kPi2 = 6.283185307179586;

int wrap(int i, int size) {
  i %= size;
  return i < 0 ? i + size : i;
}

}  // namespace

vec2 direction_to_latlong(vec3 d) {
  const double x = d.x, y = d.y, z = d.z;
  const double u = 0.5 - std::atan2(y, x) / kPi2;
  const double v = 0.5 + std::atan2(z, std::sqrt(x * x + y * y)) / (0.5 * kPi2);
  return vec2(static_cast<float>(u), static_cast<float>(v));
}

vec3 latlong_to_direction(double u, double z) {
  const double azimuth = kPi2 * (0.5 - u), r = std::sqrt(std::max(0.0, (1.0 - z) * (1.0 + z)));
  return vec3(r * std::cos(azimuth), r * std::sin(azimuth), z);
}

double latlong_z(double v) { return -std::cos(0.5 * kPi2 * v); }

float srgb_to_linear(float x) {
  if (x <= 0.04045f) {
    return x / 12.92f;
  }
  return static_cast<float>(std::pow((static_cast<double>(x) + 0.055) / 1.055, 2.4));
}

Rgb lookup(const Image& image, vec2 uv, Interpolation interpolation, bool srgb) {
  const auto pixel = [&](int x, int y) {
    const size_t i =
        static_cast<size_t>(wrap(y, image.height)) * image.width + wrap(x, image.width);
    const float* p = &image.pixels[i * image.channels];
    return Rgb(p[0], p[1], p[2]);
  };
  const vec2 at = uv * vec2(image.width, image.height);
  Rgb c;
  if (interpolation == Interpolation::Closest) {
    c = pixel(static_cast<int>(std::floor(at.x)), static_cast<int>(std::floor(at.y)));
  } else {
    const vec2 low = glm::floor(at - 0.5f), t = at - 0.5f - low;
    const int x = static_cast<int>(low.x), y = static_cast<int>(low.y);
    c = (1.0f - t.y) * ((1.0f - t.x) * pixel(x, y) + t.x * pixel(x + 1, y)) +
        t.y * ((1.0f - t.x) * pixel(x, y + 1) + t.x * pixel(x + 1, y + 1));
  }
  return srgb ? Rgb(srgb_to_linear(c.x), srgb_to_linear(c.y), srgb_to_linear(c.z)) : c;
}

}  // namespace janus
