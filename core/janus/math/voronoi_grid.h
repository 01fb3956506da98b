// SPDX-License-Identifier: GPL-3.0-or-later
//
// The grid behind cellular noise, and its points. For voronoi.cpp alone.
#pragma once

#include <array>

#include "janus/math/noise.h"
#include "janus/math/voronoi.h"

namespace janus {

constexpr int power(int base, int exponent) {
  return exponent == 0 ? 1 : base * power(base, exponent - 1);
}

// The cells at most `Reach` away along each axis, the first axis fastest.
template <int D, int Reach>
struct Offsets {
  static constexpr int kSide = 2 * Reach + 1, kCount = power(kSide, D);
  int32_t of[D][kCount];

  constexpr Offsets() : of{} {
    for (int i = 0; i < kCount; ++i) {
      for (int d = 0; d < D; ++d) {
        of[d][i] = i / power(kSide, d) % kSide - Reach;
      }
    }
  }
};
template <int D, int Reach>
constexpr Offsets<D, Reach> kOffsets;

// The random numbers of a cell: by the bits of its coordinates for `Old` and on a line, else by the
// integers that they are.
template <int D, bool Old>
struct Cell {
  static constexpr bool kBits = Old || D == 1;
  Coordinates<D> at;
  std::array<uint32_t, D> words;

  explicit Cell(Coordinates<D> corner) : at(corner) {
    for (int d = 0; d < D; ++d) {
      words[d] = static_cast<uint32_t>(to_integer(corner[d]));
    }
  }
  // Another one, so many cells further on.
  Cell(const Cell& cell, const int32_t* offset, int stride) : at(cell.at), words(cell.words) {
    for (int d = 0; d < D; ++d) {
      at[d] += static_cast<float>(offset[d * stride]);
      words[d] += static_cast<uint32_t>(offset[d * stride]);
    }
  }
  // Where its point lies in it.
  Coordinates<D> point() const {
    if constexpr (kBits) {
      return white_point(at);
    } else {
      return numbers<D>(words);
    }
  }
  vec3 color() const {
    if constexpr (kBits) {
      return white_color(at);
    } else if constexpr (D == 2) {
      return numbers<3>({words[0], words[1], 0});
    } else {
      return vec3(numbers<D>(words));
    }
  }

 private:
  template <int N>
  static Coordinates<N> numbers(std::array<uint32_t, N> from) {
    from = pcg_hash(from);
    Coordinates<N> result;
    for (int d = 0; d < N; ++d) {
      result[d] = static_cast<float>(static_cast<int32_t>(from[d])) * (1.0f / 2147483647.0f);
    }
    return result;
  }
};

// A place on the grid: its cell, and where it lies in it. Everything else is relative to the cell,
// because floats are finer there.
template <int D, bool Old>
struct Place {
  explicit Place(Coordinates<D> p) : cell(glm::floor(p)), local(p - cell.at) {}

  Cell<D, Old> cell;
  Coordinates<D> local;
};

// The points of the cells around. Component by component, for the compiler to take several points
// at once.
template <int D, int Reach, bool Old>
struct Points {
  static constexpr int kCount = Offsets<D, Reach>::kCount;
  float of[D][kCount];

  Points() = default;
  Points(const Cell<D, Old>& center, float randomness) {
    for (int i = 0; i < kCount; ++i) {
      const auto& offsets = kOffsets<D, Reach>.of;
      const Coordinates<D> p = Cell<D, Old>(center, &offsets[0][i], kCount).point();
      for (int d = 0; d < D; ++d) {
        of[d][i] = static_cast<float>(offsets[d][i]) + p[d] * randomness;
      }
    }
  }
  Coordinates<D> operator[](int i) const {
    Coordinates<D> result;
    for (int d = 0; d < D; ++d) {
      result[d] = of[d][i];
    }
    return result;
  }
};

// Of all points from one: numbers that grow with the distance, before the root is drawn of them.
template <int D, int N>
struct Distances {
  float of[N];

  template <class P>
  Distances(const P& points, Coordinates<D> from, VoronoiMetric metric, float exponent = 2.0f) {
    const auto add_up = [&](auto part, auto join) {
      for (int i = 0; i < N; ++i) {
        float sum = part(points.of[0][i] - from[0]);
        for (int d = 1; d < D; ++d) {
          sum = join(sum, part(points.of[d][i] - from[d]));
        }
        of[i] = sum;
      }
    };
    const auto size = [](float x) { return std::abs(x); };
    const auto power = [=](float x) { return std::pow(std::abs(x), exponent); };
    const auto plus = [](float a, float b) { return a + b; };
    switch (metric) {
      case VoronoiMetric::Manhattan:
        add_up(size, plus);
        return;
      case VoronoiMetric::Chebychev:
        add_up(size, [](float a, float b) { return a > b ? a : b; });
        return;
      case VoronoiMetric::Minkowski:
        add_up(power, plus);
        return;
      case VoronoiMetric::Euclidean:
        break;
    }
    add_up([](float x) { return x * x; }, plus);
  }
};

}  // namespace janus
