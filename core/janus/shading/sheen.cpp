// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/shading/sheen.h"

#include <cstdint>

#include "janus/math/warp.h"
#include "janus/shading/table_lookup.h"

namespace janus {

namespace {

#include "janus/shading/sheen_table.inc"

constexpr float kUnit = 1e-5f;

// The frame of the transform: its x axis on the side of the view.
Frame towards(vec3 n, vec3 wo) {
  Frame frame(n);
  const vec3 across = wo - dot(n, wo) * n;
  if (const float length = glm::length(across); length > 1e-6f) {
    frame.s = across / length;
    frame.t = cross(n, frame.s);
  }
  return frame;
}

}  // namespace

SheenLobe::SheenLobe(float roughness, float cos_o) {
  const Place<32> x(cos_o), y(roughness);
  scale = kUnit * read(kScale, x, y);
  shear = kUnit * read(kShear, x, y);
  albedo = kUnit * read(kAlbedo, x, y);
  if (std::abs(scale) < 1e-5f || albedo < 1e-5f) {  // Cycles' limits
    albedo = 0.0f;
  }
}

float SheenLobe::density(vec3 n, vec3 wo, vec3 wi) const {
  const Frame frame = towards(n, wo);
  const float z = dot(wi, n);
  const vec3 back(scale * dot(wi, frame.s) + shear * z, scale * dot(wi, frame.t), z);
  return z > 0.0f ? kInvPi * z * sqr(scale / length2(back)) : 0.0f;
}

vec3 SheenLobe::sample(vec3 n, vec3 wo, vec2 u) const {
  const vec3 cosine = square_to_cosine_hemisphere(u);
  return towards(n, wo).to_world(
      normalize(vec3(cosine.x - shear * cosine.z, cosine.y, scale * cosine.z)));
}

}  // namespace janus
