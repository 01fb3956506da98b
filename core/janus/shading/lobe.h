// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "janus/math/vec.h"

namespace janus {

enum class LobeType : uint8_t {
  Diffuse,     // Lambert
  Mirror,      // perfectly smooth reflection, no Fresnel (Glossy BSDF, roughness 0)
  Dielectric,  // perfectly smooth reflection and refraction (Glass BSDF, roughness 0)
};

// One term of a Bsdf: plain data in world space.
struct Lobe {
  LobeType type;
  Rgb weight;   // colour times the closure's share in Mix and Add
  vec3 normal;  // shading normal on the front side (the side of +Ng), unit
  float ior;    // Dielectric: index of the back side relative to the front side
  float pmf;    // probability of choosing this lobe when sampling; the same from both sides
};

inline bool is_delta(const Lobe& lobe) { return lobe.type != LobeType::Diffuse; }

}  // namespace janus
