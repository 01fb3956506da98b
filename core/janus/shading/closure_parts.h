// SPDX-License-Identifier: GPL-3.0-or-later
//
// What several closures have in common.
#pragma once

#include "janus/shading/closures.h"
#include "janus/shading/node_reader.h"
#include "janus/shading/subsurface.h"

namespace janus {

// Below it Cycles drops a component.
inline constexpr float kCutoff = 1e-5f;

// Adds a lobe with a normal, below the lobe `layer` of the result (-1: nothing covers it). Returns
// its place, -1 where there is none.
int add_lobe(const ClosureArguments& a, Lobe lobe, ShadingResult& out, vec3 normal, int layer = -1);
inline int add_lobe(const ClosureArguments& a, const Lobe& lobe, ShadingResult& out,
                    int layer = -1) {
  return add_lobe(a, lobe, out, a.normal(), layer);
}

// Cycles' clamp: refraction with an index of 0 is not defined.
inline float usable_index(float ior) { return std::max(ior, kCutoff); }

inline Lobe rough_diffuse(Rgb weight, Rgb albedo, float roughness) {
  return roughness < kCutoff ? diffuse_lobe(weight) : oren_nayar_lobe(weight, albedo, roughness);
}

// Adds a Subsurface lobe below the lobe `layer`; channels whose radius is next to nothing scatter
// as a diffuse one. `method`: number of the setting whose items are names of kSubsurfaceMethods.
void add_subsurface(const ClosureArguments& a, int method, Rgb weight, Rgb albedo, Rgb radius,
                    float anisotropy, float ior, float alpha, ShadingResult& out, int layer = -1);

// Facets whose widths are `alpha` times `x` and `y` along and across the tangent, the input
// `tangent` turned about the normal by the input `turns`.
FacetWidths turned_widths(const ClosureArguments& a, float alpha, float x, float y, int tangent,
                          int turns);
// The same by Principled's anisotropy, which only stretches them along the tangent.
FacetWidths stretched_widths(const ClosureArguments& a, float alpha, int anisotropy, int tangent,
                             int turns);

// The lobe with the facets that the node's distribution has.
Lobe of_distribution(const ClosureArguments& a, const Lobe& lobe);

// The lobe below the film that the inputs `thickness` and `ior` say.
inline Lobe below_film(const ClosureArguments& a, const Lobe& lobe, int thickness, int ior) {
  return with_film(lobe, a.number(thickness), a.number(ior));
}

}  // namespace janus
