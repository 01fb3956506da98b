// SPDX-License-Identifier: GPL-3.0-or-later
//
// Color Ramp and the curves. Blender samples them, as Cycles has it do; what is left is to look up:
//   ramp   "table": RGBA for each of n positions from 0 to 1
//   curves "table": one to three values for each of n positions from "range_min" to "range_max"
#include <algorithm>
#include <cmath>

#include "janus/shading/node_emitter.h"
#include "janus/shading/nodes/families.h"

namespace janus {

namespace {

using enum SocketType;

// Tables start with their settings, so that one number finds all of it.
enum Header { kSteps, kChannels, kExtrapolate, kMinimum, kRange, kHeader };

float at(const std::vector<float>& table, int i, int channel) {
  return table[kHeader + static_cast<size_t>(i) * static_cast<size_t>(table[kChannels]) + channel];
}

// `x` in [0, 1] of the table.
float look_up(const std::vector<float>& table, float x, int channel, bool steps) {
  const int last = static_cast<int>(table[kSteps]) - 1;
  const auto size = static_cast<float>(last);
  if (table[kExtrapolate] != 0.0f && (x < 0.0f || x > 1.0f)) {
    const int end = x < 0.0f ? 0 : last, inner = x < 0.0f ? 1 : last - 1;
    const float value = at(table, end, channel);
    return value + (value - at(table, inner, channel)) * (x < 0.0f ? -x : x - 1.0f) * size;
  }
  const float f = std::clamp(x, 0.0f, 1.0f) * size;
  const int i = std::clamp(static_cast<int>(f), 0, last);
  const float t = f - static_cast<float>(i), value = at(table, i, channel);
  return steps || t <= 0.0f ? value : (1.0f - t) * value + t * at(table, i + 1, channel);
}

const std::vector<float>& table_of(const Context& c) { return c.program.tables[c.data]; }

// --- Color Ramp ----------------------------------------------------------------------------------

constexpr SocketDecl kRampInputs[] = {{"Fac", Float, 0.5f}};
constexpr std::string_view kRampOutputs[] = {"Color", "Alpha"};

template <bool Steps>
vec3 ramp_color(const Context& c, float x) {
  const auto& table = table_of(c);
  x = std::isfinite(x) ? x : 0.0f;
  return vec3(look_up(table, x, 0, Steps), look_up(table, x, 1, Steps),
              look_up(table, x, 2, Steps));
}
template <bool Steps>
float ramp_alpha(const Context& c, float x) {
  return look_up(table_of(c), std::isfinite(x) ? x : 0.0f, 3, Steps);
}

// Adds the node's table with its settings; nullopt: it has none.
std::optional<uint32_t> add_table(NodeEmitter& e, int channels, bool extrapolate, float minimum,
                                  float maximum) {
  const std::vector<float>* values = e.list("table");
  const size_t steps = values ? values->size() / channels : 0;
  if (steps < 2 || values->size() != steps * channels) {
    e.warn("its curve is missing; the node is left out");
    return std::nullopt;
  }
  std::vector<float> table = {static_cast<float>(steps), static_cast<float>(channels),
                              extrapolate ? 1.0f : 0.0f, minimum, maximum - minimum};
  table.insert(table.end(), values->begin(), values->end());
  return e.table(std::move(table));
}

void emit_ramp(NodeEmitter& e) {
  const Value x = e.input("Fac");
  const auto table = add_table(e, 4, false, 0.0f, 1.0f);
  if (!table) {
    return;
  }
  const bool steps = e.property("interpolation") == "CONSTANT";
  const Value color = steps ? e.emit(pure<&ramp_color<true>>, {x}, *table)
                            : e.emit(pure<&ramp_color<false>>, {x}, *table);
  e.output("Color", e.convert(color, Color));
  e.output("Alpha", steps ? e.emit(pure<&ramp_alpha<true>>, {x}, *table)
                          : e.emit(pure<&ramp_alpha<false>>, {x}, *table));
}

// --- Curves --------------------------------------------------------------------------------------

float on_curve(const std::vector<float>& table, float x, int channel) {
  const float range = table[kRange];
  const float place = range != 0.0f ? (x - table[kMinimum]) / range : 0.0f;
  return look_up(table, std::isfinite(place) ? place : 0.0f, channel, false);
}

vec3 three_curves(const Context& c, float factor, vec3 v) {
  const auto& table = table_of(c);
  const vec3 mapped(on_curve(table, v.x, 0), on_curve(table, v.y, 1), on_curve(table, v.z, 2));
  return (1.0f - factor) * v + factor * mapped;
}
float one_curve(const Context& c, float factor, float x) {
  return (1.0f - factor) * x + factor * on_curve(table_of(c), x, 0);
}

std::optional<uint32_t> add_curves(NodeEmitter& e, int channels) {
  const std::vector<float>* range = e.list("range");
  const bool known = range && range->size() == 2;
  return add_table(e, channels, e.property("extend") == "EXTRAPOLATED", known ? (*range)[0] : 0.0f,
                   known ? (*range)[1] : 1.0f);
}

constexpr SocketDecl kRgbInputs[] = {{"Fac", Float, 1.0f}, {"Color", Color, 1.0f}};
constexpr SocketDecl kVectorInputs[] = {{"Fac", Float, 1.0f}, {"Vector", Vector, 0.0f}};
constexpr SocketDecl kFloatInputs[] = {{"Factor", Float, 1.0f}, {"Value", Float, 1.0f}};
constexpr std::string_view kColorOutput[] = {"Color"}, kVectorOutput[] = {"Vector"},
                           kValueOutput[] = {"Value"};

void emit_rgb_curves(NodeEmitter& e) {
  if (const auto table = add_curves(e, 3)) {
    const Value c = e.emit(pure<&three_curves>, {e.input("Fac"), e.input("Color")}, *table);
    e.output("Color", e.convert(c, Color));
  }
}
void emit_vector_curves(NodeEmitter& e) {
  if (const auto table = add_curves(e, 3)) {
    e.output("Vector", e.emit(pure<&three_curves>, {e.input("Fac"), e.input("Vector")}, *table));
  }
}
void emit_float_curve(NodeEmitter& e) {
  if (const auto table = add_curves(e, 1)) {
    e.output("Value", e.emit(pure<&one_curve>, {e.input("Factor"), e.input("Value")}, *table));
  }
}

}  // namespace

std::span<const NodeDecl> curve_nodes() {
  static const NodeDecl kNodes[] = {
      {"VALTORGB", kRampInputs, kRampOutputs, &emit_ramp},
      {"CURVE_RGB", kRgbInputs, kColorOutput, &emit_rgb_curves},
      {"CURVE_VEC", kVectorInputs, kVectorOutput, &emit_vector_curves},
      {"CURVE_FLOAT", kFloatInputs, kValueOutput, &emit_float_curve},
  };
  return kNodes;
}

}  // namespace janus
