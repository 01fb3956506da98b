// SPDX-License-Identifier: GPL-3.0-or-later
//
// IES Texture: how bright a luminaire is in each direction, by a measured table.
#include <algorithm>
#include <cmath>

#include "janus/shading/node_emitter.h"
#include "janus/shading/nodes/families.h"
#include "janus/shading/rotation.h"

namespace janus {

namespace {

using enum SocketType;

constexpr SocketDecl kInputs[] = {{"Vector", Vector, Implicit::Beam}, {"Strength", Float, 1.0f}};
constexpr std::string_view kFactor[] = {"Fac"};
constexpr std::string_view kModes[] = {"INTERNAL", "EXTERNAL"};  // the graph has what was read
constexpr EnumDecl kSettings[] = {{"mode", kModes}};
constexpr float kWithout = 100.0f;  // Cycles' value without a table

// Catmull and Rom's curve from b to c.
float cubic(float a, float b, float c, float d, float x) {
  return 0.5f *
             (((d + 3.0f * (b - c) - a) * x + (2.0f * a - 5.0f * b + 4.0f * c - d)) * x + (c - a)) *
             x +
         b;
}

// One kind of angle of the table, increasing.
struct Angles {
  const float* values;
  int count;

  float last() const { return values[count - 1]; }
  bool hold(float angle) const { return angle >= values[0] && angle < last(); }
  // Of an angle that they hold: the number of the one before it, and the part of the way from
  // there.
  int before(float angle) const {
    return static_cast<int>(std::lower_bound(values + 1, values + count - 1, angle) - values) - 1;
  }
  float part(int i, float angle) const { return (angle - values[i]) / (values[i + 1] - values[i]); }
};

// A table: the numbers of horizontal and of vertical angles, these angles, and for each horizontal
// one a row of values.
struct Luminaire {
  Angles horizontal, vertical;
  const float* values;

  explicit Luminaire(const std::vector<float>& table)
      : horizontal{table.data() + 2, static_cast<int>(table[0])},
        vertical{horizontal.values + horizontal.count, static_cast<int>(table[1])},
        values(vertical.values + vertical.count) {}

  // On the row of a horizontal angle. Across a pole Cycles goes on as if both sides were alike.
  float along(int row, int i, float x) const {
    const float* v = values + static_cast<ptrdiff_t>(row) * vertical.count;
    const bool to_pole = vertical.values[0]<1e-7f, from_pole = vertical.last()> kPi - 1e-7f;
    const float b = v[i], c = v[i + 1];
    const float a = i > 0 ? v[i - 1] : to_pole ? v[1] : b;
    const float d = i + 2 < vertical.count ? v[i + 2] : from_pole ? v[vertical.count - 2] : c;
    return cubic(a, b, c, d, x);
  }

  float at(float around, float down) const {
    if (!vertical.hold(down) || !horizontal.hold(around)) {
      return 0.0f;
    }
    const bool closed = horizontal.values[0] < 1e-7f && horizontal.last() > 2.0f * kPi - 1e-7f;
    const int h = horizontal.before(around), v = vertical.before(down);
    const float x = vertical.part(v, down);
    const float b = along(h, v, x), c = along(h + 1, v, x);
    const float a = h > 0 ? along(h - 1, v, x) : closed ? along(horizontal.count - 2, v, x) : b;
    const float d = h + 2 < horizontal.count ? along(h + 2, v, x) : closed ? along(1, v, x) : b;
    return std::max(0.0f, cubic(a, b, c, d, horizontal.part(h, around)));
  }
};

// Down is -z. `data`: the table.
float luminaire(const Context& c, vec3 v) {
  v = safe_normalize(v);
  const float down = std::acos(std::clamp(-v.z, -1.0f, 1.0f));
  return Luminaire(c.program.tables[c.data]).at(std::atan2(v.x, v.y) + kPi, down);
}

// As whoever wrote the graph has to give it.
bool usable(const std::vector<float>& table) {
  if (table.size() < 2 || !std::ranges::all_of(table, [](float x) { return std::isfinite(x); })) {
    return false;
  }
  const double h = table[0], v = table[1];
  return h >= 1.0 && v >= 1.0 && h == std::floor(h) && v == std::floor(v) &&
         2.0 + h + v + h * v == static_cast<double>(table.size());
}

void emit_ies(NodeEmitter& e) {
  const std::vector<float>* table = e.list("ies");
  Value value = e.constant(kWithout);
  if (table && usable(*table)) {
    value = e.emit(pure<&luminaire>, {e.input("Vector")}, e.table(*table));
  } else {
    const std::string why = e.property("ies_error", "its table is none");
    e.warn("the IES file is left out: " + why + "; the value is 100, as in Cycles");
  }
  constexpr static Operation kTimes = pure<[](float a, float b) { return a * b; }>;
  e.output("Fac", e.emit(kTimes, {e.input("Strength"), value}));
}

}  // namespace

std::span<const NodeDecl> ies_nodes() {
  static const NodeDecl kNodes[] = {
      {"TEX_IES", kInputs, kFactor, &emit_ies, nullptr, MixOp::None, kSettings},
  };
  return kNodes;
}

}  // namespace janus
