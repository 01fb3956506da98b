// SPDX-License-Identifier: GPL-3.0-or-later
//
// Maps from the unit square to other domains; each states the density it draws with.
#pragma once

#include <algorithm>

#include "janus/math/vec.h"

namespace janus {

// Cosine and sine of an angle of a few turns, to 1e-7. C libraries differ in the last digit of
// theirs, and a picture should not depend on the machine's: sums and products do not. The
// polynomials are those of Cephes (Moshier) for up to a quarter of pi.
inline vec2 cos_sin(float angle) {
  const float turns = std::nearbyint(angle * (2.0f * kInvPi));  // quarter turns
  // Two steps, because pi/2 does not fit into one number.
  const float x = (angle - turns * 1.5707855f) - turns * 1.0804334e-5f;
  const float x2 = x * x;
  const float sine =
      x + x * x2 * (-1.6666654611e-1f + x2 * (8.3321608736e-3f - x2 * 1.9515295891e-4f));
  const float cosine =
      1.0f - 0.5f * x2 +
      x2 * x2 *
          (4.166664568298827e-2f + x2 * (-1.388731625493765e-3f + x2 * 2.443315711809948e-5f));
  switch (static_cast<int>(turns) & 3) {
    case 0:
      return vec2(cosine, sine);
    case 1:
      return vec2(-sine, cosine);
    case 2:
      return vec2(-cosine, -sine);
    default:
      return vec2(sine, -cosine);
  }
}

// Uniform on the unit disk, density 1/pi (Shirley & Chiu 1997: keeps stratification).
inline vec2 square_to_disk(vec2 u) {
  const vec2 c = 2.0f * u - 1.0f;
  if (c.x == 0.0f && c.y == 0.0f) {
    return vec2(0.0f);
  }
  float r, phi;
  if (std::abs(c.x) > std::abs(c.y)) {
    r = c.x;
    phi = 0.25f * kPi * (c.y / c.x);
  } else {
    r = c.y;
    phi = 0.5f * kPi - 0.25f * kPi * (c.x / c.y);
  }
  return r * cos_sin(phi);
}

// Cosine-weighted on the hemisphere around +z, density cos(theta)/pi per solid angle.
inline vec3 square_to_cosine_hemisphere(vec2 u) {
  const vec2 d = square_to_disk(u);
  return vec3(d, std::sqrt(std::max(0.0f, 1.0f - dot(d, d))));
}

// Cosine-weighted on the cone sin(theta)^2 <= `sin2_max` around +z, density
// cos(theta) / (pi sin2_max) per solid angle.
inline vec3 square_to_cosine_cone(vec2 u, float sin2_max) {
  const vec2 d = square_to_disk(u) * std::sqrt(sin2_max);
  return vec3(d, std::sqrt(std::max(0.0f, 1.0f - dot(d, d))));
}

// Uniform on the unit sphere, density 1/(4 pi) per solid angle.
inline vec3 square_to_sphere(vec2 u) {
  const float z = 1.0f - 2.0f * u.x;
  const float r = std::sqrt(std::max(0.0f, 1.0f - z * z));
  const float phi = 2.0f * kPi * u.y;
  return vec3(r * cos_sin(phi), z);
}

// Uniform on the cone with 1 - cos(theta_max) = `one_minus_cos` around +z, density
// 1/(2 pi one_minus_cos) per solid angle. Taking 1 - cos keeps precision for tiny cones.
inline vec3 square_to_cone(vec2 u, float one_minus_cos) {
  const float h = u.x * one_minus_cos;  // 1 - cos(theta)
  const float r = std::sqrt(std::max(0.0f, h * (2.0f - h)));
  const float phi = 2.0f * kPi * u.y;
  return vec3(r * cos_sin(phi), 1.0f - h);
}

// Uniform barycentric coordinates (b1, b2) of a triangle, density 1/area.
inline vec2 square_to_triangle(vec2 u) {
  // Heitz 2019: no square root, and a better map of stratified points.
  if (u.y > u.x) {
    u.x *= 0.5f;
    u.y -= u.x;
  } else {
    u.y *= 0.5f;
    u.x -= u.y;
  }
  return u;
}

}  // namespace janus
