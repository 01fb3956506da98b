// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/shading/thin_film.h"

#include <gtest/gtest.h>

#include <complex>

#include "janus/shading/fresnel.h"

namespace janus::test {
namespace {

// The reflectance of a film for one wave, with all bounces: amplitudes of both polarisations.
double airy(double cos, double film, double eta, double phase) {
  const double cos2 = std::sqrt(1 - (1 - cos * cos) / (film * film));
  const double cos3 = std::sqrt(1 - (1 - cos * cos) / (eta * eta));
  double sum = 0;
  for (const bool parallel : {false, true}) {
    const auto r = [&](double n1, double c1, double n2, double c2) {
      return parallel ? (n2 * c1 - n1 * c2) / (n2 * c1 + n1 * c2)
                      : (n1 * c1 - n2 * c2) / (n1 * c1 + n2 * c2);
    };
    const double r12 = r(1, cos, film, cos2), r23 = r(film, cos2, eta, cos3);
    const std::complex<double> turned = std::polar(1.0, phase);
    sum += 0.5 * std::norm((r12 + r23 * turned) / (1.0 + r12 * r23 * turned));
  }
  return sum;
}

// A film of hundreds of wavelengths has no colour: the mean over all phases is what is left.
TEST(ThinFilm, ThickOnesAreTheMeanOverAllPhases) {
  for (const float cos : {1.0f, 0.6f, 0.2f}) {
    double mean = 0;
    for (int i = 0; i < 1000; ++i) {
      mean += airy(cos, 1.4, 1.6, 2 * 3.14159265358979 * i / 1000) / 1000;
    }
    // Path differences within the table, where hardly any interference is left.
    const Rgb seen = film_on_dielectric({9500 / (2 * 1.4f * cos), 1.4f}, cos, 1.6f);
    EXPECT_NEAR(average(seen), mean, 0.02 * mean) << cos;
  }
}

TEST(ThinFilm, NoFilmOrOneOfTheSameIndexDoesNothing) {
  for (const float cos : {1.0f, 0.5f, 0.1f}) {
    const float plain = fresnel_dielectric(cos, 1.5f);
    EXPECT_NEAR(film_on_dielectric({300, 1.5f}, cos, 1.5f).x, plain, 1e-5);
    EXPECT_NEAR(film_on_dielectric({300, 1.0f}, cos, 1.5f).y, plain, 1e-5);
    EXPECT_NEAR(film_on_conductor({300, 1.0f}, cos, Rgb(0.2f), Rgb(3)).z,
                fresnel_conductor(cos, 0.2f, 3), 1e-5);
  }
}

// Light on its way in and out sees the same film, if lengths are taken for what they are.
TEST(ThinFilm, IsTheSameFromBothEnds) {
  for (const float thickness : {0.5f, 120.0f, 450.0f, 2000.0f}) {
    for (const float cos : {1.0f, 0.7f, 0.3f}) {
      for (const float eta : {1.5f, 2.2f}) {
        const float cos_t = std::sqrt(1 - (1 - cos * cos) / (eta * eta));
        const Rgb a = film_on_dielectric({thickness, 1.8f}, cos, eta);
        const Rgb b = film_on_dielectric({thickness * eta, 1.8f / eta}, cos_t, 1 / eta);
        if (thickness >= 1) {  // below, each end blends its own index
          EXPECT_NEAR(glm::length(a - b), 0, 1e-5) << thickness << " " << cos << " " << eta;
        }
        EXPECT_GE(std::min({a.x, a.y, a.z}), 0.0f);
        EXPECT_LE(max_component(a), 1.0f);
      }
    }
  }
  EXPECT_EQ(film_on_dielectric({300, 1.2f}, 0.2f, 1 / 1.5f), Rgb(1));  // total reflection
}

// Half a wave of difference: glass with a film of a quarter is dark where it is lit by that wave.
TEST(ThinFilm, ColoursComeAndGoWithThickness) {
  const Rgb dark = film_on_dielectric({550 / (4 * 1.22f), 1.22f}, 1, 1.5f);
  EXPECT_LT(dark.y, 0.25f * fresnel_dielectric(1, 1.5f));
  const Rgb bright = film_on_dielectric({550 / (2 * 1.22f), 1.22f}, 1, 1.5f);
  EXPECT_GT(bright.y, 0.8f * fresnel_dielectric(1, 1.5f));
  const Rgb metal = film_on_metal({300, 1.4f}, 0.8f, Rgb(0.9f, 0.7f, 0.4f), Rgb(0.9f));
  EXPECT_GT(glm::length(metal - film_on_metal({420, 1.4f}, 0.8f, Rgb(0.9f, 0.7f, 0.4f), Rgb(0.9f))),
            0.05f);
}

}  // namespace
}  // namespace janus::test
