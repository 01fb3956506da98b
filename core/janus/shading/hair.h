// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lobes of fibres: how light leaves a hair that is seen as a whole, so that what goes through it
// comes out where it has come in, and the camera sees the side that looks at it. Only camera walks
// sample them (Bsdf::one_way()).
//
// - Hair BSDF: Cauchy and cosine lobes around the cone of mirror directions (as in Cycles, after
//   Marschner et al. 2003). Reflections may go around the fibre: so they do there, but where Cycles
//   looks for lamps it leaves out those on the far side, and transmissions on the near side.
// - Principled Hair BSDF: Chiang et al., "A Practical and Controllable Hair and Fur Model for
//   Production Path Tracing" (2016), after d'Eon et al. 2011: for each number p of bounces inside,
//   an attenuation A_p, a longitudinal term M_p and an azimuthal one N_p, in the frame of the view.
#pragma once

#include <optional>

#include "janus/shading/scatter.h"

namespace janus {

// `along`: of the fibre, unit. Roughness along and around it, `offset`: the tilt of its scales.
Lobe hair_lobe(bool transmission, Rgb weight, vec3 along, float roughness_u, float roughness_v,
               float offset);

// The parameters of Chiang's model, as the node has them.
struct ChiangHair {
  Rgb absorption = Rgb(0.0f);  // by radius
  float roughness = 0.3f, radial_roughness = 0.3f;
  float coat = 0.0f;  // how much smoother reflections are
  float ior = 1.55f;
  float offset = 0.0349066f;  // of its scales, radians
};
Lobe chiang_lobe(LobeType type, Rgb weight, vec3 along, const ChiangHair& hair);

// Absorption of hair that looks like `color` where there is much of it, and of hair that holds two
// pigments (Chiang et al. 2016; d'Eon et al. 2011).
Rgb absorption_of_color(Rgb color, float radial_roughness);
Rgb absorption_of_melanin(float eumelanin, float pheomelanin);

// The colour of a fibre lobe, for passes: an estimate, seen from `wo`.
Rgb fiber_color(const Lobe& lobe, vec3 ng, vec3 wo);

// As evaluate_lobe() and sample_lobe(). Walks from lights do not draw: their density is 0.
LobeEval evaluate_fiber(const Lobe& lobe, vec3 ng, const Directions& d);
std::optional<vec3> sample_fiber(const Lobe& lobe, vec3 ng, vec3 wo, float u_event, vec2 u);

}  // namespace janus
