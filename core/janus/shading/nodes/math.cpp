// SPDX-License-Identifier: GPL-3.0-or-later
//
// Numbers: Math, Clamp, Map Range, Float Curve. Where an operation is not defined, Blender gives 0.
#include <algorithm>
#include <cmath>

#include "janus/shading/node_emitter.h"
#include "janus/shading/nodes/families.h"
#include "janus/shading/scalar.h"

namespace janus {

namespace {

using enum SocketType;

constexpr std::string_view kValue[] = {"Value"}, kResult[] = {"Result"};

// --- Math ----------------------------------------------------------------------------------------

constexpr SocketDecl kMathInputs[] = {
    {"Value", Float, 0.5f}, {"Value_001", Float, 0.5f}, {"Value_002", Float, 0.5f}};

struct MathMode {
  std::string_view name;
  Operation operation;
};

// The signs and limits are Blender's.
const MathMode kMathModes[] = {
    {"ADD", pure<[](float a, float b) { return a + b; }>},
    {"SUBTRACT", pure<[](float a, float b) { return a - b; }>},
    {"MULTIPLY", pure<[](float a, float b) { return a * b; }>},
    {"DIVIDE", pure<&safe_divide>},
    {"MULTIPLY_ADD", pure<[](float a, float b, float c) { return a * b + c; }>},
    {"POWER", pure<&safe_power>},
    {"LOGARITHM", pure<&safe_logarithm>},
    {"SQRT", pure<[](float a) { return std::sqrt(std::max(a, 0.0f)); }>},
    {"INVERSE_SQRT", pure<[](float a) { return 0.0f < a ? 1.0f / std::sqrt(a) : 0.0f; }>},
    {"ABSOLUTE", pure<[](float a) { return std::abs(a); }>},
    {"EXPONENT", pure<[](float a) { return std::exp(a); }>},
    {"MINIMUM", pure<[](float a, float b) { return std::min(a, b); }>},
    {"MAXIMUM", pure<[](float a, float b) { return std::max(a, b); }>},
    {"LESS_THAN", pure<[](float a, float b) { return a < b ? 1.0f : 0.0f; }>},
    {"GREATER_THAN", pure<[](float a, float b) { return b < a ? 1.0f : 0.0f; }>},
    {"SIGN", pure<[](float a) { return a < 0.0f    ? -1.0f
                                       : a == 0.0f ? 0.0f
                                                   : 1.0f; }>},
    {"COMPARE", pure<[](float a, float b, float c) {
       return a == b || std::abs(a - b) <= std::max(c, 1.1920929e-7f) ? 1.0f : 0.0f;
     }>},
    {"SMOOTH_MIN", pure<&smooth_minimum>},
    {"SMOOTH_MAX", pure<[](float a, float b, float c) { return -smooth_minimum(-a, -b, c); }>},
    {"ROUND", pure<[](float a) { return std::floor(a + 0.5f); }>},
    {"FLOOR", pure<[](float a) { return std::floor(a); }>},
    {"CEIL", pure<[](float a) { return std::ceil(a); }>},
    {"TRUNC", pure<[](float a) { return std::trunc(a); }>},
    {"FRACT", pure<[](float a) { return a - std::floor(a); }>},
    {"MODULO", pure<&safe_modulo>},
    {"FLOORED_MODULO", pure<&safe_floored_modulo>},
    {"WRAP", pure<&wrap>},
    {"SNAP", pure<[](float a, float b) { return std::floor(safe_divide(a, b)) * b; }>},
    {"PINGPONG", pure<&ping_pong>},
    {"SINE", pure<[](float a) { return std::sin(a); }>},
    {"COSINE", pure<[](float a) { return std::cos(a); }>},
    {"TANGENT", pure<[](float a) { return std::tan(a); }>},
    {"ARCSINE", pure<[](float a) { return std::asin(std::clamp(a, -1.0f, 1.0f)); }>},
    {"ARCCOSINE", pure<[](float a) { return std::acos(std::clamp(a, -1.0f, 1.0f)); }>},
    {"ARCTANGENT", pure<[](float a) { return std::atan(a); }>},
    {"ARCTAN2", pure<[](float a, float b) { return std::atan2(a, b); }>},
    {"SINH", pure<[](float a) { return std::sinh(a); }>},
    {"COSH", pure<[](float a) { return std::cosh(a); }>},
    {"TANH", pure<[](float a) { return std::tanh(a); }>},
    {"RADIANS", pure<[](float a) { return a * (kPi / 180.0f); }>},
    {"DEGREES", pure<[](float a) { return a * (180.0f / kPi); }>},
};

void emit_math(NodeEmitter& e) {
  const Operation& operation = find_mode(kMathModes, e.property("operation", "ADD")).operation;
  // What the operation does not take is not asked for.
  const int count = operation.count;
  const Value a = e.input("Value");
  const Value b = count > 1 ? e.input("Value_001") : a, c = count > 2 ? e.input("Value_002") : a;
  const Value result = e.emit(operation, {a, b, c});
  e.output("Value", e.flag("use_clamp") ? e.emit(pure<&clamp01>, {result}) : result);
}

// --- Clamp ---------------------------------------------------------------------------------------

constexpr SocketDecl kClampInputs[] = {
    {"Value", Float, 1.0f}, {"Min", Float, 0.0f}, {"Max", Float, 1.0f}};

constexpr Operation kClampMinMax =
    pure<[](float x, float low, float high) { return std::min(std::max(x, low), high); }>;
constexpr Operation kClampRange = pure<[](float x, float a, float b) {
  return b < a ? std::clamp(x, b, a) : std::min(std::max(x, a), b);
}>;

void emit_clamp(NodeEmitter& e) {
  const bool range = e.property("clamp_type", "MINMAX") == "RANGE";
  e.output("Result", e.emit(range ? kClampRange : kClampMinMax,
                            {e.input("Value"), e.input("Min"), e.input("Max")}));
}

// --- Map Range -----------------------------------------------------------------------------------

constexpr SocketDecl kMapRangeInputs[] = {{"Value", Float, 1.0f},
                                          {"From Min", Float, 0.0f},
                                          {"From Max", Float, 1.0f},
                                          {"To Min", Float, 0.0f},
                                          {"To Max", Float, 1.0f},
                                          {"Steps", Float, 4.0f},
                                          {"Vector", Vector, 0.0f},
                                          {"From_Min_FLOAT3", Vector, 0.0f},
                                          {"From_Max_FLOAT3", Vector, 1.0f},
                                          {"To_Min_FLOAT3", Vector, 0.0f},
                                          {"To_Max_FLOAT3", Vector, 1.0f},
                                          {"Steps_FLOAT3", Vector, 4.0f}};
constexpr std::string_view kMapRangeOutputs[] = {"Result", "Vector"};

// How far x is from `a` to `b`; 0 where these are the same.
float fraction(float x, float a, float b) { return a == b ? 0.0f : (x - a) / (b - a); }

float remap(float t, float a, float b) { return a + t * (b - a); }

float map_linear(float x, float a, float b, float c, float d, float) {
  return remap(fraction(x, a, b), c, d);
}
float map_stepped(float x, float a, float b, float c, float d, float steps) {
  const float t = fraction(x, a, b);
  return remap(steps > 0.0f ? std::floor(t * (steps + 1.0f)) / steps : 0.0f, c, d);
}
float smootherstep(float x, float a, float b) {
  const float t = a == b ? 0.0f : std::clamp((x - a) / (b - a), 0.0f, 1.0f);
  return t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f);
}
// A range that runs backwards is turned round.
float map_smooth(float x, float a, float b, float c, float d, float) {
  return remap(a > b ? 1.0f - smoothstep(x, b, a) : smoothstep(x, a, b), c, d);
}
float map_smoother(float x, float a, float b, float c, float d, float) {
  return remap(a > b ? 1.0f - smootherstep(x, b, a) : smootherstep(x, a, b), c, d);
}

template <auto F>
vec3 by_component(vec3 x, vec3 a, vec3 b, vec3 c, vec3 d, vec3 steps) {
  vec3 out;
  for (int i = 0; i < 3; ++i) {
    out[i] = F(x[i], a[i], b[i], c[i], d[i], steps[i]);
  }
  return out;
}

struct RangeMode {
  std::string_view name;
  Operation scalar, vector;
};
const RangeMode kRangeModes[] = {
    {"LINEAR", pure<&map_linear>, pure<&by_component<&map_linear>>},
    {"STEPPED", pure<&map_stepped>, pure<&by_component<&map_stepped>>},
    {"SMOOTHSTEP", pure<&map_smooth>, pure<&by_component<&map_smooth>>},
    {"SMOOTHERSTEP", pure<&map_smoother>, pure<&by_component<&map_smoother>>},
};

constexpr Operation kClampVector =
    pure<[](vec3 x, vec3 a, vec3 b) { return glm::clamp(x, glm::min(a, b), glm::max(a, b)); }>;

constexpr Operation kUnlessEmpty =
    pure<[](float x, float from_low, float from_high) { return from_low != from_high ? x : 0.0f; }>;

void emit_map_range(NodeEmitter& e) {
  const RangeMode& used = find_mode(kRangeModes, e.property("interpolation_type", "LINEAR"));
  // Smooth steps stay inside by themselves.
  const bool clamp = e.flag("clamp") && (used.name == "LINEAR" || used.name == "STEPPED");
  if (e.property("data_type", "FLOAT") == "FLOAT_VECTOR") {
    const Value low = e.input("To_Min_FLOAT3"), high = e.input("To_Max_FLOAT3");
    const Value result =
        e.emit(used.vector, {e.input("Vector"), e.input("From_Min_FLOAT3"),
                             e.input("From_Max_FLOAT3"), low, high, e.input("Steps_FLOAT3")});
    e.output("Vector", clamp ? e.emit(kClampVector, {result, low, high}) : result);
    return;
  }
  const Value low = e.input("To Min"), high = e.input("To Max");
  const Value from_low = e.input("From Min"), from_high = e.input("From Max");
  Value result =
      e.emit(used.scalar, {e.input("Value"), from_low, from_high, low, high, e.input("Steps")});
  if (!e.flag("folded")) {  // by Blender, which maps an empty range to its lower end
    result = e.emit(kUnlessEmpty, {result, from_low, from_high});
  }
  e.output("Result", clamp ? e.emit(kClampRange, {result, low, high}) : result);
}

}  // namespace

std::span<const NodeDecl> math_nodes() {
  static const auto kOperations = names_of(kMathModes), kInterpolations = names_of(kRangeModes);
  static constexpr std::string_view kClamps[] = {"MINMAX", "RANGE"},
                                    kData[] = {"FLOAT", "FLOAT_VECTOR"};
  static const EnumDecl kMath[] = {{"operation", kOperations}},
                        kClamp[] = {{"clamp_type", kClamps}},
                        kRange[] = {{"interpolation_type", kInterpolations}, {"data_type", kData}};
  static const NodeDecl kNodes[] = {
      {"MATH", kMathInputs, kValue, &emit_math, nullptr, MixOp::None, kMath},
      {"CLAMP", kClampInputs, kResult, &emit_clamp, nullptr, MixOp::None, kClamp},
      {"MAP_RANGE", kMapRangeInputs, kMapRangeOutputs, &emit_map_range, nullptr, MixOp::None,
       kRange},
  };
  return kNodes;
}

}  // namespace janus
