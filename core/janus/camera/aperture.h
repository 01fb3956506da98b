// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <vector>

#include "janus/math/warp.h"
#include "janus/scene/description.h"

namespace janus {

// The opening of a lens, as in Cycles: a disk or a regular polygon in a circle of the given radius,
// turned, then made narrower by the ratio. Rotation 0 puts the middle of an edge on +x.
class Aperture {
 public:
  explicit Aperture(const CameraDesc& desc)
      : radius_(desc.aperture_radius), inverse_ratio_(1.0f / desc.aperture_ratio) {
    const int blades = desc.aperture_blades < 3 ? 0 : desc.aperture_blades;
    for (int i = 0; i < blades; ++i) {
      corners_.push_back(cos_sin(desc.aperture_rotation + kPi * (2 * i - 1) / blades));
    }
  }

  bool pinhole() const { return !(radius_ > 0.0f); }

  // Uniform on the opening; metres on the lens, x to the right, y up.
  vec2 sample(vec2 u) const {
    vec2 p;
    if (corners_.empty()) {
      p = square_to_disk(u);
    } else {
      const size_t count = corners_.size();
      const float scaled = u.x * static_cast<float>(count);
      const size_t i = std::min(static_cast<size_t>(scaled), count - 1);
      const vec2 b = square_to_triangle(vec2(scaled - static_cast<float>(i), u.y));
      p = b.x * corners_[i] + b.y * corners_[i + 1 < count ? i + 1 : 0];
    }
    return radius_ * vec2(p.x * inverse_ratio_, p.y);
  }

  // Square metres.
  float area() const {
    const size_t n = corners_.size();
    const float unit =
        n == 0 ? kPi : 0.5f * static_cast<float>(n) * std::sin(2.0f * kPi / static_cast<float>(n));
    return unit * radius_ * radius_ * inverse_ratio_;
  }

  // Is a point of the lens, in the units of sample(), in the opening?
  bool contains(vec2 p) const {
    const vec2 unit = vec2(p.x / inverse_ratio_, p.y) / radius_;
    for (size_t i = 0; i < corners_.size(); ++i) {
      const vec2 edge = corners_[i + 1 < corners_.size() ? i + 1 : 0] - corners_[i];
      const vec2 to = unit - corners_[i];
      if (edge.x * to.y - edge.y * to.x < 0.0f) {
        return false;
      }
    }
    return !corners_.empty() || dot(unit, unit) <= 1.0f;
  }

 private:
  float radius_, inverse_ratio_;
  std::vector<vec2> corners_;  // on the unit circle
};

}  // namespace janus
