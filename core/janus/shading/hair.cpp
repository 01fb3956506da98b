// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/shading/hair.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "janus/shading/fresnel.h"

namespace janus {

namespace {

constexpr float kHalfPi = 0.5f * kPi;

float other_leg(float x) { return std::sqrt(std::max(0.0f, 1.0f - x * x)); }  // cos from sin
float safe_asin(float x) { return std::asin(std::clamp(x, -1.0f, 1.0f)); }
float safe_acos(float x) { return std::acos(std::clamp(x, -1.0f, 1.0f)); }

// --- Hair BSDF -----------------------------------------------------------------------------------

// Directions around a fibre, as seen from `wo`.
struct AroundFiber {
  vec3 along, towards, beside;  // `towards`: across the fibre, to the viewer
  float theta_o;

  AroundFiber(vec3 along_fiber, vec3 wo) : along(along_fiber) {
    const float z = dot(along, wo);
    const vec3 across = wo - z * along;
    const float length = glm::length(across);
    towards = length > 0.0f ? across / length : vec3(0.0f);
    beside = cross(towards, along);
    theta_o = kHalfPi - safe_acos(z);
  }
  vec3 direction(float theta, float phi) const {
    return std::cos(theta) * (std::cos(phi) * towards - std::sin(phi) * beside) +
           std::sin(theta) * along;
  }
};

// Directions closer to the fibre's own have no density.
constexpr float kAlong = 1e-3f;

// Half angles between the view and a direction lie as in a Cauchy distribution around the tilt, cut
// where directions end.
struct Cauchy {
  float theta_o, width, tilt, first, last;

  Cauchy(const Lobe& lobe, float theta) : theta_o(theta), width(lobe.alpha), tilt(lobe.tilt) {
    last = std::atan(((kHalfPi + theta_o) * 0.5f - tilt) / width);
    first = std::atan(((-kHalfPi + theta_o) * 0.5f - tilt) / width);
  }
  float density(float theta_i) const {
    const float t = 0.5f * (theta_i + theta_o) - tilt;
    return width / (2.0f * (t * t + width * width) * (last - first) * std::cos(theta_i));
  }
  float sample(float u) const {
    return 2.0f * (width * std::tan(u * (last - first) + first) + tilt) - theta_o;
  }
};

float azimuthal_cauchy_range(float width) { return 2.0f * std::atan(kHalfPi / width); }

LobeEval evaluate_hair(const Lobe& lobe, const Directions& d) {
  const bool transmission = lobe.type == LobeType::HairTransmission;
  const AroundFiber fiber(lobe.normal, d.wo);
  const float z = dot(lobe.normal, d.wi);
  const float theta_i = kHalfPi - safe_acos(z);
  const vec3 across = d.wi - z * lobe.normal;
  const float length = glm::length(across);
  if (kHalfPi - std::abs(theta_i) < kAlong || !(length > 0.0f)) {
    return {};
  }
  const float cos_phi = dot(across / length, fiber.towards), phi = safe_acos(cos_phi);
  float around;
  if (transmission && cos_phi > 0.0f) {
    return {};
  }
  if (transmission) {
    const float p = kPi - phi, width = lobe.sigma;
    around = width / (azimuthal_cauchy_range(width) * (p * p + width * width));
  } else {
    around = std::cos(0.5f * std::min(phi / lobe.sigma, kPi)) * 0.25f / lobe.sigma;
  }
  const float pdf = around * Cauchy(lobe, fiber.theta_o).density(theta_i);
  return {lobe.weight * pdf, pdf, 0.0f};
}

vec3 sample_hair(const Lobe& lobe, vec3 wo, vec2 u) {
  const AroundFiber fiber(lobe.normal, wo);
  const float theta = Cauchy(lobe, fiber.theta_o).sample(u.x);
  const float phi =
      lobe.type == LobeType::HairTransmission
          ? kPi + lobe.sigma * std::tan(azimuthal_cauchy_range(lobe.sigma) * (u.y - 0.5f))
          : 2.0f * safe_asin(1.0f - 2.0f * u.y) * lobe.sigma;
  return fiber.direction(theta, phi);
}

// --- Chiang's model ------------------------------------------------------------------------------

// Variance along, and scale of the logistic distribution around the fibre, by roughness (Chiang et
// al. 2016, eq. 7 and 8).
float longitudinal_variance(float roughness) {
  const float r = std::clamp(roughness, 0.001f, 1.0f);
  return sqr(0.726f * r + 0.812f * r * r + 3.7f * std::pow(r, 20.0f));
}
float azimuthal_scale(float roughness) {
  const float r = std::clamp(roughness, 0.001f, 1.0f);
  return (0.265f * r + 1.194f * r * r + 5.372f * std::pow(r, 22.0f)) * std::sqrt(kPi / 8.0f);
}

// Modified Bessel function of the first kind and order 0, as a logarithm.
double log_bessel_i0(double x) {
  if (x > 12.0) {
    return x + 0.5 * (1.0 / (8.0 * x) - std::log(2.0 * std::numbers::pi) - std::log(x));
  }
  double term = 1.0, sum = 1.0;
  for (int i = 1; i < 10; ++i) {
    term *= x * x / (4.0 * i * i);
    sum += term;
  }
  return std::log(sum);
}

// d'Eon et al. 2011, eq. 7: a density in solid angle, but for the azimuth.
float longitudinal(float sin_i, float cos_i, float sin_o, float cos_o, float variance) {
  const double v = variance, inverse = 1.0 / v;
  const double log_value = log_bessel_i0(cos_i * cos_o * inverse) - sin_i * sin_o * inverse;
  // 1 / (2 v sinh(1/v)), without overflow
  return static_cast<float>(std::exp(log_value - inverse) * inverse /
                            (1.0 - std::exp(-2.0 * inverse)));
}

float logistic_cdf(float x, float s) { return 1.0f / (1.0f + std::exp(std::min(-x / s, 88.0f))); }

// On [-pi, pi].
float logistic(float x, float s) {
  const float e = std::exp(-std::abs(x) / s);
  return e / (s * sqr(1.0f + e)) / (1.0f - 2.0f * logistic_cdf(-kPi, s));
}
float sample_logistic(float u, float s) {
  const float first = logistic_cdf(-kPi, s);
  const float x = -s * std::log(1.0f / (u * (1.0f - 2.0f * first) + first) - 1.0f);
  return std::clamp(x, -kPi, kPi);
}

float wrapped(float angle) { return angle - 2.0f * kPi * std::floor((angle + kPi) / (2.0f * kPi)); }

// What the terms have in common, as seen from `wo`.
class ChiangView {
 public:
  static constexpr int kTerms = 4;  // R, TT, TRT, all after

  ChiangView(const Lobe& lobe, vec3 ng, vec3 wo) : lobe_(lobe), along_(lobe.normal) {
    const vec3 across = cross(along_, wo);
    const float length = glm::length(across);
    usable_ = length > 0.0f;
    y_ = usable_ ? across / length : vec3(0.0f);
    z_ = cross(along_, y_);
    sin_o_ = std::clamp(dot(wo, along_), -1.0f, 1.0f);
    cos_o_ = other_leg(sin_o_);
    phi_o_ = std::atan2(dot(wo, z_), dot(wo, y_));
    const vec3 n = dot(wo, ng) < 0.0f ? -ng : ng;
    const float h = std::clamp(dot(cross(n, along_), z_), -1.0f, 1.0f);
    gamma_o_ = std::asin(h);
    const float sin_gamma_t = h * cos_o_ / std::sqrt(std::max(sqr(lobe.ior) - sqr(sin_o_), 1e-6f));
    gamma_t_ = safe_asin(sin_gamma_t);
    attenuate(fresnel_dielectric(cos_o_ * other_leg(h), lobe.ior),
              glm::exp(-lobe.color * (2.0f * other_leg(sin_gamma_t) /
                                      std::max(other_leg(sin_o_ / lobe.ior), 1e-6f))));
  }

  bool usable() const { return usable_; }
  // The terms that the lobe has, and the probability of each.
  int first() const { return lobe_.type == LobeType::ChiangReflection ? 0 : 1; }
  int last() const { return lobe_.type == LobeType::ChiangReflection ? 0 : kTerms - 1; }
  Rgb attenuation(int p) const { return attenuation_[p]; }
  float pmf(int p) const { return pmf_[p]; }

  // M_p N_p for the direction `wi`.
  float density(int p, vec3 wi) const {
    const float sin_i = std::clamp(dot(wi, along_), -1.0f, 1.0f);
    const auto [sin_o, cos_o] = tilted(p);
    const float along = longitudinal(sin_i, other_leg(sin_i), sin_o, cos_o, variance(p));
    if (p == kTerms - 1) {
      return along * 0.5f * kInvPi;
    }
    const float phi = std::atan2(dot(wi, z_), dot(wi, y_)) - phi_o_;
    return along * logistic(wrapped(phi - turn(p)), lobe_.sigma);
  }

  vec3 sample(int p, float u_phi, vec2 u) const {
    const auto [sin_o, cos_o] = tilted(p);
    const float v = variance(p), x = std::max(u.x, 1e-5f);
    const float across = 1.0f + v * std::log(x + (1.0f - x) * std::exp(-2.0f / v));
    const float sin_i = std::clamp(
        -across * sin_o + other_leg(across) * std::cos(2.0f * kPi * u.y) * cos_o, -1.0f, 1.0f);
    const float phi = phi_o_ + (p == kTerms - 1 ? 2.0f * kPi * u_phi
                                                : turn(p) + sample_logistic(u_phi, lobe_.sigma));
    return sin_i * along_ + other_leg(sin_i) * (std::cos(phi) * y_ + std::sin(phi) * z_);
  }

 private:
  struct Tilted {
    float sin, cos;
  };

  // Chiang et al. 2016, eq. 12 and 13; f: of Fresnel, t: what one way through it leaves.
  void attenuate(float f, Rgb t) {
    attenuation_[0] = Rgb(f);
    attenuation_[1] = sqr(1.0f - f) * t;
    attenuation_[2] = attenuation_[1] * t * f;
    attenuation_[3] = attenuation_[2] * t * f / glm::max(1.0f - t * f, Rgb(1e-6f));
    float sum = 0.0f;
    for (int p = first(); p <= last(); ++p) {
      sum += pmf_[p] = average(attenuation_[p]);
    }
    for (int p = first(); p <= last(); ++p) {
      pmf_[p] = sum > 0.0f ? pmf_[p] / sum : (p == first() ? 1.0f : 0.0f);
    }
  }

  // How far light turns around the fibre.
  float turn(int p) const {
    return 2.0f * static_cast<float>(p) * gamma_t_ - 2.0f * gamma_o_ + static_cast<float>(p) * kPi;
  }
  float variance(int p) const {
    return p == 0 ? lobe_.alpha : (p == 1 ? 0.25f : 4.0f) * lobe_.alpha;
  }
  // The view, as the scales turn it: by -2, 1 and 4 times their tilt.
  Tilted tilted(int p) const {
    constexpr float kTurns[kTerms] = {-2.0f, 1.0f, 4.0f, 0.0f};
    const float angle = kTurns[p] * lobe_.tilt;
    const float s = std::sin(angle), c = std::cos(angle);
    return {sin_o_ * c + cos_o_ * s, std::abs(cos_o_ * c - sin_o_ * s)};
  }

  const Lobe& lobe_;
  vec3 along_, y_, z_;
  bool usable_;
  float sin_o_, cos_o_, phi_o_, gamma_o_, gamma_t_;
  Rgb attenuation_[kTerms];
  float pmf_[kTerms] = {};
};

LobeEval evaluate_chiang(const Lobe& lobe, vec3 ng, const Directions& d) {
  const ChiangView view(lobe, ng, d.wo);
  LobeEval out;
  if (!view.usable()) {
    return out;
  }
  for (int p = view.first(); p <= view.last(); ++p) {
    const float density = view.density(p, d.wi);
    out.f += view.attenuation(p) * density;
    out.pdf_radiance += view.pmf(p) * density;
  }
  out.f *= lobe.weight;
  return out;
}

}  // namespace

Lobe hair_lobe(bool transmission, Rgb weight, vec3 along, float roughness_u, float roughness_v,
               float offset) {
  Lobe lobe{};
  lobe.type = transmission ? LobeType::HairTransmission : LobeType::HairReflection;
  lobe.weight = weight;
  lobe.normal = along;
  lobe.alpha = std::clamp(roughness_u, 0.001f, 1.0f);
  lobe.sigma = std::clamp(roughness_v, 0.001f, 1.0f);
  lobe.ior = 1.0f;
  lobe.tilt = -offset;
  return lobe;
}

Lobe chiang_lobe(LobeType type, Rgb weight, vec3 along, const ChiangHair& hair) {
  Lobe lobe{};
  lobe.type = type;
  lobe.weight = weight;
  lobe.color = glm::max(hair.absorption, Rgb(0.0f));
  lobe.normal = along;
  const float roughness = std::clamp(hair.roughness, 0.001f, 1.0f);
  lobe.alpha = longitudinal_variance(type == LobeType::ChiangReflection
                                         ? (1.0f - std::clamp(hair.coat, 0.0f, 1.0f)) * roughness
                                         : roughness);
  lobe.sigma = azimuthal_scale(hair.radial_roughness);
  lobe.ior = std::max(hair.ior, 1e-3f);
  lobe.tilt = -hair.offset;
  return lobe;
}

Rgb absorption_of_color(Rgb color, float radial_roughness) {
  const float x = radial_roughness;
  const float scale =
      ((((0.245f * x + 5.574f) * x - 10.73f) * x + 2.532f) * x - 0.215f) * x + 5.969f;
  const Rgb root = glm::log(glm::max(color, Rgb(1e-20f))) / scale;
  return root * root;
}

Rgb absorption_of_melanin(float eumelanin, float pheomelanin) {
  return eumelanin * Rgb(0.506f, 0.841f, 1.653f) + pheomelanin * Rgb(0.343f, 0.733f, 1.924f);
}

Rgb fiber_color(const Lobe& lobe, vec3 ng, vec3 wo) {
  if (lobe.type == LobeType::HairReflection || lobe.type == LobeType::HairTransmission) {
    return lobe.weight;
  }
  const ChiangView view(lobe, ng, wo);
  Rgb sum(0.0f);
  for (int p = view.first(); p <= view.last() && view.usable(); ++p) {
    sum += view.attenuation(p);
  }
  return lobe.weight * sum;
}

LobeEval evaluate_fiber(const Lobe& lobe, vec3 ng, const Directions& d) {
  return lobe.type == LobeType::HairReflection || lobe.type == LobeType::HairTransmission
             ? evaluate_hair(lobe, d)
             : evaluate_chiang(lobe, ng, d);
}

std::optional<vec3> sample_fiber(const Lobe& lobe, vec3 ng, vec3 wo, float u_event, vec2 u) {
  if (lobe.type == LobeType::HairReflection || lobe.type == LobeType::HairTransmission) {
    return sample_hair(lobe, wo, u);
  }
  const ChiangView view(lobe, ng, wo);
  if (!view.usable()) {
    return std::nullopt;
  }
  int p = view.first();
  while (p < view.last() && u_event >= view.pmf(p)) {
    u_event -= view.pmf(p++);
  }
  const float u_phi = view.pmf(p) > 0.0f ? std::min(u_event / view.pmf(p), 1.0f - 0x1p-24f) : 0.0f;
  return view.sample(p, u_phi, u);
}

}  // namespace janus
