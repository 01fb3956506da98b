// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace janus {

// A discrete distribution over [0, size) by inversion of its cumulative sums.
class DiscreteDistribution {
 public:
  DiscreteDistribution() = default;

  // Probabilities proportional to `weights` (>= 0). All zero: empty() is true.
  explicit DiscreteDistribution(std::span<const float> weights) {
    double total = 0.0;
    cdf_.reserve(weights.size());
    for (const float w : weights) {
      total += w;
      cdf_.push_back(total);
    }
    if (!(total > 0.0)) {
      cdf_.clear();
      return;
    }
    for (double& c : cdf_) {
      c /= total;
    }
  }

  bool empty() const { return cdf_.empty(); }
  size_t size() const { return cdf_.size(); }

  float pmf(size_t i) const { return static_cast<float>(cdf_[i] - (i ? cdf_[i - 1] : 0.0)); }

  // The index for u in [0, 1); `remainder` is u rescaled to [0, 1) within that index's share, so
  // that one stratified number can serve twice. Never returns an index of probability zero.
  size_t sample(float u, float* remainder = nullptr) const {
    auto it = std::upper_bound(cdf_.begin(), cdf_.end(), static_cast<double>(u));
    if (it == cdf_.end()) {  // rounding at the upper end
      it = std::lower_bound(cdf_.begin(), cdf_.end(), cdf_.back());
    }
    const size_t i = it - cdf_.begin();
    if (remainder) {
      const double low = i ? cdf_[i - 1] : 0.0;
      *remainder = std::min(static_cast<float>((u - low) / (cdf_[i] - low)), 0x1.fffffep-1f);
    }
    return i;
  }

 private:
  std::vector<double> cdf_;
};

}  // namespace janus
