// SPDX-License-Identifier: GPL-3.0-or-later
//
// Textures in one to four dimensions: what they have in common.
#pragma once

#include <algorithm>
#include <string_view>

#include "janus/math/white_noise.h"
#include "janus/shading/node_emitter.h"

namespace janus {

inline constexpr std::string_view kDimensions[] = {"1D", "2D", "3D", "4D"};

// Of the inputs Vector and W those that count.
template <int D>
Coordinates<D> coordinates(vec3 v, float w) {
  if constexpr (D == 1) {
    return Coordinates<1>(w);
  } else if constexpr (D == 4) {
    return vec4(v, w);
  } else {
    return Coordinates<D>(v);
  }
}

// The same operation in the four numbers of dimensions.
struct Dimensional {
  Operation operations[4];
  const Operation& operator[](int dimensions) const { return operations[dimensions - 1]; }
};

// "3D" -> 3
inline int dimensions_of(std::string_view name) { return name[0] - '0'; }

// Vector and W, or noughts for what does not count.
inline Value used_vector(NodeEmitter& e, int dimensions) {
  return dimensions == 1 ? e.constant(vec3(0.0f)) : e.input("Vector");
}
inline Value used_w(NodeEmitter& e, int dimensions) {
  return dimensions == 2 || dimensions == 3 ? e.constant(0.0f) : e.input("W");
}

// The place of an item in a list that has it.
template <size_t N>
uint32_t number_of(const std::string_view (&items)[N], std::string_view item) {
  return static_cast<uint32_t>(std::ranges::find(items, item) - items);
}

inline constexpr Operation kFirst = pure<[](vec3 v) { return v.x; }>;

}  // namespace janus
