// SPDX-License-Identifier: GPL-3.0-or-later
//
// What passes of data and denoisers want to know of a surface, as Cycles sees it.
#pragma once

#include "janus/shading/bsdf.h"

namespace janus {

// The mean of the lobes' normals, each with its weight, on the side of `wo`; `ns` (likewise) where
// there are none. Unit.
vec3 average_normal(const BsdfView& bsdf, vec3 ns, vec3 wo);

// The same of the diffuse lobes alone: where ambient occlusion looks.
vec3 diffuse_normal(const BsdfView& bsdf, vec3 ns, vec3 wo);

// A denoiser's view of a surface. What is nearly smooth shows something else: that is looked at
// instead where it makes up most of the surface.
struct SurfaceFeatures {
  vec3 normal = vec3(0.0f);  // a mean by `weight`, towards wo, not of unit length
  Rgb albedo = Rgb(0.0f);    // of the rough lobes
  Rgb smooth = Rgb(0.0f);    // of the others
  bool rough = true;         // shall its albedo and normal be taken?
};
// `transparency`: the share of the light that passes straight through; `ns`: as above.
SurfaceFeatures surface_features(const BsdfView& bsdf, Rgb transparency, vec3 ns, vec3 wo);

}  // namespace janus
