// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sheen: what fine fibres that stand on a surface scatter back, for one view, as a linearly
// transformed cosine (Zeltner et al., "Practical Multiple-Scattering Sheen Using Linearly
// Transformed Cosines", 2022).
#pragma once

#include "janus/math/frame.h"

namespace janus {

// Seen at cosine `cos_o` to the normal.
struct SheenLobe {
  float scale, shear;
  float albedo;  // 0: nothing is seen of it, and it covers nothing

  SheenLobe(float roughness, float cos_o);

  // |wi . N| times the value, without the albedo: a density. `n`: unit, on the side of both.
  float density(vec3 n, vec3 wo, vec3 wi) const;
  // A direction wi with this density.
  vec3 sample(vec3 n, vec3 wo, vec2 u) const;
};

}  // namespace janus
