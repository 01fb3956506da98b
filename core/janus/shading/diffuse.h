// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rough diffuse reflection as in Cycles: Fujii's improved Oren-Nayar model
// (https://mimosa-pudica.net/improved-oren-nayar.html) with the multiple-scattering term of the
// OpenPBR specification.
#pragma once

#include <algorithm>

#include "janus/math/vec.h"

namespace janus {

// Arc cosine on [0, 1] to 2e-8 (Abramowitz & Stegun 1964, 4.4.46). Sums and a root: the same with
// every C library.
inline float arc_cosine(float x) {
  x = std::min(x, 1.0f);
  float p = -0.0012624911f;
  for (const float c : {0.0066700901f, -0.0170881256f, 0.0308918810f, -0.0501743046f, 0.0889789874f,
                        -0.2145988016f, 1.5707963050f}) {
    p = p * x + c;
  }
  return std::sqrt(1.0f - x) * p;
}

class OrenNayar {
 public:
  explicit OrenNayar(float sigma)
      : a_(1.0f / (kPi + sigma * (0.5f * kPi - 2.0f / 3.0f))), b_(sigma * a_) {}

  // f with cosines `cos_o`, `cos_i` >= 0 to the normal; `cos_oi` between the directions.
  // Reciprocal.
  Rgb evaluate(float cos_o, float cos_i, float cos_oi, Rgb albedo) const {
    float t = cos_oi - cos_o * cos_i;
    if (t > 0.0f) {
      t /= std::max(std::max(cos_o, cos_i), 1e-20f);
    }
    const float mean = a_ * kPi + (2.0f * kPi - 5.6f) / 3.0f * b_;
    const float escapes = (1.0f - directional(cos_o)) * (1.0f - directional(cos_i));
    Rgb bounces(0.0f);
    if (mean < 1.0f - 1e-6f) {
      bounces = albedo * albedo * (mean / (1.0f - mean)) / (1.0f - albedo * (1.0f - mean));
    }
    return a_ + b_ * t + bounces * (kInvPi * escapes);
  }

 private:
  // Albedo of single scattering for one direction.
  float directional(float cos) const {
    const float sin = std::sqrt(std::max(0.0f, 1.0f - cos * cos));
    float g = 0.5f * kPi - 2.0f / 3.0f - cos;  // limit at the horizon
    if (cos > 1e-6f) {
      g = sin * (arc_cosine(cos) - 2.0f / 3.0f - sin * cos) +
          2.0f / 3.0f * (sin / cos) * (1.0f - sin * sin * sin);
    }
    return a_ * kPi + b_ * g;
  }

  float a_, b_;
};

}  // namespace janus
