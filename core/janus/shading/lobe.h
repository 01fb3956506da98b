// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>

#include "janus/math/vec.h"

namespace janus {

enum class LobeType : uint8_t {
  Diffuse,           // Lambert
  OrenNayar,         // rough diffuse (Fujii's Oren-Nayar with multiple scattering)
  Sheen,             // fine fibres on a surface. See sheen.h.
  Velvet,            // Ashikhmin's
  DiffuseToon,       // a cone around the normal
  Subsurface,        // a random walk below the surface; comes up as Lambert. See subsurface.h.
  Translucent,       // Lambert to the other side
  RoughTranslucent,  // OrenNayar, mirrored to the other side
  // Light on a fibre, seen as a whole; all take the whole sphere. See hair.h.
  HairReflection,    // Hair BSDF, Reflection
  HairTransmission,  // and Transmission
  ChiangReflection,  // Principled Hair BSDF of Chiang's model: R,
  ChiangRest,        // and TT, TRT, and all after
  GlossyToon,        // a cone around the mirror direction
  // Of facets, by GGX or Beckmann; the first ones only reflect.
  Glossy,            // without Fresnel term
  AshikhminShirley,  // the same of a model of its own. See ashikhmin_shirley.h.
  Metal,             // Schlick's Fresnel term with a tint of the edge (F82)
  Conductor,         // Fresnel's own for a metal
  Specular,          // a dielectric's, moved to another F0
  Coat,              // a dielectric's
  Glass,             // reflection and refraction at a dielectric
  Refraction,        // refraction alone, without Fresnel term
  MirroredGlossy,    // Glossy, mirrored to the other side: what goes through a thin wall
};

// One term of a Bsdf: plain data in world space, without anything that depends on the view, so that
// it can be kept in a cache. Made by the functions below; the normal is set where it is placed.
struct Lobe {
  Rgb weight;  // colour times the closure's share in Mix and Add
  // Metal, Specular: F0; Conductor: real part of its index; Glass: tint; OrenNayar,
  // RoughTranslucent: albedo; Glossy, MirroredGlossy: multiscatter tint; Chiang: absorption by
  // radius; Coat: tint; Sheen: its share as a layer; Subsurface: albedo
  Rgb color;
  // Metal: the F82 term's factor; Conductor: imaginary part of its index; Specular, Coat:
  // multiscatter tint; Glass: tint of F0; Subsurface: radius, metres, and once a light subpath has
  // come up there (SubsurfaceEntry), where it came from
  Rgb edge;
  // Shading normal on the front side (the side of +Ng), unit. Fibres: their direction, unit.
  vec3 normal;
  // Width of the facets' slopes, along and across the tangent; 0: perfectly smooth, a delta.
  // Sheen: roughness. Toon: half angle. Fibres: `alpha`, how wide light spreads along them, Chiang:
  // as a variance.
  float alpha, alpha_y;
  // Of facets of two widths, packed (see pack_direction()); Subsurface: its SubsurfaceMethod
  uint32_t tangent;
  float ior;  // index of the back side relative to the front side
  // OrenNayar, RoughTranslucent, Velvet: roughness. Fibres: how wide light spreads around them.
  // Toon: the angle over which it fades. Coat: its share as a layer. Subsurface: anisotropy. Other
  // facets: thickness of the film on them, nm
  float sigma;
  float tilt;  // fibres: of their scales, radians. Facets: index of the film on them
  // Probability of choosing this lobe when sampling: from pmf_normal for a walk that arrives along
  // Ng to pmf_grazing (see Bsdf::finish).
  float pmf_normal, pmf_grazing;
  LobeType type;
  uint8_t above;               // how far before this one its layer stands; 0: nothing covers it
  bool beckmann : 1;           // facets of Beckmann's distribution; else of GGX
  bool multiscatter : 1;       // facets with Cycles' energy scale
  bool tinted_reflection : 1;  // Glass: `color` tints reflections too
  bool bumped : 1;             // the normal is the closure's own, not the surface's
};
static_assert(sizeof(Lobe) == 84);

// Lobes of facets are a delta when alpha is 0.
inline bool has_facets(LobeType type) { return type >= LobeType::Glossy; }
inline bool is_fiber(LobeType type) {
  return type >= LobeType::HairReflection && type <= LobeType::ChiangRest;
}
inline bool is_toon(LobeType type) {
  return type == LobeType::DiffuseToon || type == LobeType::GlossyToon;
}
inline bool is_diffuse(LobeType type) { return type <= LobeType::RoughTranslucent; }
inline bool is_translucent(LobeType type) {
  return type == LobeType::Translucent || type == LobeType::RoughTranslucent;
}
inline bool is_delta(const Lobe& lobe) { return has_facets(lobe.type) && lobe.alpha == 0.0f; }
// Lobes that scatter light where it falls, in more than one direction.
inline bool is_connectible(const Lobe& lobe) {
  return !is_delta(lobe) && lobe.type != LobeType::Subsurface;
}
inline bool transmits(const Lobe& lobe) {
  return lobe.type >= LobeType::Glass || is_translucent(lobe.type) || is_fiber(lobe.type);
}
// The roughness that tables of albedos are made for: the root of the facets' width.
inline float roughness(const Lobe& lobe) {
  return std::sqrt(lobe.alpha == lobe.alpha_y ? lobe.alpha : std::sqrt(lobe.alpha * lobe.alpha_y));
}

// Widths of facets: squares of a node's roughness. What Cycles takes for smooth becomes a delta.
struct FacetWidths {
  float x, y;
  vec3 tangent = vec3(0.0f);  // of x, unit; does not matter where the widths are the same

  FacetWidths(float alpha) : x(alpha), y(alpha) {}  // NOLINT: a width is what most surfaces have
  FacetWidths(float alpha_x, float alpha_y, vec3 along) : x(alpha_x), y(alpha_y), tangent(along) {}
};

// What the compiler makes closures of. `multiscatter`: Cycles' Multiscatter GGX.
Lobe diffuse_lobe(Rgb weight);
Lobe oren_nayar_lobe(Rgb weight, Rgb albedo, float roughness);
Lobe translucent_lobe(Rgb weight);
Lobe rough_translucent_lobe(Rgb weight, Rgb albedo, float roughness);
// `layer`: what it is of a layer that covers all, beside its share in Mix and Add.
Lobe sheen_lobe(Rgb weight, float roughness, Rgb layer = Rgb(1.0f));
Lobe velvet_lobe(Rgb weight, float sigma);
// `size`, `smooth`: parts of a right angle.
Lobe toon_lobe(bool glossy, Rgb weight, float size, float smooth);
// `color`: what multiple bounces between the facets are tinted with.
Lobe glossy_lobe(Rgb weight, FacetWidths alpha, bool multiscatter = false, Rgb color = Rgb(1.0f));
// Where its widths are a mirror's, it is one.
Lobe ashikhmin_shirley_lobe(Rgb weight, FacetWidths alpha);
// `edge`: tint of what Schlick's term has at 82 degrees (Kutz et al. 2021).
Lobe metal_lobe(Rgb weight, Rgb f0, FacetWidths alpha, bool multiscatter = false,
                Rgb edge = Rgb(1.0f));
Lobe conductor_lobe(Rgb weight, Rgb n, Rgb k, FacetWidths alpha, bool multiscatter = false);
// `eta` holds for both sides, as in Cycles; `f0`: reflectance straight on, for that of `eta`.
Lobe specular_lobe(Rgb weight, float eta, FacetWidths alpha, bool multiscatter = false);
Lobe specular_lobe(Rgb weight, float eta, Rgb f0, FacetWidths alpha, bool multiscatter = false);
// `share`: as a layer; `tint`: of what goes through it straight.
Lobe coat_lobe(Rgb weight, float eta, float alpha, float share, Rgb tint);
// `f0_tint`: of the reflectance straight on.
Lobe glass_lobe(Rgb weight, Rgb tint, bool tinted_reflection, float ior, float alpha,
                bool multiscatter = false, Rgb f0_tint = Rgb(1.0f));
Lobe refraction_lobe(Rgb weight, float ior, float alpha);
// With Multiscatter of white facets. No delta: what goes straight through is no lobe.
Lobe mirrored_glossy_lobe(Rgb weight, float alpha);
// A lobe of facets (none of Coat and Refraction) below a thin film. `thickness`: nanometres.
Lobe with_film(Lobe lobe, float thickness, float ior);
// `lobe` with facets of Beckmann's distribution, which have no Multiscatter.
Lobe with_beckmann(Lobe lobe);

}  // namespace janus
