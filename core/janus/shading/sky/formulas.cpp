// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/shading/sky/formulas.h"

#include <algorithm>
#include <cmath>

#include "janus/shading/sky/models.h"

namespace janus {

namespace {

#include "janus/shading/sky/hosek_wilkie_x.inc"
#include "janus/shading/sky/hosek_wilkie_y.inc"
#include "janus/shading/sky/hosek_wilkie_z.inc"

using Terms = std::array<float, 9>;

struct Angles {
  float cos_zenith;      // above 0: the horizon is as far down as formulas go
  float gamma, cos_sun;  // the angle to the sun, radians
};

float perez(const Terms& t, const Angles& a) {
  return (1.0f + t[0] * std::exp(t[1] / a.cos_zenith)) *
         (1.0f + t[2] * std::exp(t[3] * a.gamma) + t[4] * sqr(a.cos_sun));
}

float hosek_wilkie(const Terms& t, const Angles& a) {
  const float rayleigh = sqr(a.cos_sun);
  const float mie =
      (1.0f + rayleigh) / std::pow(1.0f + t[8] * t[8] - 2.0f * t[8] * a.cos_sun, 1.5f);
  return (1.0f + t[0] * std::exp(t[1] / (a.cos_zenith + 0.01f))) *
         (t[2] + t[3] * std::exp(t[4] * a.gamma) + t[5] * rayleigh + t[6] * mie +
          t[7] * std::sqrt(a.cos_zenith));
}

template <class Formula>
vec3 evaluate(const SkyFormula& sky, vec3 d, Formula formula) {
  // A vector that is no direction counts by its azimuth and its z.
  const float z = std::clamp(d.z, -1.0f, 1.0f), flat = std::sqrt(d.x * d.x + d.y * d.y);
  const float r = std::sqrt(1.0f - z * z);
  const vec3 unit = flat > 0.0f ? vec3(d.x * r / flat, d.y * r / flat, z) : vec3(r, 0.0f, z);
  const float cos_sun = std::clamp(dot(unit, sky.sun), -1.0f, 1.0f);
  const Angles angles{std::max(z, 0.001f), std::acos(cos_sun), cos_sun};
  vec3 result;
  for (int i = 0; i < 3; ++i) {
    result[i] = sky.scale[i] * formula(sky.terms[i], angles);
  }
  return result;
}

// Between six control points, five for each power of the elevation.
template <int Step>
float bezier(const float* points, double x) {
  constexpr double kBinomial[] = {1, 5, 10, 10, 5, 1};
  double sum = 0.0;
  for (int i = 0; i < 6; ++i) {
    sum += kBinomial[i] * std::pow(1.0 - x, 5 - i) * std::pow(x, i) * points[i * Step];
  }
  return static_cast<float>(sum);
}

}  // namespace

SkyFormula preetham(vec3 sun, float t) {
  SkyFormula sky{sun, vec3(0.0f), {}};
  // Of Y, x and y.
  sky.terms[0] = {0.1787f * t - 1.4630f, -0.3554f * t + 0.4275f, -0.0227f * t + 5.3251f,
                  0.1206f * t - 2.5771f, -0.0670f * t + 0.3703f};
  sky.terms[1] = {-0.0193f * t - 0.2592f, -0.0665f * t + 0.0008f, -0.0004f * t + 0.2125f,
                  -0.0641f * t - 0.8989f, -0.0033f * t + 0.0452f};
  sky.terms[2] = {-0.0167f * t - 0.2608f, -0.0950f * t + 0.0092f, -0.0079f * t + 0.2102f,
                  -0.0441f * t - 1.6537f, -0.0109f * t + 0.0529f};
  const float theta = std::acos(std::clamp(sun.z, -1.0f, 1.0f));
  const float theta2 = theta * theta, theta3 = theta * theta2;
  const float chi = (4.0f / 9.0f - t / 120.0f) * (kPi - 2.0f * theta);
  const vec3 zenith(0.06f * ((4.0453f * t - 4.9710f) * std::tan(chi) - 0.2155f * t + 2.4192f),
                    (0.00166f * theta3 - 0.00375f * theta2 + 0.00209f * theta) * t * t +
                        (-0.02903f * theta3 + 0.06377f * theta2 - 0.03202f * theta + 0.00394f) * t +
                        (0.11693f * theta3 - 0.21196f * theta2 + 0.06052f * theta + 0.25886f),
                    (0.00275f * theta3 - 0.00610f * theta2 + 0.00317f * theta) * t * t +
                        (-0.04214f * theta3 + 0.08970f * theta2 - 0.04153f * theta + 0.00516f) * t +
                        (0.15346f * theta3 - 0.26756f * theta2 + 0.06670f * theta + 0.26688f));
  const Angles overhead{1.0f, theta, std::cos(theta)};
  for (int i = 0; i < 3; ++i) {
    sky.scale[i] = zenith[i] / perez(sky.terms[i], overhead);
  }
  return sky;
}

Rgb preetham_radiance(const SkyFormula& sky, vec3 direction) {
  const vec3 c = evaluate(sky, direction, perez);
  const float lum = c.x, x = c.y, y = c.z;
  const vec3 xyz = y == 0.0f ? vec3(0.0f, lum, 0.0f) : lum / y * vec3(x, y, 1.0f - x - y);
  return glm::max(xyz_to_rgb(xyz), Rgb(0.0f));
}

SkyFormula hosek_wilkie(vec3 sun, float turbidity, float albedo) {
  // A sun below the horizon stands on it, at its azimuth.
  const float height = std::max(sun.z, 0.0f), flat = glm::length(vec2(sun));
  const float r = std::sqrt(std::max(0.0f, 1.0f - height * height));
  SkyFormula sky{
      flat > 0.0f ? vec3(vec2(sun) * (r / flat), height) : vec3(0.0f, r, height), vec3(0.0f), {}};
  constexpr const float* kTerms[] = {kTermsX, kTermsY, kTermsZ};
  constexpr const float* kScale[] = {kScaleX, kScaleY, kScaleZ};
  const double x = std::cbrt(std::asin(std::min(height, 1.0f)) / (0.5 * kPi));
  turbidity = std::min(10.0f, std::max(1.0f, turbidity));  // also what is no number
  const int low = std::min(static_cast<int>(turbidity), 9);
  const float share = turbidity - static_cast<float>(low);
  for (int i = 0; i < 4; ++i) {
    const bool bright = i >= 2, hazy = i % 2 == 1;
    const float weight = (bright ? albedo : 1.0f - albedo) * (hazy ? share : 1.0f - share);
    const int set = (bright ? 10 : 0) + low - (hazy ? 0 : 1);
    for (int channel = 0; channel < 3; ++channel) {
      sky.scale[channel] += weight * bezier<1>(kScale[channel] + 6 * set, x);
      for (int term = 0; term < 9; ++term) {
        sky.terms[channel][term] += weight * bezier<9>(kTerms[channel] + 54 * set + term, x);
      }
    }
  }
  return sky;
}

Rgb hosek_wilkie_radiance(const SkyFormula& sky, vec3 direction) {
  const auto formula = [](const Terms& t, const Angles& a) { return hosek_wilkie(t, a); };
  const vec3 xyz = evaluate(sky, direction, formula);
  // From luminous units to Blender's.
  return 2.0f * kPi / 683.0f * glm::max(xyz_to_rgb(xyz), Rgb(0.0f));
}

}  // namespace janus
