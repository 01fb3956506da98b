// SPDX-License-Identifier: GPL-3.0-or-later
//
// Thin walls: a sheet so thin that both its sides are one surface, and light comes out where it
// went in (OpenPBR specification, "The thin-walled case").
#pragma once

#include "janus/shading/lobe.h"

namespace janus {

// What a sheet reflects and lets through of light at one angle, over all reflections between its
// sides; without loss they make up 1.
struct ThinGlass {
  Rgb reflected, transmitted;
};

// `side`: a Glass lobe of one side, with tint 1, and its film; `tint`: what is left of light that
// crosses the sheet straight; `cos`: of the angle to the normal, in [0, 1].
ThinGlass thin_glass(const Lobe& side, Rgb tint, float cos);

// Width of the facets for what goes through a sheet of index `ior` whose sides have width `alpha`
// (Kulla & Conty 2017, "Revisiting Physically Based Shading at Imageworks", p. 40, whose 3.7 is
// twice 1.7).
float thin_width(float alpha, float ior);

}  // namespace janus
