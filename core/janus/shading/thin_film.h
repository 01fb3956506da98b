// SPDX-License-Identifier: GPL-3.0-or-later
//
// Interference in a thin film on facets: the reflectance of all bounces within it by Airy's sum,
// over the spectrum by the Fourier transforms of the sensitivities of the three channels (Belcour &
// Barla, "A Practical Extension to Microfacet Theory for the Modeling of Varying Iridescence",
// 2017). In air; as Cycles has it from 5.0 on.
#pragma once

#include "janus/math/vec.h"

namespace janus {

struct ThinFilm {
  float thickness;  // nanometres
  float ior;        // to that of the side from which it is seen

  // Thinner ones do nothing.
  bool exists() const { return thickness > 0.1f; }
};

// On a dielectric of index `eta` (far side / side of the view), at cosine `cos` >= 0.
Rgb film_on_dielectric(ThinFilm film, float cos, float eta);

// On a metal of index n + i k.
Rgb film_on_conductor(ThinFilm film, float cos, Rgb n, Rgb k);
// On one whose reflectance is Schlick's with a tint of the edge, `f0` straight on and `at_edge` at
// 82 degrees; the phases are those of a metal of about the same (Gulbrandsen 2014).
Rgb film_on_metal(ThinFilm film, float cos, Rgb f0, Rgb at_edge);

}  // namespace janus
