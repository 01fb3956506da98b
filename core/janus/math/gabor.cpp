// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/math/gabor.h"

#include "janus/math/white_noise.h"

namespace janus {

namespace {

constexpr int kImpulses = 8;  // in each cell

// Each impulse of a cell has three seeds.
float seed(int impulse, int use) { return static_cast<float>(3 * impulse + use); }
constexpr int kOrientation = 0, kCenter = 1, kWeight = 2;

vec2 random_center(vec2 cell, float s) {
  return vec2(jenkins_number(cell.x, cell.y, s), jenkins_number(s, cell.x, cell.y));
}
vec3 random_center(vec3 cell, float s) { return white_color(vec4(cell, s)); }
float random_number(vec2 cell, float s) { return jenkins_number(cell.x, cell.y, s); }
float random_number(vec3 cell, float s) { return jenkins_number(cell.x, cell.y, cell.z, s); }

// Waves look the same from both sides: directions span half a turn.
vec2 direction(vec2 cell, float s, float isotropy, float orientation) {
  const float angle = orientation + (random_number(cell, s) - 0.5f) * kPi * isotropy;
  return vec2(std::cos(angle), std::sin(angle));
}
vec3 direction(vec3 cell, float s, float isotropy, vec3 orientation) {
  if (isotropy == 0.0f) {
    return orientation;
  }
  const vec2 random = kPi * isotropy * vec2(white_color(vec4(cell, s)));
  const float theta = std::acos(orientation.z) + random.x;
  const float azimuth = std::acos(orientation.x / glm::length(vec2(orientation)));
  const float phi = (orientation.y < 0.0f ? -azimuth : azimuth) + random.y;
  return vec3(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
}

// `p`: relative to the corner of the cell.
template <int D>
vec2 of_cell(Coordinates<D> cell, Coordinates<D> p, float frequency, float isotropy,
             const auto& orientation) {
  float away[kImpulses][D];  // all at first, for the compiler to take several at once
  for (int i = 0; i < kImpulses; ++i) {
    const Coordinates<D> center = random_center(cell, seed(i, kCenter));
    for (int d = 0; d < D; ++d) {
      away[i][d] = p[d] - center[d];
    }
  }
  vec2 sum(0.0f);
  for (int i = 0; i < kImpulses; ++i) {
    Coordinates<D> x;
    for (int d = 0; d < D; ++d) {
      x[d] = away[i][d];
    }
    const float d2 = dot(x, x);
    if (d2 >= 1.0f) {
      continue;
    }
    // A Gaussian, and a window that ends it at 1.
    const float height = std::exp(-kPi * d2) * (0.5f + 0.5f * std::cos(kPi * d2));
    const float sign = random_number(cell, seed(i, kWeight)) < 0.5f ? -1.0f : 1.0f;
    const Coordinates<D> wave =
        frequency * direction(cell, seed(i, kOrientation), isotropy, orientation);
    const float angle = 2.0f * kPi * dot(x, wave);
    sum += sign * height * vec2(std::cos(angle), std::sin(angle));
  }
  return sum;
}

template <int D>
vec2 gabor(Coordinates<D> p, float frequency, float isotropy, const auto& orientation) {
  const Coordinates<D> cell = glm::floor(p), local = p - cell;
  vec2 sum(0.0f);
  for (int i = 0; i < (D == 2 ? 9 : 27); ++i) {
    Coordinates<D> offset;
    for (int d = 0, rest = i; d < D; ++d, rest /= 3) {
      offset[d] = static_cast<float>(rest % 3 - 1);
    }
    sum += of_cell<D>(cell + offset, local - offset, frequency, isotropy, orientation);
  }
  return sum;
}

}  // namespace

vec2 gabor_noise(vec2 p, float frequency, float isotropy, float orientation) {
  return gabor<2>(p, frequency, isotropy, orientation);
}
vec2 gabor_noise(vec3 p, float frequency, float isotropy, vec3 orientation) {
  return gabor<3>(p, frequency, isotropy, orientation);
}

// Of so many impulses whose squares are 1/2 on average, times the integral of a kernel's square.
float gabor_range(int dimensions) {
  const float square = dimensions == 2 ? 0.25f : 0.25f / std::sqrt(2.0f);
  return 6.0f * std::sqrt(static_cast<float>(kImpulses) * 0.5f * square);
}

}  // namespace janus
