// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/integrator/roulette_map.h"

#include <algorithm>

namespace janus {

namespace {
// A contribution below this share of its pixel's value plays roulette. The variance that this adds
// per sample is at most the share times the squared value.
constexpr float kShare = 0.1f;
constexpr double kFloor = 0.1;  // of the frame's mean, for value()
}  // namespace

void RouletteMap::update(const Film& film, int pass) {
  if (film.passes() == 0 || (pass & (pass - 1)) != 0) {
    return;
  }
  rect_ = film.rect();
  columns_ = (rect_.width() + kBlock - 1) / kBlock;
  rows_ = (rect_.height() + kBlock - 1) / kBlock;
  values_.assign(static_cast<size_t>(columns_) * rows_, 0.0f);
  double sum = 0.0;
  for (int by = 0; by < rows_; ++by) {
    for (int bx = 0; bx < columns_; ++bx) {
      const int x1 = std::min((bx + 1) * kBlock, rect_.width());
      const int y1 = std::min((by + 1) * kBlock, rect_.height());
      // The squared mean of the roots: a single bright sample does not blind the whole block.
      double roots = 0.0;
      int count = 0;
      for (int y = by * kBlock; y < y1; ++y) {
        for (int x = bx * kBlock; x < x1; ++x) {
          const size_t index = static_cast<size_t>(y) * rect_.width() + x;
          roots += std::sqrt(std::max(0.0f, max_component(film.mean(index))));
          ++count;
        }
      }
      const double root = roots / count;
      values_[static_cast<size_t>(by) * columns_ + bx] = static_cast<float>(root * root);
      sum += root * root;
    }
  }
  floor_ = static_cast<float>(kFloor * sum / static_cast<double>(values_.size()));
}

float RouletteMap::block(vec2 raster) const {
  const int x = (static_cast<int>(raster.x) - rect_.x0) / kBlock;
  const int y = (static_cast<int>(raster.y) - rect_.y0) / kBlock;
  return values_[static_cast<size_t>(std::clamp(y, 0, rows_ - 1)) * columns_ +
                 std::clamp(x, 0, columns_ - 1)];
}

float RouletteMap::value(vec2 raster) const {
  return values_.empty() ? 0.0f : std::max(block(raster), floor_);
}

Roulette RouletteMap::at(vec2 raster) const {
  return values_.empty() ? Roulette() : Roulette(kShare * block(raster));
}

}  // namespace janus
