// SPDX-License-Identifier: GPL-3.0-or-later
//
// Glossy's Ashikhmin-Shirley ("An Anisotropic Phong BRDF Model", 2000) as Cycles has it: without a
// Fresnel term, and rather dark at grazing angles.
#pragma once

#include "janus/shading/scatter.h"

namespace janus {

// As evaluate_lobe(). `n`, `n_light`: the normals that wo and wi see, on their sides.
LobeEval evaluate_ashikhmin_shirley(const Lobe& lobe, const Directions& d, vec3 n, vec3 n_light);

// A half vector, with the density of the model per solid angle, whatever the view.
vec3 sample_half_vector(const Lobe& lobe, vec3 n, vec2 u);

}  // namespace janus
