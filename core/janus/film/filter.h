// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "janus/math/vec.h"

namespace janus {

enum class FilterType { Box, Gaussian, BlackmanHarris };

// A separable pixel filter h with integral 1, in pixels. Shapes and widths as in Cycles.
// Camera samples draw their offset from h (every sample weighs 1); splats weigh h(offset).
class Filter {
 public:
  Filter(FilterType type, float width);

  float radius() const { return radius_; }
  vec2 sample(vec2 u) const { return vec2(sample_1d(u.x), sample_1d(u.y)); }
  float evaluate(vec2 offset) const { return density(offset.x) * density(offset.y); }

 private:
  float density(float x) const;
  float sample_1d(float u) const;

  // Piecewise constant over [-radius, radius]: sampling and evaluation are the same function
  // exactly, so camera and light images have the same expectation.
  float radius_;
  std::vector<float> density_;
  std::vector<float> cdf_;       // density_.size() + 1 entries from 0 to 1
  std::vector<uint32_t> guide_;  // where in cdf_ to look for a number
};

}  // namespace janus
