// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "janus/math/vec.h"

namespace janus {

enum class LobeType : uint8_t {
  Diffuse,      // Lambert
  OrenNayar,    // rough diffuse (Fujii's Oren-Nayar with multiple scattering)
  Translucent,  // Lambert to the other side
  // Light on a fibre, seen as a whole; all take the whole sphere. See hair.h.
  HairReflection,    // Hair BSDF, Reflection
  HairTransmission,  // and Transmission
  ChiangReflection,  // Principled Hair BSDF of Chiang's model: R,
  ChiangRest,        // and TT, TRT, and all after
  Glossy,            // GGX reflection without Fresnel term
  Metal,             // GGX reflection, Fresnel term of Schlick
  Specular,          // GGX reflection with the Fresnel term of a dielectric
  Glass,             // GGX reflection and refraction at a dielectric
  Refraction,        // GGX refraction alone, without Fresnel term
};

// One term of a Bsdf: plain data in world space, without anything that depends on the view, so that
// it can be kept in a cache. Made by the functions below; the normal is set where it is placed.
struct Lobe {
  Rgb weight;  // colour times the closure's share in Mix and Add
  // Metal: F0; Glass: tint; OrenNayar: albedo; Glossy, Specular: multiscatter tint; Chiang:
  // absorption by radius
  Rgb color;
  // Shading normal on the front side (the side of +Ng), unit. Fibres: their direction, unit.
  vec3 normal;
  // GGX width; 0: perfectly smooth, a delta. Layered lobes: of the layer above. Fibres: how wide
  // light spreads along them, Chiang: as a variance.
  float alpha;
  float ior;    // index of the back side relative to the front side; Layered: of the layer above
  float sigma;  // OrenNayar: roughness. Fibres: how wide light spreads around them
  float tilt;   // fibres: of their scales, radians
  // Probability of choosing this lobe when sampling: from pmf_normal for a walk that arrives along
  // Ng to pmf_grazing (see Bsdf::finish).
  float pmf_normal, pmf_grazing;
  LobeType type;
  bool multiscatter : 1;       // GGX with Cycles' energy scale; Layered: the layer above
  bool layered : 1;            // attenuated by the reflectance of a Specular layer above
  bool tinted_reflection : 1;  // Glass: `color` tints reflections too
  bool bumped : 1;             // the normal is the closure's own, not the surface's
};
static_assert(sizeof(Lobe) == 64);

// GGX lobes are a delta when alpha is 0.
inline bool is_ggx(LobeType type) { return type >= LobeType::Glossy; }
inline bool is_fiber(LobeType type) {
  return type >= LobeType::HairReflection && type <= LobeType::ChiangRest;
}
inline bool is_diffuse(LobeType type) { return type <= LobeType::Translucent; }
inline bool is_delta(const Lobe& lobe) { return is_ggx(lobe.type) && lobe.alpha == 0.0f; }
inline bool transmits(const Lobe& lobe) {
  return lobe.type >= LobeType::Glass || lobe.type == LobeType::Translucent || is_fiber(lobe.type);
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
