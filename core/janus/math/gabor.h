// SPDX-License-Identifier: GPL-3.0-or-later
//
// Gabor noise (Lagae et al. 2009) as a phasor (Tricard et al. 2019): waves of one frequency in
// random places. Cycles' functions, number for number.
#pragma once

#include "janus/math/vec.h"

namespace janus {

// isotropy: how far waves run in random directions, 0 to 1, else at the angle or along the unit
// vector `orientation`; frequency: waves per unit of length.
vec2 gabor_noise(vec2 p, float frequency, float isotropy, float orientation);
vec2 gabor_noise(vec3 p, float frequency, float isotropy, vec3 orientation);

// Six standard deviations of their values.
float gabor_range(int dimensions);

}  // namespace janus
