// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/image/image.h"

#include <cmath>
#include <optional>

namespace janus {

void Image::pack() {
  std::array<bool, 256> known{};
  const auto packed = [&](float x) -> std::optional<uint8_t> {
    if (!(x >= 0.0f && x <= 1.0f)) {
      return std::nullopt;
    }
    const auto byte = static_cast<uint8_t>(std::lround(255.0f * x));
    if (!known[byte]) {
      known[byte] = true;
      value[byte] = x;
    }
    return value[byte] == x ? std::optional(byte) : std::nullopt;
  };
  blocks.resize(static_cast<size_t>((width + 3) / 4) * ((height + 3) / 4));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const size_t at = (static_cast<size_t>(y) * width + x) * channels;
      auto& rgba = blocks[block_of(x, y)].rgba[place_in_block(x, y)];
      for (int c = 0; c < 4; ++c) {
        const auto byte = packed(c < channels ? pixels[at + c] : 1.0f);
        if (!byte) {
          blocks = {};
          return;
        }
        rgba[c] = *byte;
      }
    }
  }
}

}  // namespace janus
