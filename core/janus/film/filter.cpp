// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/film/filter.h"

#include <algorithm>

namespace janus {

namespace {

constexpr int kCells = 1024;

double shape(FilterType type, double x, double width) {
  switch (type) {
    case FilterType::Box:
      return 1.0;
    case FilterType::Gaussian: {
      const double v = 6.0 * x / width;
      return std::exp(-2.0 * v * v);
    }
    case FilterType::BlackmanHarris: {
      const double v = 2.0 * 3.14159265358979323846 * (x / width + 0.5);
      return 0.35875 - 0.48829 * std::cos(v) + 0.14128 * std::cos(2 * v) -
             0.01168 * std::cos(3 * v);
    }
  }
  return 1.0;
}

}  // namespace

Filter::Filter(FilterType type, float width) {
  // Cycles' filter width is a third (Gaussian) or a half (Blackman-Harris) of the support.
  // A box of width 0 would be a delta, which splats cannot be.
  width = std::max(width, 0.01f);
  const float support = type == FilterType::Box        ? width
                        : type == FilterType::Gaussian ? 3.0f * width
                                                       : 2.0f * width;
  radius_ = 0.5f * support;
  const int cells = type == FilterType::Box ? 1 : kCells;
  const double cell = static_cast<double>(support) / cells;
  std::vector<double> mass;
  double total = 0.0;
  for (int i = 0; i < cells; ++i) {
    const double x = (i + 0.5) * cell - radius_;
    mass.push_back(std::max(0.0, shape(type, x, support)));
    total += mass.back();
  }
  double sum = 0.0;
  cdf_.push_back(0.0f);
  for (const double m : mass) {
    density_.push_back(static_cast<float>(m / (total * cell)));
    sum += m / total;
    cdf_.push_back(static_cast<float>(sum));
  }
  cdf_.back() = 1.0f;
  // The first cell that a number in each equal part of [0, 1) can mean.
  guide_.resize(density_.size());
  for (size_t k = 0, i = 0; k < guide_.size(); ++k) {
    while (i + 1 < density_.size() && cdf_[i + 1] <= static_cast<float>(k) / guide_.size()) {
      ++i;
    }
    guide_[k] = static_cast<uint32_t>(i);
  }
}

float Filter::density(float x) const {
  const float u = (x + radius_) / (2.0f * radius_);
  if (!(u >= 0.0f && u < 1.0f)) {
    return 0.0f;
  }
  return density_[std::min(static_cast<size_t>(u * density_.size()), density_.size() - 1)];
}

float Filter::sample_1d(float u) const {
  size_t i = guide_[static_cast<size_t>(u * guide_.size())];
  while (i + 1 < density_.size() && cdf_[i + 1] <= u) {
    ++i;
  }
  const float width = cdf_[i + 1] - cdf_[i];
  const float within = width > 0.0f ? (u - cdf_[i]) / width : 0.5f;
  return (i + within) / density_.size() * 2.0f * radius_ - radius_;
}

}  // namespace janus
