// SPDX-License-Identifier: GPL-3.0-or-later
//
// Light that is scattered once on its way from the sun (Nishita et al. 1993, "Display of the Earth
// Taking into Account Atmospheric Scattering"), with the constants and steps of Cycles. Lengths are
// metres, and positions seen from the middle of the Earth.
#include <algorithm>
#include <cmath>

#include "janus/math/exp.h"
#include "janus/shading/sky/models.h"

namespace janus {

namespace {

#include "janus/shading/sky/spectra.inc"

constexpr int kWavelengths = 21;
constexpr float kNanometres = 20.0f;  // between them
constexpr float kGround = 6360e3f, kTop = 6420e3f;
constexpr float kAerosolScatters = 2e-5f, kAerosolDims = 1.11f * kAerosolScatters;  // 1/m
constexpr float kForward = 0.76f;  // how much aerosols scatter ahead
constexpr int kSteps = 32;         // along a ray

// Shares of a ray's length, from the sum over which its density follows.
struct Node {
  float place, weight;
};
// Gauss and Laguerre's quadrature of order 8, for what falls exponentially: nodes over 25, weights
// times e^node.
constexpr Node kLaguerre[] = {
    {0.006811185292f, 0.01750893642f}, {0.03614807107f, 0.04135477391f},
    {0.09004346519f, 0.06678839063f},  {0.1706680068f, 0.09507698807f},
    {0.2818362161f, 0.1283416365f},    {0.4303406404f, 0.1707430204f},
    {0.6296271457f, 0.2327233347f},    {0.9145252695f, 0.3562490486f},
};
// Of air, aerosols and ozone at a place: shares of where they are densest.
vec3 density(vec3 p) {
  const float height = glm::length(p) - kGround;
  return vec3(exp_of(-height / 8e3f), exp_of(-height / 1.2e3f),
              std::max(0.0f, 1.0f - std::abs(height - 25e3f) / 15e3f));
}

// From a place in the air to its end.
float length_in_air(vec3 p, vec3 direction) {
  const float b = dot(p, direction);
  return -b + std::sqrt(b * b - (length2(p) - kTop * kTop));
}

bool behind_earth(vec3 p, vec3 sun) {
  const float b = dot(p, sun);
  return sun.z < 0.0f && b * b >= length2(p) - kGround * kGround;
}

// The integral of the density from a place to the end of the air, by the metre.
vec3 depth(vec3 p, vec3 direction) {
  const float length = length_in_air(p, direction);
  vec3 sum(0.0f);
  for (const Node& node : kLaguerre) {
    sum += node.weight * density(p + node.place * length * direction);
  }
  return length * sum;
}

vec3 at_azimuth(float elevation, float azimuth) {
  return vec3(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
              std::sin(elevation));
}

struct Spectrum {
  float of[kWavelengths] = {};

  Rgb color() const {
    vec3 xyz(0.0f);
    for (int i = 0; i < kWavelengths; ++i) {
      xyz += of[i] * kIrradiance[i] * vec3(kMatching[i][0], kMatching[i][1], kMatching[i][2]);
    }
    return xyz_to_rgb(kNanometres * xyz);
  }
};

class SingleScattering {
 public:
  explicit SingleScattering(const Atmosphere& a)
      : densities_(a.air, a.aerosols, a.ozone),
        eye_(0.0f, 0.0f, kGround + std::clamp(a.altitude, 1.0f, 59999.0f)),
        sun_(at_azimuth(a.sun_elevation, 0.0f)) {}

  Rgb radiance(vec3 direction) const {
    const float mu = dot(direction, sun_), g2 = kForward * kForward;
    // Phase functions: Rayleigh's, and that of Cornette and Shanks.
    const float by_air = 0.1875f * kInvPi * (1.0f + mu * mu);
    const float by_aerosols = 0.375f * kInvPi * (1.0f - g2) * (1.0f + mu * mu) /
                              ((2.0f + g2) * std::pow(1.0f + g2 - 2.0f * kForward * mu, 1.5f));
    const float step = length_in_air(eye_, direction) / kSteps;
    Spectrum found;
    vec3 passed(0.0f);  // density, integrated from the eye
    vec3 p = eye_ + 0.5f * step * direction;
    for (int i = 0; i < kSteps; ++i, p += step * direction) {
      const vec3 here = densities_ * density(p);
      passed += step * here;
      if (behind_earth(p, sun_)) {
        continue;
      }
      const vec3 on_way = passed + densities_ * depth(p, sun_);
      const float air = step * by_air * here.x;
      const float aerosols = step * by_aerosols * here.y * kAerosolScatters;
      for (int k = 0; k < kWavelengths; ++k) {
        const float dimmed =
            on_way.x * kAirScatters[k] + on_way.y * kAerosolDims + on_way.z * kOzoneAbsorbs[k];
        found.of[k] += exp_of(-dimmed) * (air * kAirScatters[k] + aerosols);
      }
    }
    return found.color();
  }

  // As in Cycles, ozone does not dim it.
  Rgb sun(float elevation) const {
    const vec3 on_way = densities_ * depth(eye_, at_azimuth(elevation, 0.0f));
    Spectrum left;
    for (int k = 0; k < kWavelengths; ++k) {
      left.of[k] = exp_of(-(on_way.x * kAirScatters[k] + on_way.y * kAerosolDims));
    }
    return left.color();
  }

  HalfRow row(float elevation) const {
    HalfRow colors;
    for (int x = 0; x < kSkyColumns / 2; ++x) {
      const float azimuth = 2.0f * kPi / kSkyColumns * static_cast<float>(x) - kPi;
      colors[x] = radiance(at_azimuth(elevation, azimuth));
    }
    return colors;
  }

 private:
  vec3 densities_, eye_, sun_;
};

}  // namespace

Image single_scattering_picture(const Atmosphere& atmosphere) {
  constexpr int kHorizon = kSkyRows / 2;
  const SingleScattering model(atmosphere);
  const auto elevation = [](int row) {
    return 0.5f * kPi * sqr(static_cast<float>(row) / kHorizon - 1.0f);
  };
  Image picture =
      mirrored_picture(kSkyRows, kHorizon, [&](int row) { return model.row(elevation(row)); });
  // Below it the horizon fades to black.
  constexpr size_t kRow = 3 * static_cast<size_t>(kSkyColumns);
  for (int row = 0; row < kHorizon; ++row) {
    const float left = std::max(0.0f, 1.0f - 2.5f * std::sin(elevation(row)));
    const float* horizon = &picture.pixels[kHorizon * kRow];
    std::transform(horizon, horizon + kRow, &picture.pixels[row * kRow],
                   [&](float x) { return left * left * left * x; });
  }
  return picture;
}

Image nishita_picture(const Atmosphere& atmosphere) {
  constexpr int kRows = kSkyRows / 2;
  const SingleScattering model(atmosphere);
  return mirrored_picture(kRows, 0, [&](int row) {
    return model.row(0.5f * kPi * (1.0f + 0.5f / kRows) * sqr(static_cast<float>(row) / kRows));
  });
}

Rgb single_scattering_sun(const Atmosphere& atmosphere, float elevation) {
  return SingleScattering(atmosphere).sun(elevation);
}

}  // namespace janus
