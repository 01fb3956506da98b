// SPDX-License-Identifier: GPL-3.0-or-later
//
// The colours of a surface as Cycles' passes show them: what it scatters of light from everywhere,
// by kind. An estimate of the same roughness as there.
#pragma once

#include "janus/shading/bsdf.h"

namespace janus {

struct SurfaceColor {
  Rgb diffuse = Rgb(0.0f), glossy = Rgb(0.0f), transmission = Rgb(0.0f);
};

// Seen from `wo`. Translucent lobes are diffuse; reflections of glass are glossy; fibres are
// glossy where they reflect, and transmission with all else.
SurfaceColor surface_color(const BsdfView& bsdf, vec3 wo);
// Of one lobe of a surface with geometric normal `ng`.
SurfaceColor surface_color(const Lobe& lobe, vec3 ng, vec3 wo);

}  // namespace janus
