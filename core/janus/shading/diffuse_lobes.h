// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lobes that scatter over a wide angle: Diffuse, OrenNayar, Translucent, Sheen, Velvet; and Toon,
// which draws cones of light.
#pragma once

#include "janus/shading/scatter.h"

namespace janus {

// As evaluate_lobe() and sample_lobe().
LobeEval evaluate_diffuse(const Lobe& lobe, vec3 ng, const Directions& d);
std::optional<vec3> sample_diffuse(const Lobe& lobe, vec3 ng, vec3 from, vec2 u,
                                   TransportMode mode);
LobeEval evaluate_glossy_toon(const Lobe& lobe, const Directions& d);
std::optional<vec3> sample_glossy_toon(const Lobe& lobe, vec3 ng, vec3 from, vec2 u);

// What Cycles leaves of light from `wi` on a diffuse lobe of normal `n` where the surface's own is
// `ns`: nothing where it is above one of them and below the other; and less towards the horizon
// where `n` is tilted, so that bumps do not end in the dark at once (Conty et al. 2019). Of light
// through a translucent lobe it does so only where it looked for the light: that is left out here.
float lit_bumps(vec3 n, vec3 ns, vec3 wi);

// The largest density of a cone of a Toon lobe.
float toon_density(const Lobe& lobe);

}  // namespace janus
