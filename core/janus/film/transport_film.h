// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where contributions go that are told apart by the pixel of a projector in which their path
// starts: the entries of a light transport matrix. Here they are only collected; what is kept of
// them is up to TransportPilot and TransportSums.
#pragma once

#include <cstdint>
#include <vector>

#include "janus/film/film.h"

namespace janus {

// A contribution to a camera pixel from a projector's pixel: row by row from the bottom left.
struct Transported {
  uint32_t pixel, source;
  Rgb value;
};

// The camera's pixels in square tiles, which are the same for all of the matrix.
struct CameraTiles {
  static constexpr int kSide = 8, kPixels = kSide * kSide;

  int width, height;

  int columns() const { return (width + kSide - 1) / kSide; }
  int rows() const { return (height + kSide - 1) / kSide; }
  size_t count() const { return static_cast<size_t>(columns()) * rows(); }
  size_t tile(uint32_t pixel) const {
    const int x = static_cast<int>(pixel) % width, y = static_cast<int>(pixel) / width;
    return static_cast<size_t>(y / kSide) * columns() + x / kSide;
  }
  // The number of the pixel in its tile.
  uint32_t place(uint32_t pixel) const {
    const int x = static_cast<int>(pixel) % width, y = static_cast<int>(pixel) / width;
    return static_cast<uint32_t>((y % kSide) * kSide + x % kSide);
  }
  // The other way round; a tile at the border has places outside, which are none.
  bool pixel(size_t tile, uint32_t place, uint32_t& result) const {
    const int x = static_cast<int>(tile) % columns() * kSide + static_cast<int>(place) % kSide;
    const int y = static_cast<int>(tile) / columns() * kSide + static_cast<int>(place) / kSide;
    result = static_cast<uint32_t>(y * width + x);
    return x < width && y < height;
  }
};

// Collects a pass: one list for each row of camera pixels and one for each block of light paths,
// which one thread fills at a time. They are taken in this order, so that all sums are independent
// of the threads. Pixels are boxes: a splat belongs to one of them.
class TransportFilm {
 public:
  TransportFilm(int width, int height, int source_width, int source_height)
      : tiles_{width, height}, source_width_(source_width), source_height_(source_height) {
    camera_.resize(height);
  }
  virtual ~TransportFilm() = default;

  const CameraTiles& tiles() const { return tiles_; }
  int source_width() const { return source_width_; }
  int source_height() const { return source_height_; }

  // What an abandoned pass has left is dropped.
  void begin_pass();
  // There will be splats from so many blocks.
  void start_splats(size_t blocks) { light_.resize(std::max(light_.size(), blocks)); }
  void add(size_t pixel, uint32_t source, Rgb value) {
    const auto index = static_cast<uint32_t>(pixel);
    camera_[index / tiles_.width].push_back({index, source, value});
  }
  void add_splat(size_t block, vec2 raster, uint32_t source, Rgb value) {
    const vec2 p = glm::floor(raster);
    if (p.x >= 0.0f && p.y >= 0.0f && p.x < tiles_.width && p.y < tiles_.height) {
      const auto pixel = static_cast<uint32_t>(p.y) * tiles_.width + static_cast<uint32_t>(p.x);
      light_[block].push_back({pixel, source, value});
    }
  }
  void end_pass(ThreadPool& pool);

 protected:
  // The contributions of a pass to a row of tiles, in their order. One thread for each row.
  virtual void take(std::vector<Transported>& contributions) = 0;
  virtual void pass_taken() {}

 private:
  CameraTiles tiles_;
  int source_width_, source_height_;
  std::vector<std::vector<Transported>> camera_, light_;
};

}  // namespace janus
