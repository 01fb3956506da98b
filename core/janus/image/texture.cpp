// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/image/texture.h"

#include <array>
#include <cmath>

namespace janus {

namespace {

// The pixel that stands for index i, or -1: nothing is there.
int place(int i, int size, Extension extension) {
  if (i >= 0 && i < size) {
    return i;
  }
  switch (extension) {
    case Extension::Repeat:
      i %= size;
      return i < 0 ? i + size : i;
    case Extension::Extend:
      return i < 0 ? 0 : size - 1;
    case Extension::Clip:
      return -1;
    case Extension::Mirror:
      i %= 2 * size;
      i = i < 0 ? i + 2 * size : i;
      return i < size ? i : 2 * size - 1 - i;
  }
  return -1;
}

// Cubic B-spline weights.
void cubic_weights(float t, float* w) {
  const float s = 1.0f - t;
  w[0] = s * s * s / 6.0f;
  w[1] = 2.0f / 3.0f - t * t * (1.0f - 0.5f * t);
  w[2] = 2.0f / 3.0f - s * s * (1.0f - 0.5f * s);
  w[3] = t * t * t / 6.0f;
}

// The sRGB decoding of IEC 61966-2-1.
float srgb_to_linear(float x) {
  if (x <= 0.04045f) {
    return x / 12.92f;
  }
  return std::pow((x + 0.055f) / 1.055f, 2.4f);
}

// The same from a table with straight lines between its entries: 2.4e-7 off at most, and powers of
// floats 2.3e-7.
class SrgbTable {
 public:
  float linear(float x) const {
    if (!(x >= 0.0f && x < 1.0f)) {
      return srgb_to_linear(x);
    }
    const float at = kSteps * x;
    const int i = static_cast<int>(at);
    return values_[i] + (at - static_cast<float>(i)) * (values_[i + 1] - values_[i]);
  }

 private:
  static constexpr int kSteps = 4096;
  std::array<float, kSteps + 1> values_ = [] {
    std::array<float, kSteps + 1> values{};
    for (int i = 0; i <= kSteps; ++i) {
      values[i] = srgb_to_linear(static_cast<float>(i) / kSteps);
    }
    return values;
  }();
};
const SrgbTable kSrgb;

}  // namespace

vec4 Texture::lookup(vec2 uv) const {
  const int width = image->width, height = image->height, channels = image->channels;
  if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) {
    return vec4(0.0f);
  }
  const auto pixel = [&](int x, int y) {
    x = place(x, width, extension);
    y = place(y, height, extension);
    if (x < 0 || y < 0) {
      return vec4(0.0f);
    }
    if (!image->blocks.empty()) {
      const auto& p = image->bytes(x, y);
      const auto& value = image->value;
      return vec4(value[p[0]], value[p[1]], value[p[2]], value[p[3]]);
    }
    const float* p = &image->pixels[(static_cast<size_t>(y) * width + x) * channels];
    return vec4(p[0], p[1], p[2], channels > 3 ? p[3] : 1.0f);
  };
  // Far out, whole numbers no longer fit; there is nothing to see there either.
  const vec2 at = glm::clamp(uv * vec2(width, height), -1e9f, 1e9f);
  vec4 c(0.0f);
  if (interpolation == Interpolation::Closest) {
    c = pixel(static_cast<int>(std::floor(at.x)), static_cast<int>(std::floor(at.y)));
  } else {
    const vec2 low = glm::floor(at - 0.5f), t = at - 0.5f - low;
    const int x = static_cast<int>(low.x), y = static_cast<int>(low.y);
    if (interpolation == Interpolation::Linear) {
      c = (1.0f - t.y) * ((1.0f - t.x) * pixel(x, y) + t.x * pixel(x + 1, y)) +
          t.y * ((1.0f - t.x) * pixel(x, y + 1) + t.x * pixel(x + 1, y + 1));
    } else {
      float u[4], v[4];
      cubic_weights(t.x, u);
      cubic_weights(t.y, v);
      for (int j = 0; j < 4; ++j) {
        for (int i = 0; i < 4; ++i) {
          c += u[i] * v[j] * pixel(x - 1 + i, y - 1 + j);
        }
      }
    }
  }
  return c;
}

void Texture::prefetch(vec2 uv) const {
  const vec2 at = uv * vec2(image->width, image->height) - 0.5f;
  if (image->blocks.empty() || !(glm::abs(at.x) < 1e9f && glm::abs(at.y) < 1e9f)) {
    return;
  }
  const int x = place(static_cast<int>(std::floor(at.x)), image->width, extension);
  const int y = place(static_cast<int>(std::floor(at.y)), image->height, extension);
  if (x >= 0 && y >= 0) {
    __builtin_prefetch(&image->bytes(x, y));
  }
}

vec4 Texture::decode(vec4 c) const {
  for (int i = 0; srgb && i < 3; ++i) {
    c[i] = kSrgb.linear(c[i]);
  }
  return c;
}

}  // namespace janus
