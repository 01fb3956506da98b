// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/shading/microfacet.h"

namespace janus {

namespace {

constexpr float kInvSqrtPi = 0.5641895835f;

// Up to `x`, the slopes that a direction with the tangent `tangent` sees, times 2.
float visible_below(float x, float tangent) {
  return 1.0f + std::erf(x) + tangent * kInvSqrtPi * std::exp(-x * x);
}

// Where that is the part `u` of all, by Newton's method between bounds.
float inverse_visible(float u, float tangent) {
  constexpr float kFar = 4.0f;  // 1.5e-8 of the slopes are beyond
  float low = -kFar, high = std::min(kFar, tangent > 0.0f ? 1.0f / tangent : kFar);
  const float wanted = u * visible_below(high, tangent);
  float x = std::clamp(u < 0.5f ? -0.5f : 0.5f, low, high);
  for (int i = 0; i < 24; ++i) {
    const float off = visible_below(x, tangent) - wanted;
    if (std::abs(off) < 1e-6f) {
      break;
    }
    (off > 0.0f ? high : low) = x;
    const float slope = 2.0f * kInvSqrtPi * std::exp(-x * x) * (1.0f - x * tangent);
    const float next = x - off / slope;
    x = next > low && next < high ? next : 0.5f * (low + high);
  }
  return x;
}

}  // namespace

float beckmann_lambda(float x) {
  if (x < 0.39f) {  // a >= 1.6
    return 0.0f;
  }
  const float a = 1.0f / std::sqrt(x);
  return (1.0f - 1.259f * a + 0.396f * a * a) / (3.535f * a + 2.181f * a * a);
}

float exact_beckmann_lambda(float x) {
  if (!(x > 0.0f)) {
    return 0.0f;
  }
  const float a = 1.0f / std::sqrt(x);
  return 0.5f * (kInvSqrtPi * std::exp(-a * a) / a - std::erfc(a));
}

vec2 visible_beckmann_slopes(float cos, vec2 u) {
  const float tangent = std::sqrt(std::max(0.0f, 1.0f - cos * cos)) / cos;
  return {inverse_visible(u.x, tangent), inverse_visible(u.y, 0.0f)};
}

}  // namespace janus
