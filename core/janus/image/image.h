// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "janus/util/huge_pages.h"

namespace janus {

// Float pixels, `channels` interleaved; row 0 is the bottom row, as in Blender.
struct Image {
  int width = 0, height = 0, channels = 0;
  std::vector<float> pixels;  // width * height * channels

  // The same numbers as RGBA bytes, if pack() found that there are so few: a quarter of the memory
  // that lookups wander over. Blocks of 4 x 4 pixels fill a cache line each, so that the neighbours
  // of a pixel, above and below too, are mostly in the line that it is in.
  struct alignas(64) Block {
    std::array<std::array<uint8_t, 4>, 16> rgba;
  };
  std::vector<Block> blocks;       // rows of blocks
  std::array<float, 256> value{};  // of a byte

  Image() = default;
  Image(int width, int height, int channels)
      : width(width),
        height(height),
        channels(channels),
        pixels(static_cast<size_t>(width) * height * channels, 0.0f) {}

  // Fills `blocks` if the pixels were bytes once, as those of most pictures: their channels, and 1
  // for an alpha that they lack. For pixels that stay as they are from now on.
  void pack();

  // Of a pixel, where `blocks` are filled.
  const std::array<uint8_t, 4>& bytes(int x, int y) const {
    return blocks[block_of(x, y)].rgba[place_in_block(x, y)];
  }

 private:
  size_t block_of(int x, int y) const {
    return static_cast<size_t>(y >> 2) * ((width + 3) >> 2) + (x >> 2);
  }
  static int place_in_block(int x, int y) { return (y & 3) << 2 | (x & 3); }
};

}  // namespace janus
