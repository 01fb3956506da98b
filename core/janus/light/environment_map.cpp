// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/light/environment_map.h"

#include "janus/image/latlong.h"

namespace janus {

EnvironmentMap::EnvironmentMap(std::shared_ptr<const Image> picture, bool srgb,
                               Interpolation interpolation, Rgb scale, const mat3& to_image)
    : texture_{std::move(picture), interpolation, Extension::Repeat, srgb},
      linear_(interpolation == Interpolation::Linear),
      scale_(scale),
      to_image_(to_image),
      rows_(texture_.image->height + (linear_ ? 1 : 0)),
      columns_(texture_.image->width) {
  const Image& image = *texture_.image;
  Texture pixels = texture_;
  pixels.interpolation = Interpolation::Closest;
  const auto pixel = [&](int x, int y) {
    return luminance(color(pixels, (vec2(x, y) + 0.5f) / vec2(columns_, image.height)));
  };
  const auto line = [&](int y) {
    std::vector<float> values(columns_);
    for (int x = 0; x < columns_; ++x) {
      values[x] = pixel(x, y);
    }
    return values;
  };
  // With linear interpolation, row r lies between the lines r - 1 and r of pixels, and its column c
  // between the pixels c - 1 and c.
  std::vector<float> rows, below = line(image.height - 1), cells(columns_);
  for (int r = 0; r < rows_; ++r) {
    const std::vector<float> above = line(r % image.height);
    double sum = 0.0;
    for (int c = 0; c < columns_; ++c) {
      const int left = (c + columns_ - 1) % columns_;
      cells[c] = linear_ ? 0.25f * (below[left] + below[c] + above[left] + above[c]) : above[c];
      sum += cells[c];
    }
    column_.emplace_back(cells);
    rows.push_back(static_cast<float>(sum) * solid_angle(r));
    total_ += rows.back();
    below = above;
  }
  row_ = DiscreteDistribution(rows);
}

double EnvironmentMap::edge(int row) const {
  return std::clamp((row - (linear_ ? 0.5 : 0.0)) / texture_.image->height, 0.0, 1.0);
}

float EnvironmentMap::solid_angle(int row) const {
  const double dz = latlong_z(edge(row + 1)) - latlong_z(edge(row));
  return static_cast<float>(2.0 * kPi / columns_ * dz);
}

Rgb EnvironmentMap::radiance(vec3 direction) const {
  return color(texture_, direction_to_latlong(to_image_ * direction));
}

Rgb EnvironmentMap::color(const Texture& texture, vec2 uv) const {
  return scale_ * glm::max(Rgb(texture.decode(texture.lookup(uv))), Rgb(0.0f));
}

vec3 EnvironmentMap::sample(vec2 u) const {
  const size_t row = row_.sample(u.y, &u.y);
  const size_t column = column_[row].sample(u.x, &u.x);
  const double low = latlong_z(edge(static_cast<int>(row)));
  const double high = latlong_z(edge(static_cast<int>(row) + 1));
  const double x = (static_cast<double>(column) + u.x - (linear_ ? 0.5 : 0.0)) / columns_;
  const vec3 local = latlong_to_direction(x, low + u.y * (high - low));
  return normalize(glm::transpose(to_image_) * local);
}

float EnvironmentMap::pdf_solid(vec3 direction) const {
  const vec2 uv = direction_to_latlong(to_image_ * direction);
  const float shift = linear_ ? 0.5f : 0.0f;
  const int row = std::clamp(
      static_cast<int>(std::floor(uv.y * static_cast<float>(texture_.image->height) + shift)), 0,
      rows_ - 1);
  const int column =
      static_cast<int>(std::floor(uv.x * static_cast<float>(columns_) + shift)) % columns_;
  const float pmf = row_.pmf(row);
  return pmf > 0.0f ? pmf * column_[row].pmf(column) / solid_angle(row) : 0.0f;
}

}  // namespace janus
