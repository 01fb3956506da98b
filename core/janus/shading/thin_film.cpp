// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/shading/thin_film.h"

#include <complex>
#include <cstdint>

#include "janus/shading/fresnel.h"
#include "janus/shading/table_lookup.h"

namespace janus {

namespace {

#include "janus/shading/thin_film_table.inc"

constexpr int kSize = 512;
constexpr float kUnit = 1e-6f, kRange = 60000.0f;

// By polarisation: senkrecht, parallel.
template <class T>
struct Polarized {
  T s, p;
};

// Of a channel, for a path difference in nanometres.
std::complex<float> sensitivity(int channel, float difference) {
  const Place<kSize> at(2.0f * kPi * difference / kRange);
  return kUnit * std::complex(read(kReal[channel], at), read(kImaginary[channel], at));
}

// Where light meets a dielectric: the signed amplitudes of what is reflected, and the cosine behind
// it. Nothing goes through where `total`.
struct Interface {
  Polarized<float> amplitude{1.0f, 1.0f};
  float cos_t = 0.0f;
  bool total = true;

  Interface(float cos, float eta) {
    const float cos2_t = 1.0f - (1.0f - sqr(cos)) / sqr(eta);
    if (!(cos2_t > 0.0f)) {
      return;
    }
    total = false;
    cos_t = std::sqrt(cos2_t);
    amplitude = {(cos - eta * cos_t) / (cos + eta * cos_t),
                 (eta * cos - cos_t) / (eta * cos + cos_t)};
  }
};

// What a metal reflects within a medium: how much, and with which phase.
struct MetalInterface {
  float reflectance;
  std::complex<float> phasor;
};

// Born & Wolf, "Principles of Optics", section 14.4.1, for an index n + i k.
Polarized<MetalInterface> metal_interface(float cos, float medium, float n, float k) {
  const float n2 = sqr(n), k2 = sqr(k), m2 = sqr(medium);
  const float a = n2 - k2 - m2 * (1.0f - sqr(cos)), b = std::sqrt(sqr(a) + 4.0f * n2 * k2);
  const float u2 = std::max(0.0f, 0.5f * (b + a)), v2 = std::max(0.0f, 0.5f * (b - a));
  const float u = std::sqrt(u2), v = std::sqrt(v2), c = medium * cos;
  const auto ratio = [](float x, float y) { return y != 0.0f ? x / y : 0.0f; };
  const auto phasor = [](float re, float im) {
    const float size = std::hypot(re, im);
    return size > 0.0f ? std::complex(re / size, im / size) : std::complex(1.0f, 0.0f);
  };
  const float x = (n2 - k2) * cos, y = 2.0f * n * k * cos;
  return {
      {ratio(sqr(c - u) + v2, sqr(c + u) + v2), phasor(sqr(c) - u2 - v2, -2.0f * c * v)},
      {ratio(sqr(x - medium * u) + sqr(y - medium * v), sqr(x + medium * u) + sqr(y + medium * v)),
       phasor(sqr((n2 + k2) * cos) - m2 * (u2 + v2),
              2.0f * c * (2.0f * n * k * u - (n2 - k2) * v))}};
}

// Belcour & Barla 2017, eq. 10, up to the third order. `front`, `back`: reflectances of the film's
// two sides; `phasor`: of both reflections within it.
float airy_sum(int channel, float front, float back, float difference, std::complex<float> phasor) {
  const float both = front * back, first = sqr(1.0f - front) * back / (1.0f - both);
  float sum = first + front, factor = first - (1.0f - front);
  std::complex<float> turned(1.0f, 0.0f);
  for (int m = 1; m < 4; ++m) {
    factor *= std::sqrt(both);
    turned *= phasor;
    const std::complex<float> s = sensitivity(channel, static_cast<float>(m) * difference);
    sum += 2.0f * factor * (turned.real() * s.real() + turned.imag() * s.imag());
  }
  return sum;
}

// A film, and the light that has entered it.
struct Within {
  float ior, difference;
  Interface front;

  Within(ThinFilm film, float cos) : ior(blended_index(film)), front(cos, ior) {
    difference = 2.0f * ior * film.thickness * front.cos_t;
  }
  // Below a nanometre waves say nothing any more.
  static float blended_index(ThinFilm film) {
    const float t = film.thickness;
    return t < 1.0f ? 1.0f + (film.ior - 1.0f) * t * t * (3.0f - 2.0f * t) : film.ior;
  }
  float sum(int channel, const Polarized<MetalInterface>& back) const {
    const auto one = [&](float amplitude, const MetalInterface& b) {
      const float sign = amplitude >= 0.0f ? -1.0f : 1.0f;  // from within
      return airy_sum(channel, sqr(amplitude), b.reflectance, difference, sign * b.phasor);
    };
    const float mean = 0.5f * (one(front.amplitude.s, back.s) + one(front.amplitude.p, back.p));
    return std::clamp(mean, 0.0f, 1.0f);
  }
};

}  // namespace

Rgb film_on_dielectric(ThinFilm film, float cos, float eta) {
  const Within within(film, cos);
  if (within.front.total) {
    return Rgb(1.0f);
  }
  const Interface back(within.front.cos_t, eta / within.ior);
  if (back.total) {
    return Rgb(1.0f);
  }
  const auto real = [](float amplitude) {
    return MetalInterface{sqr(amplitude), amplitude >= 0.0f ? 1.0f : -1.0f};
  };
  const Polarized<MetalInterface> behind{real(back.amplitude.s), real(back.amplitude.p)};
  return {within.sum(0, behind), within.sum(1, behind), within.sum(2, behind)};
}

Rgb film_on_conductor(ThinFilm film, float cos, Rgb n, Rgb k) {
  const Within within(film, cos);
  Rgb out(1.0f);
  for (int c = 0; c < 3 && !within.front.total; ++c) {
    out[c] = within.sum(c, metal_interface(within.front.cos_t, within.ior, n[c], k[c]));
  }
  return out;
}

Rgb film_on_metal(ThinFilm film, float cos, Rgb f0, Rgb at_edge) {
  const Within within(film, cos);
  Rgb out(1.0f);
  for (int c = 0; c < 3 && !within.front.total; ++c) {
    const float r = std::min(f0[c], 0.999f), root = std::sqrt(r);
    const float n =
        (1.0f + root) / (1.0f - root) * (1.0f - at_edge[c]) + (1.0f - r) / (1.0f + r) * at_edge[c];
    const float k = std::sqrt(std::max(0.0f, (r * sqr(n + 1.0f) - sqr(n - 1.0f)) / (1.0f - r)));
    const float cos_t = within.front.cos_t;
    Polarized<MetalInterface> back = metal_interface(cos_t, within.ior, n, k);
    // In the film the metal reflects less straight on, and at the edge as before.
    const float m = n / within.ior, k2 = sqr(k / within.ior);
    const float straight = (sqr(m - 1.0f) + k2) / (sqr(m + 1.0f) + k2);
    const float factor = edge_factor(straight, at_edge[c]);
    const float reflectance = tinted_schlick(cos_t, straight, factor);
    back.s.reflectance = back.p.reflectance = reflectance;
    out[c] = within.sum(c, back);
  }
  return out;
}

}  // namespace janus
