// SPDX-License-Identifier: GPL-3.0-or-later
//
// Layers: what a lobe lets through to those that it covers, as seen from the camera side. As in
// Cycles, light is dimmed once, by what the layer reflects of light from the camera's direction.
#pragma once

#include "janus/shading/scatter.h"

namespace janus {

// The share of light that reaches what `layer` covers, at cosine `cos_o` of the camera side to its
// normal.
Rgb layer_transmittance(const Lobe& layer, float cos_o);

// The share that reaches `lobe` through all that covers it. `lobe` stands in its Bsdf, behind them.
Rgb covers_transmittance(const Lobe& lobe, vec3 ng, vec3 wo);
// The share that comes through `layer` and all that covers it.
Rgb through(const Lobe& layer, vec3 ng, vec3 wo);

// An estimate of the same, for walks that come straight on or at the horizon, from either end.
struct CoveredShare {
  float normal = 1.0f, grazing = 1.0f;
};
CoveredShare covered_share(const Lobe& lobe);

// The mean reflectance of a Specular or Coat lobe of facets without masking, at cosine `cos_o`.
Rgb layer_reflectance(const Lobe& lobe, float cos_o);

}  // namespace janus
