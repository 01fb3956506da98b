// SPDX-License-Identifier: GPL-3.0-or-later
//
// Textures in one to four dimensions: what they have in common.
#pragma once

#include <string_view>

#include "janus/math/noise.h"
#include "janus/shading/operation.h"

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

inline constexpr Operation kFirst = pure<[](vec3 v) { return v.x; }>;

}  // namespace janus
