// SPDX-License-Identifier: GPL-3.0-or-later
//
// Light that is scattered any number of times: the first time along the ray, and later ones by a
// fit to the Earth's air (Garcia Linan 2022, "Real-time rendering of atmospheric scattering"), with
// the constants, steps and tables of Cycles. Lengths are kilometres, positions are seen from the
// middle of the Earth; spectra are four numbers, at 630, 560, 490 and 430 nm.
#include <algorithm>
#include <cmath>
#include <vector>

#include "janus/math/exp.h"
#include "janus/shading/sky/models.h"

namespace janus {

namespace {

using Spectrum = vec4;

constexpr float kGround = 6371.0f, kThickness = 100.0f, kTop = kGround + kThickness;
constexpr int kSteps = 64;  // along a ray

const Spectrum kIrradiance(1.679f, 1.828f, 1.986f, 1.307f);  // W/m^2/nm
// By the kilometre, where they are densest: what the air scatters, what ozone absorbs (of a mean
// thickness of 334.5 Dobson units), and what aerosols of a town scatter and absorb, by the
// particle.
const Spectrum kAirScatters(6.605e-3f, 1.067e-2f, 1.842e-2f, 3.156e-2f);
const Spectrum kOzoneAbsorbs = 334.5f * Spectrum(3.472e-25f, 3.914e-25f, 1.349e-25f, 11.03e-27f);
const Spectrum kAerosolScatters(1.5908e-22f, 1.7711e-22f, 2.0942e-22f, 2.4033e-22f);
const Spectrum kAerosolAbsorbs(2.8722e-24f, 4.6168e-24f, 7.9706e-24f, 1.3578e-23f);
constexpr float kAlbedo = 0.3f;   // of the ground
constexpr float kForward = 0.8f;  // how much aerosols scatter ahead
// XYZ of the four.
const vec3 kXyz[] = {{53.386917738564668023f, 22.981337506691024754f, 0.0f},
                     {43.904844466369358263f, 71.347795700053393866f, 0.102506867965741307f},
                     {1.6137278251608962005f, 18.422960591455485011f, 31.742921188390805758f},
                     {20.762668673810577145f, 2.3614213523314368527f, 110.48009643252140334f}};

Rgb color_of(const Spectrum& spectrum) {
  vec3 xyz(0.0f);
  for (int i = 0; i < 4; ++i) {
    xyz += spectrum[i] * kXyz[i];
  }
  return xyz_to_rgb(xyz);
}

Spectrum exp_of(const Spectrum& x) {
  return {janus::exp_of(x.x), janus::exp_of(x.y), janus::exp_of(x.z), janus::exp_of(x.w)};
}

// Along a ray, to the next place where it crosses a sphere around the middle; negative: nowhere.
// In floats, as in Cycles: how low the horizon seems depends on the rounding.
float to_sphere(vec3 p, vec3 direction, float radius) {
  const float b = dot(p, direction), c = length2(p) - radius * radius, d = b * b - c;
  if ((c > 0.0f && b > 0.0f) || d < 0.0f) {
    return -1.0f;
  }
  return d >= b * b ? -b + std::sqrt(d) : -b - std::sqrt(d);
}

// Numbers on even steps over [0, 1], with straight lines in between. What is no number is 0.
struct Place {
  int low, high;
  float share;  // of the upper one

  Place(float x, int count) {
    const float at = static_cast<float>(count - 1) * std::min(1.0f, std::max(0.0f, x));
    low = static_cast<int>(at);
    high = std::min(low + 1, count - 1);
    share = at - static_cast<float>(low);
  }
};

class Air {
 public:
  explicit Air(const Atmosphere& a) : densities_(a.air, a.aerosols, a.ozone) {
    for (int i = 0; i <= kHeights; ++i) {
      const float h = kThickness * static_cast<float>(i) / kHeights;
      const float log_h = std::log(std::max(h, 1e-4f));
      shares_.emplace_back(std::exp(-0.07771971f * std::pow(h, 1.16364243f)),
                           1.3681e20f * (std::exp(-h / 0.73f) + 2e6f / 1.3681e20f),
                           3.78547397e20f * std::exp(-sqr(log_h - 3.22261f) * 5.55555555f - log_h));
    }
  }

  struct Point {
    Spectrum air, aerosols;  // what they scatter
    Spectrum dims;           // what all of it scatters and absorbs
  };
  Point at(float height) const {
    const Place place(height / kThickness, kHeights + 1);
    const vec3 here = densities_ * glm::mix(shares_[place.low], shares_[place.high], place.share);
    Point point{here.x * kAirScatters, here.y * kAerosolScatters, {}};
    point.dims = point.air + point.aerosols + here.y * kAerosolAbsorbs + here.z * kOzoneAbsorbs;
    return point;
  }

  // From a height, as a share of the air's thickness, to its end.
  Spectrum transmittance(float cos_zenith, float height) const {
    const vec3 direction(-std::sqrt(1.0f - cos_zenith * cos_zenith), 0.0f, cos_zenith);
    const vec3 p(0.0f, 0.0f, kGround + height * (kTop - kGround));
    const float step = to_sphere(p, direction, kTop) / kSteps;
    Spectrum sum(0.0f);
    for (int i = 0; i < kSteps; ++i) {
      const vec3 q = p + (static_cast<float>(i) + 0.5f) * step * direction;
      sum += step * at(std::max(glm::length(q) - kGround, 0.0f)).dims;
    }
    return exp_of(-sum);
  }

 private:
  // So fine that straight lines are 3e-5 off at most, at the aerosols.
  static constexpr int kHeights = 8192;
  vec3 densities_;
  std::vector<vec3> shares_;  // of air, aerosols and ozone
};

float clamped_altitude(const Atmosphere& a) {
  return std::clamp(a.altitude, 1.0f, 99999.0f) / 1000.0f;
}

class MultipleScattering {
 public:
  explicit MultipleScattering(const Atmosphere& a)
      : air_(a), eye_(0.0f, 0.0f, kGround + clamped_altitude(a)) {
    const float cos_sun = std::cos(0.5f * kPi - a.sun_elevation);
    sun_ = vec3(-std::sqrt(1.0f - cos_sun * cos_sun), 0.0f, cos_sun);
    to_sun_.reserve(kCosines * kLevels);
    for (int y = 0; y < kLevels; ++y) {
      for (int x = 0; x < kCosines; ++x) {
        to_sun_.push_back(air_.transmittance(
            static_cast<float>(x) / static_cast<float>(kCosines - 1) * 2.0f - 1.0f,
            static_cast<float>(y) / static_cast<float>(kLevels - 1)));
      }
    }
  }

  HalfRow row(float elevation) const;

 private:
  // A step of a ray: what is the same for all azimuths.
  struct Step {
    float distance, radius;
    Place level{0.0f, kLevels};
    Air::Point air;
    Spectrum from_ground;  // twice scattered, by way of the ground, for a sun overhead
    Spectrum gathers;      // for each unit that the step scatters to the eye
  };
  std::array<Step, kSteps> steps(vec3 direction) const;

  const Spectrum& entry(int level, int cosine) const {
    return to_sun_[static_cast<size_t>(level) * kCosines + cosine];
  }
  Spectrum along(int level, const Place& cosine) const {
    return glm::mix(entry(level, cosine.low), entry(level, cosine.high), cosine.share);
  }
  Spectrum overhead(const Place& level) const {
    return glm::mix(entry(level.low, kCosines - 1), entry(level.high, kCosines - 1), level.share);
  }

  static constexpr int kCosines = 256, kLevels = 64;
  Air air_;
  vec3 eye_, sun_;
  std::vector<Spectrum> to_sun_;  // transmittance from a level, by the cosine to the zenith
};

std::array<MultipleScattering::Step, kSteps> MultipleScattering::steps(vec3 direction) const {
  const float ground = to_sphere(eye_, direction, kGround);
  const float length = ground < 0.0f ? to_sphere(eye_, direction, kTop) : ground;
  const float dt = length / kSteps;
  std::array<Step, kSteps> steps;
  Spectrum passed(1.0f);  // transmittance from the eye
  for (int i = 0; i < kSteps; ++i) {
    Step& step = steps[i];
    step.distance = (static_cast<float>(i) + 0.5f) * dt;
    step.radius = glm::length(eye_ + step.distance * direction);
    const float height = std::max(step.radius - kGround, 0.0f);
    step.level = Place(height / kThickness, kLevels);
    step.air = air_.at(height);
    // The solid angle of the Earth; the way to it is a part of that to the sun.
    const float cos_edge = std::sqrt(std::max(0.0f, 1.0f - sqr(kGround / step.radius)));
    const float omega = 2.0f * kPi * (1.0f - cos_edge);
    step.from_ground = 0.25f * kInvPi * omega * (kAlbedo * kInvPi) *
                       overhead(Place(0.0f, kLevels)) / overhead(step.level);
    // The integral over the step of what is scattered evenly in it (Hillaire 2015).
    const Spectrum left = exp_of(-dt * step.air.dims);
    step.gathers = passed * (1.0f - left) / glm::max(step.air.dims, Spectrum(1e-7f));
    passed *= left;
  }
  return steps;
}

HalfRow MultipleScattering::row(float elevation) const {
  const float z = std::sin(elevation), flat = std::cos(elevation);
  const auto steps = this->steps(vec3(flat, 0.0f, z));
  HalfRow colors;
  for (int x = 0; x < kSkyColumns / 2; ++x) {
    const float azimuth = 2.0f * kPi * (static_cast<float>(x) + 0.5f) / kSkyColumns;
    const vec3 direction(flat * std::cos(azimuth), flat * std::sin(azimuth), z);
    const float mu = dot(direction, sun_), g2 = kForward * kForward;
    // Phase functions: Rayleigh's, and that of Henyey and Greenstein.
    const float by_air = 0.1875f * kInvPi * (1.0f + mu * mu);
    const float spread = 1.0f + g2 - 2.0f * kForward * mu;
    const float by_aerosols = 0.25f * kInvPi * (1.0f - g2) / (spread * std::sqrt(spread));
    Spectrum found(0.0f);
    for (const Step& step : steps) {
      const float cos_sun = dot(eye_ + step.distance * direction, sun_) / step.radius;
      const Place cosine(0.5f * cos_sun + 0.5f, kCosines);
      const Spectrum sun =
          glm::mix(along(step.level.low, cosine), along(step.level.high, cosine), step.level.share);
      // From elsewhere in the air; its colour is that of all that has been scattered often.
      const Spectrum from_air = 0.02f * Spectrum(0.217f, 0.347f, 0.594f, 1.0f) /
                                (1.0f + 5.0f * janus::exp_of(-17.92f * cos_sun));
      const Spectrum often = from_air + cos_sun * step.from_ground * along(0, cosine);
      found += step.gathers * (step.air.air * (by_air * sun + often) +
                               step.air.aerosols * (by_aerosols * sun + often));
    }
    colors[x] = color_of(kIrradiance * found);
  }
  return colors;
}

}  // namespace

Image multiple_scattering_picture(const Atmosphere& atmosphere) {
  const MultipleScattering model(atmosphere);
  return mirrored_picture(kSkyRows, 0, [&](int row) {
    const float x = (static_cast<float>(row) + 0.5f) / kSkyRows * 2.0f - 1.0f;
    return model.row(std::copysign(0.5f * kPi * x * x, x));
  });
}

Rgb multiple_scattering_sun(const Atmosphere& atmosphere, float elevation) {
  const Air air(atmosphere);
  return color_of(kIrradiance * air.transmittance(std::cos(0.5f * kPi - elevation),
                                                  clamped_altitude(atmosphere) / kThickness));
}

}  // namespace janus
