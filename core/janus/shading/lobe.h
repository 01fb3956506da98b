// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "janus/math/vec.h"

namespace janus {

enum class LobeType : uint8_t {
  Diffuse,      // Lambert
  OrenNayar,    // rough diffuse (Fujii's Oren-Nayar with multiple scattering)
  Translucent,  // Lambert to the other side
  Glossy,       // GGX reflection without Fresnel term
  Metal,        // GGX reflection, Fresnel term of Schlick
  Specular,     // GGX reflection with the Fresnel term of a dielectric
  Glass,        // GGX reflection and refraction at a dielectric
  Refraction,   // GGX refraction alone, without Fresnel term
};

// One term of a Bsdf: plain data in world space, without anything that depends on the view, so that
// it can be kept in a cache. Made by the functions below; the normal is set where it is placed.
struct Lobe {
  Rgb weight;   // colour times the closure's share in Mix and Add
  Rgb color;    // Metal: F0; Glass: tint; OrenNayar: albedo; Glossy, Specular: multiscatter tint
  vec3 normal;  // shading normal on the front side (the side of +Ng), unit
  float alpha;  // GGX width; 0: perfectly smooth, a delta. Layered lobes: of the layer above
  float ior;    // index of the back side relative to the front side; Layered: of the layer above
  float sigma;  // OrenNayar: roughness
  // Probability of choosing this lobe when sampling: from pmf_normal for a walk that arrives along
  // Ng to pmf_grazing (see Bsdf::finish).
  float pmf_normal, pmf_grazing;
  LobeType type;
  bool multiscatter;       // GGX with Cycles' energy scale; Layered: the layer above
  bool layered;            // attenuated by the reflectance of a Specular layer above
  bool tinted_reflection;  // Glass: `color` tints reflections too
  bool bumped;             // the normal is the closure's own, not the surface's
};

// GGX lobes are a delta when alpha is 0.
inline bool is_ggx(LobeType type) { return type >= LobeType::Glossy; }
inline bool is_delta(const Lobe& lobe) { return is_ggx(lobe.type) && lobe.alpha == 0.0f; }
inline bool transmits(const Lobe& lobe) {
  return lobe.type == LobeType::Translucent || lobe.type >= LobeType::Glass;
}

// What the compiler makes closures of. `alpha` is the square of a node's roughness; what Cycles
// takes for smooth becomes a delta. `multiscatter`: Cycles' Multiscatter GGX.
Lobe diffuse_lobe(Rgb weight);
Lobe oren_nayar_lobe(Rgb weight, Rgb albedo, float roughness);
Lobe translucent_lobe(Rgb weight);
// `color`: what multiple bounces between the facets are tinted with.
Lobe glossy_lobe(Rgb weight, float alpha, bool multiscatter = false, Rgb color = Rgb(1.0f));
Lobe metal_lobe(Rgb weight, Rgb f0, float alpha, bool multiscatter = false);
// `eta` holds for both sides, as in Cycles.
Lobe specular_lobe(Rgb weight, float eta, float alpha, bool multiscatter = false);
Lobe glass_lobe(Rgb weight, Rgb tint, bool tinted_reflection, float ior, float alpha,
                bool multiscatter = false);
Lobe refraction_lobe(Rgb weight, float ior, float alpha);
// `lobe` (Diffuse or OrenNayar) as it is below `layer` (Specular).
Lobe below(Lobe lobe, const Lobe& layer);

}  // namespace janus
