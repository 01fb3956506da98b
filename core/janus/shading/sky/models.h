// SPDX-License-Identifier: GPL-3.0-or-later
//
// The models behind atmosphere.h, and what they have in common.
#pragma once

#include <array>
#include <functional>

#include "janus/shading/sky/atmosphere.h"

namespace janus {

// Linear Rec.709, whose white is that of D65.
Rgb xyz_to_rgb(vec3 xyz);

inline constexpr int kSkyColumns = 512, kSkyRows = 256;

// A picture that is its own mirror image: left(row) gives the colours of the left half of each row
// from `first` on, from the edge to the middle; the rows below it are black. Runs on all threads.
using HalfRow = std::array<Rgb, kSkyColumns / 2>;
Image mirrored_picture(int rows, int first, const std::function<HalfRow(int row)>& left);

Image single_scattering_picture(const Atmosphere& atmosphere);
Image nishita_picture(const Atmosphere& atmosphere);
Rgb single_scattering_sun(const Atmosphere& atmosphere, float elevation);

Image multiple_scattering_picture(const Atmosphere& atmosphere);
Rgb multiple_scattering_sun(const Atmosphere& atmosphere, float elevation);

}  // namespace janus
