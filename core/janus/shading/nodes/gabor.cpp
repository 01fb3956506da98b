// SPDX-License-Identifier: GPL-3.0-or-later
//
// Gabor.
#include "janus/math/gabor.h"

#include "janus/shading/node_emitter.h"
#include "janus/shading/nodes/families.h"
#include "janus/shading/scalar.h"

namespace janus {

namespace {

using enum SocketType;

constexpr SocketDecl kInputs[] = {{"Vector", Vector, Implicit::Generated},
                                  {"Scale", Float, 5.0f},
                                  {"Frequency", Float, 2.0f},
                                  {"Anisotropy", Float, 1.0f},
                                  {"Orientation 2D", Float, 0.25f * kPi},
                                  {"Orientation 3D", Vector, vec3(1.0f, 1.0f, 0.0f)}};
constexpr std::string_view kOutputs[] = {"Value", "Phase", "Intensity"};
constexpr std::string_view kTypes[] = {"2D", "3D"};

float usable_frequency(float x) { return x < 0.001f ? 0.001f : x; }
float isotropy(float anisotropy) { return 1.0f - clamp01(anisotropy); }

// The phasor, relative to the range of its values.
vec3 gabor_2d(vec3 p, float scale, float frequency, float anisotropy, float orientation) {
  const vec2 phasor =
      gabor_noise(vec2(p * scale), usable_frequency(frequency), isotropy(anisotropy), orientation);
  return vec3(phasor / gabor_range(2), 0.0f);
}
vec3 gabor_3d(vec3 p, float scale, float frequency, float anisotropy, vec3 orientation) {
  const vec2 phasor = gabor_noise(p * scale, usable_frequency(frequency), isotropy(anisotropy),
                                  normalize(orientation));
  return vec3(phasor / gabor_range(3), 0.0f);
}

constexpr Operation kValue = pure<[](vec3 v) { return 0.5f * v.y + 0.5f; }>;
constexpr Operation kPhase =
    pure<[](vec3 v) { return (std::atan2(v.y, v.x) + kPi) / (2.0f * kPi); }>;
constexpr Operation kIntensity = pure<[](vec3 v) { return glm::length(v); }>;

void emit_gabor(NodeEmitter& e) {
  const bool flat = e.property("gabor_type", "2D") == "2D";
  const Value phasor =
      e.emit(flat ? pure<&gabor_2d> : pure<&gabor_3d>,
             {e.input("Vector"), e.input("Scale"), e.input("Frequency"), e.input("Anisotropy"),
              e.input(flat ? "Orientation 2D" : "Orientation 3D")});
  e.output("Value", e.emit(kValue, {phasor}));
  e.output("Phase", e.emit(kPhase, {phasor}));
  e.output("Intensity", e.emit(kIntensity, {phasor}));
}

constexpr EnumDecl kSettings[] = {{"gabor_type", kTypes}};

}  // namespace

std::span<const NodeDecl> gabor_nodes() {
  static const NodeDecl kNodes[] = {
      {"TEX_GABOR", kInputs, kOutputs, &emit_gabor, nullptr, MixOp::None, kSettings},
  };
  return kNodes;
}

}  // namespace janus
