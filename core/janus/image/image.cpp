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
  const int across = blocks_across();
  decltype(blocks) made(static_cast<size_t>(across) * ((height + 3) / 4));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const size_t at = (static_cast<size_t>(y) * width + x) * channels;
      auto& rgba =
          made[static_cast<size_t>(y >> 2) * across + (x >> 2)].rgba[(y & 3) << 2 | (x & 3)];
      for (int c = 0; c < 4; ++c) {
        const auto byte = packed(c < channels ? pixels[at + c] : 1.0f);
        if (!byte) {
          return;
        }
        rgba[c] = *byte;
      }
    }
  }
  blocks = std::move(made);
}

}  // namespace janus
