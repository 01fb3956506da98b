// SPDX-License-Identifier: GPL-3.0-or-later
//
// Colours: conversions, corrections, Separate and Combine.
#include <algorithm>
#include <cmath>

#include "janus/shading/node_emitter.h"
#include "janus/shading/nodes/color_space.h"
#include "janus/shading/nodes/families.h"
#include "janus/shading/scalar.h"

namespace janus {

namespace {

using enum SocketType;

constexpr std::string_view kColor[] = {"Color"}, kValue[] = {"Val"};
constexpr SocketDecl kColorInput[] = {{"Color", Color, 0.5f}};

void put_color(NodeEmitter& e, std::string_view identifier, Value value) {
  e.output(identifier, e.convert(value, Color));
}

// --- Corrections ---------------------------------------------------------------------------------

constexpr SocketDecl kHueSaturationInputs[] = {{"Hue", Float, 0.5f},
                                               {"Saturation", Float, 1.0f},
                                               {"Value", Float, 1.0f},
                                               {"Fac", Float, 1.0f},
                                               {"Color", Color, 0.8f}};

vec3 hue_saturation(float hue, float saturation, float value, float factor, vec3 color) {
  vec3 hsv = rgb_to_hsv(color);
  const float h = hsv.x + hue + 0.5f;
  hsv.x = h - std::floor(h);
  hsv.y = clamp01(hsv.y * saturation);
  hsv.z *= value;
  return glm::max(vec3(0.0f), factor * hsv_to_rgb(hsv) + (1.0f - factor) * color);
}

void emit_hue_saturation(NodeEmitter& e) {
  put_color(e, "Color",
            e.emit(pure<&hue_saturation>, {e.input("Hue"), e.input("Saturation"), e.input("Value"),
                                           e.input("Fac"), e.input("Color")}));
}

constexpr SocketDecl kBrightContrastInputs[] = {
    {"Color", Color, 1.0f}, {"Bright", Float, 0.0f}, {"Contrast", Float, 0.0f}};
constexpr Operation kBrightContrast = pure<[](vec3 color, float bright, float contrast) {
  return glm::max((1.0f + contrast) * color + (bright - 0.5f * contrast), vec3(0.0f));
}>;

void emit_bright_contrast(NodeEmitter& e) {
  put_color(e, "Color",
            e.emit(kBrightContrast, {e.input("Color"), e.input("Bright"), e.input("Contrast")}));
}

constexpr SocketDecl kGammaInputs[] = {{"Color", Color, 1.0f}, {"Gamma", Float, 1.0f}};

vec3 gamma_correct(vec3 color, float gamma) {
  if (gamma == 0.0f) {
    return vec3(1.0f);
  }
  for (int i = 0; i < 3; ++i) {
    color[i] = color[i] > 0.0f ? std::pow(color[i], gamma) : color[i];
  }
  return color;
}

void emit_gamma(NodeEmitter& e) {
  put_color(e, "Color", e.emit(pure<&gamma_correct>, {e.input("Color"), e.input("Gamma")}));
}

constexpr SocketDecl kInvertInputs[] = {{"Fac", Float, 1.0f}, {"Color", Color, 0.0f}};
constexpr Operation kInvert = pure<[](float factor, vec3 color) {
  return factor * (1.0f - color) + (1.0f - factor) * color;
}>;

void emit_invert(NodeEmitter& e) {
  put_color(e, "Color", e.emit(kInvert, {e.input("Fac"), e.input("Color")}));
}

void emit_rgb_to_bw(NodeEmitter& e) { e.output("Val", e.convert(e.input("Color"), Float)); }

// --- Separate, Combine ---------------------------------------------------------------------------

constexpr Operation kComponent[] = {pure<[](vec3 v) { return v.x; }>,
                                    pure<[](vec3 v) { return v.y; }>,
                                    pure<[](vec3 v) { return v.z; }>};
constexpr Operation kCombine = pure<[](float x, float y, float z) { return vec3(x, y, z); }>;

void separate(NodeEmitter& e, Value v, std::span<const std::string_view> outputs) {
  for (int i = 0; i < 3; ++i) {
    e.output(outputs[i], e.emit(kComponent[i], {v}));
  }
}

Value to_model(NodeEmitter& e, Value v, const std::string& model) {
  return model == "HSV"   ? e.emit(pure<&rgb_to_hsv>, {v})
         : model == "HSL" ? e.emit(pure<&rgb_to_hsl>, {v})
                          : v;
}
Value from_model(NodeEmitter& e, Value v, const std::string& model) {
  return model == "HSV"   ? e.emit(pure<&hsv_to_rgb>, {v})
         : model == "HSL" ? e.emit(pure<&hsl_to_rgb>, {v})
                          : v;
}

constexpr std::string_view kChannels[] = {"Red", "Green", "Blue"}, kXyz[] = {"X", "Y", "Z"},
                           kRgb[] = {"R", "G", "B"}, kHsv[] = {"H", "S", "V"},
                           kVector[] = {"Vector"}, kImage[] = {"Image"};
constexpr SocketDecl kChannelInputs[] = {{"Red", Float}, {"Green", Float}, {"Blue", Float}};
constexpr SocketDecl kXyzInputs[] = {{"X", Float}, {"Y", Float}, {"Z", Float}};
constexpr SocketDecl kRgbInputs[] = {{"R", Float}, {"G", Float}, {"B", Float}};
constexpr SocketDecl kHsvInputs[] = {{"H", Float}, {"S", Float}, {"V", Float}};
constexpr SocketDecl kVectorInput[] = {{"Vector", Vector}};
constexpr SocketDecl kImageInput[] = {{"Image", Color, 0.8f}};
constexpr SocketDecl kSeparateInput[] = {{"Color", Color, 0.8f}};

constexpr std::string_view kModels[] = {"RGB", "HSV", "HSL"};
constexpr EnumDecl kModel[] = {{"mode", kModels}};

Value combined(NodeEmitter& e, std::string_view x, std::string_view y, std::string_view z) {
  return e.emit(kCombine, {e.input(x), e.input(y), e.input(z)});
}

void emit_separate_color(NodeEmitter& e) {
  separate(e, to_model(e, e.input("Color"), e.property("mode", "RGB")), kChannels);
}
void emit_combine_color(NodeEmitter& e) {
  put_color(e, "Color",
            from_model(e, combined(e, "Red", "Green", "Blue"), e.property("mode", "RGB")));
}
void emit_separate_xyz(NodeEmitter& e) { separate(e, e.input("Vector"), kXyz); }
void emit_combine_xyz(NodeEmitter& e) { e.output("Vector", combined(e, "X", "Y", "Z")); }
void emit_separate_rgb(NodeEmitter& e) { separate(e, e.input("Image"), kRgb); }
void emit_combine_rgb(NodeEmitter& e) { put_color(e, "Image", combined(e, "R", "G", "B")); }
void emit_separate_hsv(NodeEmitter& e) { separate(e, to_model(e, e.input("Color"), "HSV"), kHsv); }
void emit_combine_hsv(NodeEmitter& e) {
  put_color(e, "Color", from_model(e, combined(e, "H", "S", "V"), "HSV"));
}

}  // namespace

std::span<const NodeDecl> color_nodes() {
  static const NodeDecl kNodes[] = {
      {"HUE_SAT", kHueSaturationInputs, kColor, &emit_hue_saturation},
      {"BRIGHTCONTRAST", kBrightContrastInputs, kColor, &emit_bright_contrast},
      {"GAMMA", kGammaInputs, kColor, &emit_gamma},
      {"INVERT", kInvertInputs, kColor, &emit_invert},
      {"RGBTOBW", kColorInput, kValue, &emit_rgb_to_bw},
      {"SEPARATE_COLOR", kSeparateInput, kChannels, &emit_separate_color, nullptr, MixOp::None,
       kModel},
      {"COMBINE_COLOR", kChannelInputs, kColor, &emit_combine_color, nullptr, MixOp::None, kModel},
      {"SEPXYZ", kVectorInput, kXyz, &emit_separate_xyz},
      {"COMBXYZ", kXyzInputs, kVector, &emit_combine_xyz},
      {"SEPRGB", kImageInput, kRgb, &emit_separate_rgb},
      {"COMBRGB", kRgbInputs, kImage, &emit_combine_rgb},
      {"SEPHSV", kSeparateInput, kHsv, &emit_separate_hsv},
      {"COMBHSV", kHsvInputs, kColor, &emit_combine_hsv},
  };
  return kNodes;
}

}  // namespace janus
