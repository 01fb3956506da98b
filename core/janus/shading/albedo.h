// SPDX-License-Identifier: GPL-3.0-or-later
//
// Albedos of GGX microfacet scattering, by linear interpolation in tables that the build makes
// (tables/generate.cpp). Cycles' multiscatter and layered closures are defined by such tables; grid
// and interpolation are the same here. `rough` is sqrt(alpha), `mu` the cosine of the direction to
// the normal; both are clamped to [0, 1].
#pragma once

namespace janus {

// Single-scattering reflection without Fresnel term, from direction cosine `mu`, and the average
// over directions (weight 2 mu).
float reflection_albedo(float rough, float mu);
float reflection_albedo_average(float rough);

// Reflection and refraction together at a dielectric with index `eta` (far side / near side).
float glass_albedo(float rough, float mu, float eta);
float glass_albedo_average(float rough, float eta);

// Where the mean Fresnel term of a rough dielectric, without masking, stands between its
// reflectance straight on (0) and 1.
float dielectric_position(float rough, float mu, float eta);

// The mean of Schlick's (1 - cos)^5, likewise.
float schlick_reflectance(float rough, float mu);

}  // namespace janus
