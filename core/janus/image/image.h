// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace janus {

// Float pixels, `channels` interleaved; row 0 is the bottom row, as in Blender.
struct Image {
  int width = 0, height = 0, channels = 0;
  std::vector<float> pixels;  // width * height * channels

  // The same numbers in a quarter of the memory that lookups wander over, if pack() found that
  // there are so few: value[bytes[i]] is pixels[i].
  std::vector<uint8_t> bytes;
  std::array<float, 256> value{};

  Image() = default;
  Image(int width, int height, int channels)
      : width(width),
        height(height),
        channels(channels),
        pixels(static_cast<size_t>(width) * height * channels, 0.0f) {}

  // Fills `bytes` if the pixels were bytes once, as those of most pictures. For pixels that stay as
  // they are from now on.
  void pack();
};

}  // namespace janus
