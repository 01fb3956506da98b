// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/shading/albedo.h"

#include <algorithm>
#include <cmath>

#include "janus/shading/fresnel.h"

namespace janus {

namespace {

#include "albedo_tables.inc"

constexpr int kFine = 32, kCoarse = 16;

// Where a value of an axis with N entries falls: between `first` and `first + 1`, at `t`.
template <int N>
struct Place {
  int first;
  float t;

  explicit Place(float x) {
    // Written so that NaN lands in the table too.
    const float scaled = (x > 0.0f ? std::min(x, 1.0f) : 0.0f) * (N - 1);
    first = std::min(static_cast<int>(scaled), N - 2);
    t = scaled - static_cast<float>(first);
  }
  float mix(float a, float b) const { return (1.0f - t) * a + t * b; }
};

template <int N>
float read(const float* table, Place<N> x) {
  return x.mix(table[x.first], table[x.first + 1]);
}
template <int N>
float read(const float* table, Place<N> x, Place<N> y) {
  const float* row = table + N * y.first;
  return y.mix(read(row, x), read(row + N, x));
}
template <int N>
float read(const float* table, Place<N> x, Place<N> y, Place<N> z) {
  const float* slice = table + N * N * z.first;
  return z.mix(read(slice, x, y), read(slice + N * N, x, y));
}

// Place of an index of refraction; the same for eta and 1 / eta.
Place<kCoarse> index_place(float eta) {
  return Place<kCoarse>(std::sqrt(std::abs((eta - 1.0f) / (eta + 1.0f))));
}

}  // namespace

float reflection_albedo(float rough, float mu) {
  return read(kReflection, Place<kFine>(rough), Place<kFine>(mu));
}

float reflection_albedo_average(float rough) {
  return read(kReflectionAverage, Place<kFine>(rough));
}

float glass_albedo(float rough, float mu, float eta) {
  return read(eta < 1.0f ? kGlassInside : kGlassOutside, Place<kCoarse>(rough), Place<kCoarse>(mu),
              index_place(eta));
}

float glass_albedo_average(float rough, float eta) {
  return read(eta < 1.0f ? kGlassInsideAverage : kGlassOutsideAverage, Place<kCoarse>(rough),
              index_place(eta));
}

float schlick_reflectance(float rough, float mu) {
  return read(kSchlickPosition, Place<kCoarse>(rough), Place<kCoarse>(mu));
}

float dielectric_reflectance(float rough, float mu, float eta) {
  const float position =
      read(kFresnelPosition, Place<kCoarse>(rough), Place<kCoarse>(mu), index_place(eta));
  const float f0 = fresnel_normal(eta);
  return f0 + (1.0f - f0) * position;
}

}  // namespace janus
