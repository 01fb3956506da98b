// SPDX-License-Identifier: GPL-3.0-or-later
//
// Perlin's gradient noise in one to four dimensions, and fractals of it (Ebert et al., Texturing
// and Modeling): Cycles' functions, number for number.
#pragma once

#include "janus/math/white_noise.h"

namespace janus {

// In about [-1, 1], 0 at points of the integer grid. It repeats after 100000 along each axis.
template <int D>
float perlin_noise(Coordinates<D> p);

enum class NoiseType { Multifractal, RidgedMultifractal, HybridMultifractal, Fbm, HeteroTerrain };

// How octaves are added up. detail: one less than there are, the fraction is a share of a last
// one; roughness: how much less each weighs; lacunarity: how much finer it is.
struct Fractal {
  NoiseType type = NoiseType::Fbm;
  float detail = 0.0f, roughness = 0.5f, lacunarity = 2.0f;
  float offset = 0.0f, gain = 1.0f;  // of the multifractals
  bool normalize = false;            // fBm in [0, 1]
};

template <int D>
float fractal_noise(Coordinates<D> p, const Fractal& fractal);

}  // namespace janus
