// SPDX-License-Identifier: GPL-3.0-or-later
//
// The few statistics that the tests need. Seeds are fixed, so a test that passes keeps passing;
// thresholds are chosen for a small rate of false alarms when a seed or the code changes.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "janus/math/vec.h"

namespace janus::test {

// Independent of the renderer's own sampler on purpose.
class Random {
 public:
  explicit Random(uint64_t seed) : engine_(seed) {}
  float next() { return static_cast<float>(engine_() >> 40) * 0x1p-24f; }
  vec2 next_2d() {
    const float x = next();
    return vec2(x, next());
  }
  float in(float low, float high) { return low + (high - low) * next(); }
  vec3 direction() {
    const float z = in(-1.0f, 1.0f), phi = in(0.0f, 2.0f * kPi);
    const float r = std::sqrt(std::max(0.0f, 1.0f - z * z));
    return vec3(r * std::cos(phi), r * std::sin(phi), z);
  }

 private:
  std::mt19937_64 engine_;
};

// Mean and standard error of independent numbers.
class Mean {
 public:
  void add(double x) {
    ++n_;
    const double d = x - mean_;
    mean_ += d / n_;
    m2_ += d * (x - mean_);
  }
  double mean() const { return mean_; }
  double error() const { return std::sqrt(m2_ / n_ / (n_ - 1.0)); }
  uint64_t count() const { return n_; }

 private:
  uint64_t n_ = 0;
  double mean_ = 0.0, m2_ = 0.0;
};

// Welch's statistic of two means; 0 where both are exactly equal.
inline double z_score(const Mean& a, const Mean& b) {
  const double d = a.mean() - b.mean();
  return d == 0.0 ? 0.0 : d / std::hypot(a.error(), b.error());
}
inline double z_score(const Mean& a, double expected) {
  const double d = a.mean() - expected;
  return d == 0.0 ? 0.0 : d / a.error();
}

inline ::testing::AssertionResult agree(const Mean& a, const Mean& b, double max_z = 4.0) {
  const double z = z_score(a, b);
  if (std::abs(z) < max_z) {
    return ::testing::AssertionSuccess();
  }
  return ::testing::AssertionFailure() << a.mean() << " +- " << a.error() << " against " << b.mean()
                                       << " +- " << b.error() << ", z = " << z;
}

// |a / b - 1| < tolerance, and the standard errors are small enough for that to mean something.
inline ::testing::AssertionResult close(const Mean& a, const Mean& b, double tolerance) {
  const double ratio = a.mean() / b.mean();
  const double error = std::hypot(a.error() / a.mean(), b.error() / b.mean());
  if (std::abs(ratio - 1.0) < tolerance && error < 0.5 * tolerance) {
    return ::testing::AssertionSuccess();
  }
  return ::testing::AssertionFailure()
         << "ratio " << ratio << " +- " << error << ", tolerance " << tolerance;
}

// Chi-square test of counts against expectations, as a normal deviate (Wilson & Hilferty 1931).
// Cells that expect fewer than 5 are pooled. Large positive: the counts do not fit.
inline double chi_square_z(const std::vector<double>& counts, const std::vector<double>& expected) {
  double chi2 = 0.0, pooled_count = 0.0, pooled = 0.0;
  int cells = 0;
  for (size_t i = 0; i < counts.size(); ++i) {
    if (expected[i] < 5.0) {
      pooled_count += counts[i];
      pooled += expected[i];
      continue;
    }
    chi2 += (counts[i] - expected[i]) * (counts[i] - expected[i]) / expected[i];
    ++cells;
  }
  if (pooled >= 5.0) {
    chi2 += (pooled_count - pooled) * (pooled_count - pooled) / pooled;
    ++cells;
  } else if (pooled_count > 5.0 * (pooled + 4.0)) {
    return 1e9;  // samples where hardly any may be
  }
  const double n = std::max(1, cells - 1);
  return (std::cbrt(chi2 / n) - (1.0 - 2.0 / (9.0 * n))) / std::sqrt(2.0 / (9.0 * n));
}

// Cells of equal solid angle over the sphere: z times azimuth around +z.
struct SphereCells {
  int rows = 16, columns = 16;
  size_t size() const { return static_cast<size_t>(rows) * columns; }
  size_t cell(vec3 d) const {
    const int row = std::min(rows - 1, static_cast<int>(0.5f * (d.z + 1.0f) * rows));
    const float phi = std::atan2(d.y, d.x) / (2.0f * kPi) + 0.5f;
    const int column = std::min(columns - 1, static_cast<int>(phi * columns));
    return static_cast<size_t>(row) * columns + column;
  }
  // Integrals of `pdf` over the cells by `grid`^2 midpoints each.
  template <class Pdf>
  std::vector<double> integrate(Pdf&& pdf, int grid = 24) const {
    std::vector<double> out(size(), 0.0);
    const double share = 4.0 * 3.14159265358979 / (size() * static_cast<double>(grid) * grid);
    for (int i = 0; i < rows * grid; ++i) {
      const float z = -1.0f + 2.0f * (i + 0.5f) / (rows * grid);
      const float r = std::sqrt(1.0f - z * z);
      for (int j = 0; j < columns * grid; ++j) {
        const float phi = 2.0f * kPi * ((j + 0.5f) / (columns * grid) - 0.5f);
        out[static_cast<size_t>(i / grid) * columns + j / grid] +=
            pdf(vec3(r * std::cos(phi), r * std::sin(phi), z)) * share;
      }
    }
    return out;
  }
};

// How much is drawn. JANUS_BRIEF=1 is for sanitizers, which look at memory and threads and are
// slow: so little that what comes of it is not judged (support/main.cpp). JANUS_FULL=1 is for the
// nightly run.
inline bool brief() { return std::getenv("JANUS_BRIEF") != nullptr; }
inline bool full() { return !brief() && std::getenv("JANUS_FULL") != nullptr; }
// Has the running test got less than it asked for?
inline std::atomic<bool> shortened{false};

// Samples of a pixel, where a quick run takes so many.
inline int samples(int quick) {
  if (brief()) {
    shortened = true;
    return std::max(1, quick / 16);
  }
  return full() ? 16 * quick : quick;
}
// Independent pictures, where others take so many; at least two, for an error.
inline int seeds(int usual = 12) {
  if (brief()) {
    shortened = true;
    return std::min(usual, 2);
  }
  return usual;
}

}  // namespace janus::test
