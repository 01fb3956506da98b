// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/image/image.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "janus/image/texture.h"

namespace janus::test {
namespace {

Image bytes(int channels) {
  Image image(18, 7, channels);
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    image.pixels[i] = static_cast<float>(31 * i % 256) / 255.0f;
  }
  return image;
}

// Textures look up the same, bit for bit.
TEST(ImagePack, KeepsWhatWereBytes) {
  for (const int channels : {3, 4}) {
    const auto plain = std::make_shared<Image>(bytes(channels));
    auto packed = std::make_shared<Image>(*plain);
    packed->pack();
    ASSERT_FALSE(packed->blocks.empty());
    for (const auto interpolation :
         {Interpolation::Linear, Interpolation::Closest, Interpolation::Cubic}) {
      const Texture a{plain, interpolation}, b{packed, interpolation};
      for (int i = 0; i < 200; ++i) {
        const vec2 uv(0.013f * static_cast<float>(i), 0.029f * static_cast<float>(i));
        EXPECT_EQ(a.lookup(uv), b.lookup(uv)) << uv.x;
      }
    }
  }
}

TEST(ImagePack, LeavesOtherNumbers) {
  for (const float other : {0.1234f, -0.5f, 1.5f, std::nanf("")}) {
    Image image = bytes(4);
    image.pixels[77] = other;
    image.pack();
    EXPECT_TRUE(image.blocks.empty()) << other;
  }
}

}  // namespace
}  // namespace janus::test
