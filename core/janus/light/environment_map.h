// SPDX-License-Identifier: GPL-3.0-or-later
//
// A lat-long picture of the surroundings as radiance, and its importance sampling.
#pragma once

#include <memory>

#include "janus/image/texture.h"
#include "janus/math/discrete.h"

namespace janus {

class EnvironmentMap {
 public:
  // `image` has three channels or more, finite (negative ones count as 0); `scale` multiplies its
  // colours; `to_image` (orthogonal) turns directions of the world into those of the picture.
  EnvironmentMap(std::shared_ptr<const Image> image, bool srgb, Interpolation interpolation,
                 Rgb scale, const mat3& to_image);

  bool black() const { return row_.empty(); }
  Rgb radiance(vec3 direction) const;

  // A direction, drawn with pdf_solid(). That is constant in each cell of a grid, with the cell's
  // mean luminance, and positive wherever radiance() has luminance.
  vec3 sample(vec2 u) const;
  float pdf_solid(vec3 direction) const;

  // The integral of the luminance over all directions (an estimate by cells).
  float total() const { return total_; }

 private:
  // Cells lie between the centres of pixels where colours are interpolated linearly, so that each
  // has but four colours; the rows at the poles are half as high then.
  double edge(int row) const;  // v at the lower edge
  float solid_angle(int row) const;

  // The colour of a place in the picture, scaled.
  Rgb color(const Texture& texture, vec2 uv) const;

  Texture texture_;
  bool linear_;
  Rgb scale_;
  mat3 to_image_;
  int rows_, columns_;
  float total_ = 0.0f;
  DiscreteDistribution row_;                  // from the bottom
  std::vector<DiscreteDistribution> column_;  // by row
};

}  // namespace janus
