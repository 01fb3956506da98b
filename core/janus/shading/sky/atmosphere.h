// SPDX-License-Identifier: GPL-3.0-or-later
//
// The light that the air scatters from the sun, and what it leaves of the sun's own: the models of
// Blender's Sky Texture that follow rays through an atmosphere.
#pragma once

#include <memory>

#include "janus/image/image.h"
#include "janus/math/vec.h"

namespace janus {

struct Atmosphere {
  enum class Model {
    SingleScattering,    // light that is scattered once (Nishita et al. 1993)
    Nishita,             // the same as Blender had it up to 4.5
    MultipleScattering,  // also more often, by a fit (Garcia Linan 2022)
  };
  Model model = Model::SingleScattering;
  float sun_elevation = 0.0f;                       // radians
  float altitude = 0.0f;                            // of who looks: metres above the sea
  float air = 1.0f, aerosols = 1.0f, ozone = 1.0f;  // densities, those of a clear day are 1

  bool operator==(const Atmosphere&) const = default;
};

// The radiance of the sky, without the sun, as linear Rec.709 that may be below 0. From column 0 on
// the azimuth grows by a turn; the sun stands in the middle. The row `v` shows the elevation
// pi/2 (2v - 1)^2, with the sign of 2v - 1; that of Nishita's pi/2 v^2. (How centres of pixels lie
// is the model's.) Computed in some 100 ms by all threads; the last few are kept.
std::shared_ptr<const Image> sky_picture(const Atmosphere& atmosphere);

// The irradiance, as linear Rec.709 that may be below 0, of a surface that faces a sun as small as
// a point at an elevation (radians).
Rgb sun_irradiance(const Atmosphere& atmosphere, float elevation);

}  // namespace janus
