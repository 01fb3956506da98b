// SPDX-License-Identifier: GPL-3.0-or-later
//
// The models of the sky. That they are Cycles' is tested with pictures (tests/images).
#include <gtest/gtest.h>

#include "janus/math/exp.h"
#include "janus/shading/sky/atmosphere.h"
#include "janus/shading/sky/formulas.h"
#include "light/light_cases.h"
#include "shading/compiled.h"

namespace janus::test {
namespace {

using Model = Atmosphere::Model;

TEST(ExpOf, IsPrecise) {
  for (float x = -86.0f; x < 86.0f; x += 0.0371f) {
    EXPECT_NEAR(exp_of(x) / std::exp(static_cast<double>(x)), 1.0, 2.5e-7) << x;
  }
  EXPECT_EQ(exp_of(0.0f), 1.0f);
  EXPECT_LT(exp_of(-1e9f), 1e-37f);
}

Rgb pixel(const Image& image, int x, int y) {
  const float* p = &image.pixels[3 * (static_cast<size_t>(y) * image.width + x)];
  return {p[0], p[1], p[2]};
}

TEST(Atmosphere, IsBlueAboveAndKept) {
  for (const Model model : {Model::SingleScattering, Model::Nishita, Model::MultipleScattering}) {
    const Atmosphere clear{model, 0.5f, 100.0f};
    const auto picture = sky_picture(clear);
    EXPECT_EQ(picture, sky_picture(clear));
    EXPECT_NE(picture, sky_picture({model, 0.51f, 100.0f}));
    const Rgb zenith = pixel(*picture, 10, picture->height - 1);
    EXPECT_GT(zenith.z, 2 * zenith.x);
    // The left half is the right one, and the sun is in the middle.
    const int row = picture->height * 3 / 4;
    EXPECT_EQ(pixel(*picture, 20, row), pixel(*picture, 491, row));
    EXPECT_GT(luminance(pixel(*picture, 255, row)), 2 * luminance(pixel(*picture, 0, row)));
  }
}

TEST(Atmosphere, SunReddensTowardsTheHorizon) {
  for (const Model model : {Model::SingleScattering, Model::MultipleScattering}) {
    const Atmosphere clear{model, 0.5f, 100.0f};
    const Rgb high = sun_irradiance(clear, 1.4f), low = sun_irradiance(clear, 0.05f);
    EXPECT_NEAR(luminance(high), 170, 20);  // Cycles' W/m^2 on a clear day
    EXPECT_GT(luminance(high), 3 * luminance(low));
    EXPECT_GT(low.x / low.z, 3 * high.x / high.z);
    // Without air, all of it arrives.
    const Rgb none = sun_irradiance({model, 0.5f, 100.0f, 0, 0, 0}, 0.05f);
    EXPECT_GT(luminance(none), luminance(high));
  }
}

TEST(SkyFormulas, AreBrightAtTheSun) {
  const vec3 sun = normalize(vec3(0.5f, 0.2f, 0.5f));
  const vec3 away(-sun.x, -sun.y, sun.z);
  const SkyFormula a = preetham(sun, 3.0f), b = hosek_wilkie(sun, 3.0f, 0.3f);
  EXPECT_GT(luminance(preetham_radiance(a, sun)), 2 * luminance(preetham_radiance(a, away)));
  EXPECT_GT(luminance(hosek_wilkie_radiance(b, sun)),
            2 * luminance(hosek_wilkie_radiance(b, away)));
  // A bright ground lights the sky.
  EXPECT_GT(luminance(hosek_wilkie_radiance(hosek_wilkie(sun, 3.0f, 1.0f), away)),
            luminance(hosek_wilkie_radiance(b, away)));
}

TEST(SkyTexture, NamesAModelThatItDoesNotHave) {
  EXPECT_TRUE(warned(compiled(sky_texture("PRAGUE")), "Sky", "PRAGUE"));
  for (const char* model :
       {"SINGLE_SCATTERING", "MULTIPLE_SCATTERING", "NISHITA", "PREETHAM", "HOSEK_WILKIE"}) {
    EXPECT_TRUE(compiled(sky_texture(model)).diagnostics.empty()) << model;
  }
}

}  // namespace
}  // namespace janus::test
