// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/film/transport_sums.h"

#include <algorithm>

namespace janus {

namespace {

// Of the mean of n numbers, from the sum of their squares.
Rgb variance_of_mean(Rgb sum, Rgb square, double n) {
  if (n < 2.0) {
    return Rgb(0.0f);
  }
  const glm::dvec3 s(sum), q(square);
  return Rgb(glm::max(q - s * s / n, glm::dvec3(0.0)) / (n * (n - 1.0)));
}

}  // namespace

TransportSums::TransportSums(int width, int height, int source_width, int source_height,
                             int shares_size, TransportBlocks blocks)
    : TransportFilm(width, height, source_width, source_height),
      blocks_(std::move(blocks)),
      shares_size_(shares_size),
      sums_(CameraTiles::kPixels * blocks_.count()),
      shares_(tiles().count() * squares(source_width) * squares(source_height)) {}

int TransportSums::shares_size_for(const CameraTiles& tiles, int source_width, int source_height,
                                   size_t bytes) {
  int size = 1;
  const auto squares = [&](int side) { return static_cast<size_t>((side + size - 1) / size); };
  while (tiles.count() * squares(source_width) * squares(source_height) * sizeof(Sum) > bytes &&
         size < std::max(source_width, source_height)) {
    size *= 2;
  }
  return size;
}

void TransportSums::take(std::vector<Transported>& contributions) {
  std::vector<Part> entries, shares;
  entries.reserve(contributions.size());
  shares.reserve(contributions.size());
  const uint32_t columns = squares(source_width()), rows = squares(source_height());
  for (const Transported& t : contributions) {
    const uint32_t x = t.source % source_width(), y = t.source / source_width();
    const size_t tile = tiles().tile(t.pixel);
    const size_t row = blocks_.of_tile(tile).size() * tiles().place(t.pixel);
    entries.push_back({first_sum(tile) + row + blocks_.find(tile, x, y), t.value});
    shares.push_back({(tile * rows + y / shares_size_) * columns + x / shares_size_, t.value});
  }
  accumulate(entries, sums_);
  accumulate(shares, shares_);
}

// What a pass adds to a sum is one sample of it.
void TransportSums::accumulate(std::vector<Part>& parts, std::vector<Sum>& sums) {
  std::ranges::stable_sort(parts, {}, &Part::index);
  for (size_t i = 0; i < parts.size();) {
    Sum& sum = sums[parts[i].index];
    Rgb sample(0.0f);
    for (const uint64_t index = parts[i].index; i < parts.size() && parts[i].index == index; ++i) {
      sample += parts[i].value;
    }
    sum.value += sample;
    sum.square += sample * sample;
  }
}

TransportMatrix TransportSums::matrix() const {
  TransportMatrix m;
  m.samples = passes_;
  m.shares_size = shares_size_;
  const double n = std::max(passes_, 1);
  const auto mean = [&](const Sum& sum) { return Rgb(glm::dvec3(sum.value) / n); };
  for (size_t tile = 0; tile < tiles().count(); ++tile) {
    const auto blocks = blocks_.of_tile(tile);
    for (const SourceBlock& b : blocks) {
      m.blocks.push_back({static_cast<uint32_t>(tile), b.x, b.y, b.size});
    }
    for (uint32_t place = 0; place < CameraTiles::kPixels; ++place) {
      uint32_t pixel;
      if (!tiles().pixel(tile, place, pixel)) {
        continue;
      }
      for (size_t b = 0; b < blocks.size(); ++b) {
        const Sum& sum = sums_[first_sum(tile) + blocks.size() * place + b];
        if (!is_black(sum.value)) {
          m.pixels.push_back(pixel);
          m.entry_blocks.push_back(static_cast<uint32_t>(blocks_.first(tile) + b));
          m.values.push_back(mean(sum));
          m.variances.push_back(variance_of_mean(sum.value, sum.square, n));
        }
      }
    }
  }
  for (const Sum& sum : shares_) {
    m.shares.push_back(mean(sum));
    m.share_variances.push_back(variance_of_mean(sum.value, sum.square, n));
  }
  return m;
}

}  // namespace janus
