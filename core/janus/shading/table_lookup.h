// SPDX-License-Identifier: GPL-3.0-or-later
//
// Linear interpolation in tables over [0, 1], the first axis running fastest.
#pragma once

#include <algorithm>

namespace janus {

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

template <int N, class T>
float read(const T* table, Place<N> x) {
  return x.mix(static_cast<float>(table[x.first]), static_cast<float>(table[x.first + 1]));
}
template <int N, class T>
float read(const T* table, Place<N> x, Place<N> y) {
  const T* row = table + N * y.first;
  return y.mix(read(row, x), read(row + N, x));
}
template <int N, class T>
float read(const T* table, Place<N> x, Place<N> y, Place<N> z) {
  const T* slice = table + N * N * z.first;
  return z.mix(read(slice, x, y), read(slice + N * N, x, y));
}

}  // namespace janus
