// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

namespace janus {

// e^x to 2e-7 of it; beyond 87 on either side that of 87, of what is no number that of -87. C
// libraries differ in the last digit of theirs; sums and products do not, and compilers do several
// at once. The polynomial is that of Cephes (Moshier).
inline float exp_of(float x) {
  x = std::min(87.0f, std::max(-87.0f, x));
  constexpr float kRounding = 12582912.0f;  // a float so large has no places after the point
  const float n = (x * 1.44269504f + kRounding) - kRounding;
  // Two steps, because ln 2 does not fit into one number.
  const float r = (x - n * 0.693359375f) + n * 2.12194440e-4f;
  float p = r * 1.9875691500e-4f + 1.3981999507e-3f;
  p = r * p + 8.3334519073e-3f;
  p = r * p + 4.1665795894e-2f;
  p = r * p + 1.6666665459e-1f;
  p = r * p + 5.0000001201e-1f;
  const int32_t power = (static_cast<int32_t>(n) + 127) << 23;
  return (1.0f + r + r * r * p) * std::bit_cast<float>(power);
}

}  // namespace janus
