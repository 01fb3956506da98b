// SPDX-License-Identifier: GPL-3.0-or-later
//
// Mix: numbers, vectors, and colours with Blender's blend types.
#include <algorithm>
#include <cmath>

#include "janus/shading/node_emitter.h"
#include "janus/shading/nodes/color_space.h"
#include "janus/shading/nodes/families.h"
#include "janus/shading/scalar.h"

namespace janus {

namespace {

using enum SocketType;

template <class F>
vec3 each(vec3 a, vec3 b, F f) {
  return vec3(f(a.x, b.x), f(a.y, b.y), f(a.z, b.z));
}

vec3 lerp(float t, vec3 a, vec3 b) { return a + t * (b - a); }

// t, the factor; a, below; b, above.
vec3 blend_mix(float t, vec3 a, vec3 b) { return lerp(t, a, b); }
vec3 blend_add(float t, vec3 a, vec3 b) { return lerp(t, a, a + b); }
vec3 blend_multiply(float t, vec3 a, vec3 b) { return lerp(t, a, a * b); }
vec3 blend_subtract(float t, vec3 a, vec3 b) { return lerp(t, a, a - b); }
vec3 blend_difference(float t, vec3 a, vec3 b) { return lerp(t, a, glm::abs(a - b)); }
vec3 blend_exclusion(float t, vec3 a, vec3 b) {
  return glm::max(lerp(t, a, a + b - 2.0f * a * b), vec3(0.0f));
}
vec3 blend_darken(float t, vec3 a, vec3 b) { return lerp(t, a, glm::min(a, b)); }
vec3 blend_lighten(float t, vec3 a, vec3 b) { return lerp(t, a, glm::max(a, b)); }
vec3 blend_screen(float t, vec3 a, vec3 b) {
  return 1.0f - (vec3(1.0f - t) + t * (1.0f - b)) * (1.0f - a);
}
vec3 blend_overlay(float t, vec3 a, vec3 b) {
  return each(a, b, [t](float x, float y) {
    return x < 0.5f ? x * (1.0f - t + 2.0f * t * y)
                    : 1.0f - (1.0f - t + 2.0f * t * (1.0f - y)) * (1.0f - x);
  });
}
vec3 blend_divide(float t, vec3 a, vec3 b) {
  return each(a, b, [t](float x, float y) { return y != 0.0f ? (1.0f - t) * x + t * x / y : x; });
}
vec3 blend_dodge(float t, vec3 a, vec3 b) {
  return each(a, b, [t](float x, float y) {
    if (x == 0.0f) {
      return x;
    }
    const float rest = 1.0f - t * y;
    return rest <= 0.0f ? 1.0f : std::min(x / rest, 1.0f);
  });
}
vec3 blend_burn(float t, vec3 a, vec3 b) {
  return each(a, b, [t](float x, float y) {
    const float rest = 1.0f - t + t * y;
    return rest <= 0.0f ? 0.0f : std::clamp(1.0f - (1.0f - x) / rest, 0.0f, 1.0f);
  });
}
vec3 blend_soft_light(float t, vec3 a, vec3 b) {
  const vec3 screen = 1.0f - (1.0f - b) * (1.0f - a);
  return (1.0f - t) * a + t * ((1.0f - a) * b * a + a * screen);
}
vec3 blend_linear_light(float t, vec3 a, vec3 b) { return a + t * (2.0f * b - 1.0f); }
vec3 blend_hue(float t, vec3 a, vec3 b) {
  const vec3 over = rgb_to_hsv(b);
  if (over.y == 0.0f) {
    return a;
  }
  vec3 hsv = rgb_to_hsv(a);
  hsv.x = over.x;
  return lerp(t, a, hsv_to_rgb(hsv));
}
vec3 blend_saturation(float t, vec3 a, vec3 b) {
  vec3 hsv = rgb_to_hsv(a);
  if (hsv.y == 0.0f) {
    return a;
  }
  hsv.y = (1.0f - t) * hsv.y + t * rgb_to_hsv(b).y;
  return hsv_to_rgb(hsv);
}
vec3 blend_value(float t, vec3 a, vec3 b) {
  vec3 hsv = rgb_to_hsv(a);
  hsv.z = (1.0f - t) * hsv.z + t * rgb_to_hsv(b).z;
  return hsv_to_rgb(hsv);
}
vec3 blend_color(float t, vec3 a, vec3 b) {
  const vec3 over = rgb_to_hsv(b);
  if (over.y == 0.0f) {
    return a;
  }
  return lerp(t, a, hsv_to_rgb(vec3(over.x, over.y, rgb_to_hsv(a).z)));
}

struct BlendMode {
  std::string_view name;
  Operation operation;
};
const BlendMode kBlendModes[] = {
    {"MIX", pure<&blend_mix>},
    {"DARKEN", pure<&blend_darken>},
    {"MULTIPLY", pure<&blend_multiply>},
    {"BURN", pure<&blend_burn>},
    {"LIGHTEN", pure<&blend_lighten>},
    {"SCREEN", pure<&blend_screen>},
    {"DODGE", pure<&blend_dodge>},
    {"ADD", pure<&blend_add>},
    {"OVERLAY", pure<&blend_overlay>},
    {"SOFT_LIGHT", pure<&blend_soft_light>},
    {"LINEAR_LIGHT", pure<&blend_linear_light>},
    {"DIFFERENCE", pure<&blend_difference>},
    {"EXCLUSION", pure<&blend_exclusion>},
    {"SUBTRACT", pure<&blend_subtract>},
    {"DIVIDE", pure<&blend_divide>},
    {"HUE", pure<&blend_hue>},
    {"SATURATION", pure<&blend_saturation>},
    {"COLOR", pure<&blend_color>},
    {"VALUE", pure<&blend_value>},
};

constexpr Operation kClampVector = pure<[](vec3 a) { return glm::clamp(a, 0.0f, 1.0f); }>;
constexpr Operation kMixNumbers =
    pure<[](float t, float a, float b) { return a * (1.0f - t) + b * t; }>;
constexpr Operation kMixVectors = pure<[](vec3 t, vec3 a, vec3 b) { return a + t * (b - a); }>;

Value blend(NodeEmitter& e, Value t, Value a, Value b) {
  const BlendMode& mode = find_mode(kBlendModes, e.property("blend_type", "MIX"));
  return e.convert(e.emit(mode.operation, {t, a, b}), Color);
}

constexpr SocketDecl kInputs[] = {{"Factor_Float", Float, 0.5f}, {"Factor_Vector", Vector, 0.5f},
                                  {"A_Float", Float, 0.0f},      {"B_Float", Float, 0.0f},
                                  {"A_Vector", Vector, 0.0f},    {"B_Vector", Vector, 0.0f},
                                  {"A_Color", Color, 0.5f},      {"B_Color", Color, 0.5f}};
constexpr std::string_view kOutputs[] = {"Result_Float", "Result_Vector", "Result_Color"};

void emit_mix(NodeEmitter& e) {
  const std::string type = e.property("data_type", "FLOAT");
  const bool clamp = e.flag("clamp_factor");
  if (type == "VECTOR" && e.property("factor_mode", "UNIFORM") == "NON_UNIFORM") {
    const Value t = e.input("Factor_Vector");
    e.output("Result_Vector", e.emit(kMixVectors, {clamp ? e.emit(kClampVector, {t}) : t,
                                                   e.input("A_Vector"), e.input("B_Vector")}));
    return;
  }
  Value t = e.input("Factor_Float");
  t = clamp ? e.emit(pure<&clamp01>, {t}) : t;
  if (type == "FLOAT") {
    e.output("Result_Float", e.emit(kMixNumbers, {t, e.input("A_Float"), e.input("B_Float")}));
  } else if (type == "VECTOR") {
    e.output("Result_Vector",
             e.emit(kMixVectors, {e.convert(t, Vector), e.input("A_Vector"), e.input("B_Vector")}));
  } else {
    const Value c = blend(e, t, e.input("A_Color"), e.input("B_Color"));
    e.output("Result_Color",
             e.flag("clamp_result") ? e.convert(e.emit(kClampVector, {c}), Color) : c);
  }
}

// The node of older files.
constexpr SocketDecl kLegacyInputs[] = {
    {"Fac", Float, 0.5f}, {"Color1", Color, 0.5f}, {"Color2", Color, 0.5f}};
constexpr std::string_view kLegacyOutputs[] = {"Color"};

void emit_legacy_mix(NodeEmitter& e) {
  const Value t = e.emit(pure<&clamp01>, {e.input("Fac")});
  const Value c = blend(e, t, e.input("Color1"), e.input("Color2"));
  e.output("Color", e.flag("use_clamp") ? e.convert(e.emit(kClampVector, {c}), Color) : c);
}

}  // namespace

std::span<const NodeDecl> mix_nodes() {
  static const auto kBlends = names_of(kBlendModes);
  static constexpr std::string_view kData[] = {"FLOAT", "VECTOR", "RGBA"},
                                    kFactors[] = {"UNIFORM", "NON_UNIFORM"};
  static const EnumDecl kMix[] = {
      {"data_type", kData}, {"factor_mode", kFactors}, {"blend_type", kBlends}};
  static const EnumDecl kLegacy[] = {{"blend_type", kBlends}};
  static const NodeDecl kNodes[] = {
      {"MIX", kInputs, kOutputs, &emit_mix, nullptr, MixOp::None, kMix},
      {"MIX_RGB", kLegacyInputs, kLegacyOutputs, &emit_legacy_mix, nullptr, MixOp::None, kLegacy},
  };
  return kNodes;
}

}  // namespace janus
