// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/image/image.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "janus/image/texture.h"

namespace janus::test {
namespace {

Image bytes(int channels, int width = 18, int height = 7) {
  Image image(width, height, channels);
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

// As many as huge pages are for.
TEST(ImagePack, KeepsLargePictures) {
  const Image plain = bytes(4, 1030, 1027);
  Image packed = plain;
  packed.pack();
  for (const auto& [x, y] : {std::pair(0, 0), {1029, 0}, {0, 1026}, {1029, 1026}, {517, 3}}) {
    for (int c = 0; c < 4; ++c) {
      const float value = plain.pixels[(static_cast<size_t>(y) * 1030 + x) * 4 + c];
      EXPECT_EQ(packed.value[packed.bytes(x, y)[c]], value) << x << ' ' << y;
    }
  }
}

TEST(Texture, DecodesSrgb) {
  Texture texture;
  texture.srgb = true;
  for (int i = 0; i <= 30000; ++i) {
    const float x = 1e-4f * static_cast<float>(i);
    const double linear =
        x <= 0.04045f ? x / 12.92 : std::pow((static_cast<double>(x) + 0.055) / 1.055, 2.4);
    EXPECT_NEAR(texture.decode(vec4(x, 0, 0, 1)).x, linear, x < 1.0f ? 3e-7 : 1e-6 * linear) << x;
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
