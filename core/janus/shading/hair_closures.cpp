// SPDX-License-Identifier: GPL-3.0-or-later
//
// The closures of hair, from Cycles' nodes; their lobes are in hair.h.
#include <algorithm>

#include "janus/shading/closures.h"
#include "janus/shading/hair.h"

namespace janus {

namespace {

using enum SocketType;

// Nullopt: a direction that is none.
std::optional<vec3> direction(vec3 v) {
  const float length = glm::length(v);
  return length > 0.0f && std::isfinite(length) ? std::optional(v / length) : std::nullopt;
}

void add_lobe(const Lobe& lobe, ShadingResult& out) {
  if (!is_black(lobe.weight)) {
    out.bsdf.add(lobe);
  }
}

namespace hair {
// Cycles knows no offset on surfaces that are no hair.
enum Input { Color, Offset, RoughnessU, RoughnessV, Tangent, OnCurve };
constexpr SocketDecl kInputs[] = {
    {"Color", SocketType::Color, 0.8f},    {"Offset", Float, 0.0f},
    {"RoughnessU", Float, 0.1f},           {"RoughnessV", Float, 1.0f},
    {"Tangent", Vector, Implicit::Beside}, {"On Curve", Float, Implicit::OnCurve}};

void add(const ClosureArguments& a, ShadingResult& out) {
  if (const auto along = direction(a.vector(Tangent))) {
    const bool transmission = a.setting() == 1;
    add_lobe(
        hair_lobe(transmission, a.share() * a.positive_color(Color), *along, a.number(RoughnessU),
                  a.number(RoughnessV), a.number(OnCurve) * a.number(Offset)),
        out);
  }
}
}  // namespace hair

namespace principled_hair {
enum Input {
  Color,
  Melanin,
  Redness,
  Tint,
  Absorption,
  Roughness,
  RadialRoughness,
  Coat,
  Ior,
  Offset,
  RandomColor,
  RandomRoughness,
  Random,
  Along
};
constexpr SocketDecl kInputs[] = {
    {"Color", SocketType::Color, vec3(0.017513f, 0.005763f, 0.002059f)},
    {"Melanin", Float, 0.8f},
    {"Melanin Redness", Float, 1.0f},
    {"Tint", SocketType::Color, 1.0f},
    {"Absorption Coefficient", Vector, vec3(0.245531f, 0.52f, 1.365f)},
    {"Roughness", Float, 0.3f},
    {"Radial Roughness", Float, 0.3f},
    {"Coat", Float, 0.0f},
    {"IOR", Float, 1.55f},
    {"Offset", Float, 0.0349066f},
    {"Random Color", Float, 0.0f},
    {"Random Roughness", Float, 0.0f},
    {"Random", Float, Implicit::Strand},
    {"Along", Vector, Implicit::Along}};
enum Parametrization { FromAbsorption, FromMelanin, FromColor };

Rgb absorption(const ClosureArguments& a, float random, float radial_roughness) {
  switch (a.setting()) {
    case FromAbsorption:
      return a.vector(Absorption);
    case FromMelanin: {
      const float amount =
          a.number(Melanin) * (1.0f + 2.0f * (random - 0.5f) * a.fraction(RandomColor));
      const float melanin = -std::log(std::max(1.0f - amount, 0.0001f));
      const float redness = a.number(Redness);
      return absorption_of_melanin(melanin * (1.0f - redness), melanin * redness) +
             absorption_of_color(a.vector(Tint), radial_roughness);
    }
    default:
      return absorption_of_color(a.vector(Color), radial_roughness);
  }
}

void add(const ClosureArguments& a, ShadingResult& out) {
  const auto along = direction(a.vector(Along));
  if (!along) {
    return;
  }
  const float random = a.number(Random);
  const float vary = 1.0f + 2.0f * (random - 0.5f) * a.number(RandomRoughness);
  ChiangHair hair;
  hair.roughness = a.number(Roughness) * vary;
  hair.radial_roughness = a.number(RadialRoughness) * vary;
  hair.absorption = absorption(a, random, hair.radial_roughness);
  hair.coat = a.number(Coat);
  hair.ior = a.number(Ior);
  hair.offset = a.number(Offset);
  const Rgb weight(a.share());
  add_lobe(chiang_lobe(LobeType::ChiangReflection, weight, *along, hair), out);
  add_lobe(chiang_lobe(LobeType::ChiangRest, weight, *along, hair), out);
}
}  // namespace principled_hair

}  // namespace

const ClosureDecl kHairClosure{&hair::add, {.transmits = true, .fibers = true, .lobes = 1}},
    kPrincipledHairClosure{&principled_hair::add, {.transmits = true, .fibers = true, .lobes = 2}};

const std::span<const SocketDecl> kHairInputs(hair::kInputs),
    kPrincipledHairInputs(principled_hair::kInputs);

}  // namespace janus
