// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "janus/math/vec.h"

namespace janus {

// Reflectance of a smooth dielectric for unpolarised light. `cos_i` >= 0 on the incident side,
// `eta` = index of the transmitted side / index of the incident side.
inline float fresnel_dielectric(float cos_i, float eta) {
  const float sin2_t = (1.0f - cos_i * cos_i) / (eta * eta);
  if (sin2_t >= 1.0f) {
    return 1.0f;
  }
  const float cos_t = std::sqrt(1.0f - sin2_t);
  const float parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
  const float perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
  return 0.5f * (parallel * parallel + perpendicular * perpendicular);
}

// Reflectance of a dielectric at normal incidence, F0, and the index > 1 that has it.
inline float fresnel_normal(float eta) { return sqr((eta - 1.0f) / (eta + 1.0f)); }
inline float index_from_fresnel_normal(float f0) {
  const float root = std::sqrt(std::clamp(f0, 0.0f, 0.99f));
  return (1.0f + root) / (1.0f - root);
}

// The reflectance of Cycles' dielectric closures: never less than straight on. Real ones of an
// index above 4 or so dip below it towards Brewster's angle.
inline float fresnel_closure(float cos_i, float eta) {
  return std::max(fresnel_dielectric(cos_i, eta), fresnel_normal(eta));
}

// Reflectance averaged over the hemisphere (weight 2 cos): a fit by Kulla & Conty, "Revisiting
// Physically Based Shading at Imageworks" (2017), which Cycles uses.
inline float fresnel_dielectric_average(float eta) {
  if (eta < 1.0f) {
    return 0.997118f + eta * (0.1014f - eta * (0.965241f + eta * 0.130607f));
  }
  return (eta - 1.0f) / (4.08567f + 1.00071f * eta);
}

// (1 - cos)^5, the shape of Schlick's approximation.
inline float schlick(float cos) {
  const float m = std::clamp(1.0f - cos, 0.0f, 1.0f);
  return sqr(sqr(m)) * m;
}

// What the tint of a metal's edge scales: cos (1 - cos)^6, largest near 82 degrees (Kutz et al.,
// "Novel Aspects of the Adobe Standard Material", 2021).
inline float edge_term(float cos) {
  return cos * schlick(cos) * std::clamp(1.0f - cos, 0.0f, 1.0f);
}

// Schlick's term, without that times `factor`; and the factor with which it is `at_edge` where the
// cosine is 1/7. Numbers or colours.
constexpr float kEdgeCosine = 1.0f / 7.0f;
template <class T>
T tinted_schlick(float cos, T f0, T factor) {
  return glm::clamp(f0 + (1.0f - f0) * schlick(cos) - factor * edge_term(cos), T(0.0f), T(1.0f));
}
template <class T>
T edge_factor(T f0, T at_edge) {
  return (f0 + (1.0f - f0) * schlick(kEdgeCosine) - at_edge) / edge_term(kEdgeCosine);
}

// Reflectance of a metal of the index n + i k, in air, for unpolarised light (Born & Wolf,
// "Principles of Optics", section 14.4.1).
inline float fresnel_conductor(float cos_i, float n, float k) {
  const float n2 = sqr(n), k2 = sqr(k), sin2 = 1.0f - sqr(cos_i);
  const float a = n2 - k2 - sin2, b = std::sqrt(sqr(a) + 4.0f * n2 * k2);
  const float u2 = std::max(0.0f, 0.5f * (b + a)), v2 = std::max(0.0f, 0.5f * (b - a));
  const float u = std::sqrt(u2), v = std::sqrt(v2);
  const auto ratio = [](float x, float y) { return y > 0.0f ? x / y : 0.0f; };
  const float s = ratio(sqr(cos_i - u) + v2, sqr(cos_i + u) + v2);
  const float x = (n2 - k2) * cos_i, y = 2.0f * n * k * cos_i;
  const float p = ratio(sqr(x - u) + sqr(y - v), sqr(x + u) + sqr(y + v));
  return 0.5f * (s + p);
}
inline Rgb fresnel_conductor(float cos_i, Rgb n, Rgb k) {
  return {fresnel_conductor(cos_i, n.x, k.x), fresnel_conductor(cos_i, n.y, k.y),
          fresnel_conductor(cos_i, n.z, k.z)};
}

// Mirrors `w` (pointing away from the surface) about unit `n`.
inline vec3 reflect_about(vec3 w, vec3 n) { return 2.0f * dot(w, n) * n - w; }

// Refracts `w` (pointing away from the surface, dot(w, n) > 0) through a surface with
// `eta` = index on the far side / index on w's side; nullopt at total internal reflection.
inline std::optional<vec3> refract_through(vec3 w, vec3 n, float eta) {
  const float cos_i = dot(w, n);
  const float sin2_t = std::max(0.0f, 1.0f - cos_i * cos_i) / (eta * eta);
  if (sin2_t >= 1.0f) {
    return std::nullopt;
  }
  const float cos_t = std::sqrt(1.0f - sin2_t);
  return normalize(-w / eta + (cos_i / eta - cos_t) * n);
}

}  // namespace janus
