// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/image/image.h"

#include <cmath>

namespace janus {

void Image::pack() {
  std::vector<uint8_t> packed(pixels.size());
  std::array<bool, 256> known{};
  for (size_t i = 0; i < pixels.size(); ++i) {
    const float x = pixels[i];
    if (!(x >= 0.0f && x <= 1.0f)) {
      return;
    }
    const auto byte = static_cast<uint8_t>(std::lround(255.0f * x));
    if (!known[byte]) {
      known[byte] = true;
      value[byte] = x;
    }
    if (value[byte] != x) {
      return;
    }
    packed[i] = byte;
  }
  bytes = std::move(packed);
}

}  // namespace janus
