// SPDX-License-Identifier: GPL-3.0-or-later
//
// Skies by formulas of the angles to the zenith and to the sun, which they do not show. Radiance is
// in Cycles' units.
#pragma once

#include <array>

#include "janus/math/vec.h"

namespace janus {

struct SkyFormula {
  vec3 sun;    // direction, unit
  vec3 scale;  // of each channel: XYZ, or Yxy
  std::array<std::array<float, 9>, 3> terms;
};

// Preetham, Shirley and Smits 1999. `sun`: a direction, unit. `turbidity`: 1 is clear air, 10 haze.
SkyFormula preetham(vec3 sun, float turbidity);
// Linear Rec.709; below the horizon as just above it.
Rgb preetham_radiance(const SkyFormula& sky, vec3 direction);

// Hosek and Wilkie 2012, with the albedo of the ground; the sun is never below the horizon.
SkyFormula hosek_wilkie(vec3 sun, float turbidity, float albedo);
Rgb hosek_wilkie_radiance(const SkyFormula& sky, vec3 direction);

}  // namespace janus
