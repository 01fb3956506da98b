// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/math/voronoi.h"

#include <algorithm>
#include <limits>
#include <type_traits>

#include "janus/math/voronoi_grid.h"

namespace janus {

namespace {

constexpr float kFar = std::numeric_limits<float>::max();

float root(float x, VoronoiMetric metric, float exponent) {
  switch (metric) {
    case VoronoiMetric::Manhattan:
    case VoronoiMetric::Chebychev:
      return x;
    case VoronoiMetric::Minkowski:
      return std::pow(x, 1.0f / exponent);
    case VoronoiMetric::Euclidean:
      break;
  }
  return std::sqrt(x);
}

struct Closest {
  float distance = kFar;
  int index = -1;
};

template <int D>
vec4 position(Coordinates<D> p) {
  if constexpr (D == 1) {
    return vec4(0.0f, 0.0f, 0.0f, p.x);
  } else {
    vec4 result(0.0f);
    for (int d = 0; d < D; ++d) {
      result[d] = p[d];
    }
    return result;
  }
}

// On a line all metrics are one.
template <int D>
VoronoiMetric metric_of(const Voronoi& v) {
  return D == 1 ? VoronoiMetric::Manhattan : v.metric;
}

template <int D, bool Old>
VoronoiPoint sharp(const Place<D, Old>& place, const Voronoi& v) {
  const VoronoiMetric metric = metric_of<D>(v);
  const Points<D, 1, Old> points(place.cell, v.randomness);
  Distances<D, points.kCount> distances(points, place.local, metric, v.exponent);
  const bool second = v.feature == VoronoiFeature::F2;
  // Not all exponents leave the order as it is; then it matters that Cycles draws roots for F2.
  const bool rooted = second && metric == VoronoiMetric::Minkowski;
  Closest first, next;
  for (int i = 0; i < points.kCount; ++i) {
    const float d = rooted ? root(distances.of[i], metric, v.exponent) : distances.of[i];
    if (d < first.distance) {
      next = first;
      first = {d, i};
    } else if (d < next.distance) {
      next = {d, i};
    }
  }
  const Closest found = second ? next : first;
  if (found.index < 0) {  // nothing here is a number
    return {found.distance, place.cell.color(), position<D>(place.cell.at)};
  }
  VoronoiPoint result;
  result.distance = rooted ? found.distance : root(found.distance, metric, v.exponent);
  if (v.wants_color) {
    const int32_t* offset = &kOffsets<D, 1>.of[0][found.index];
    result.color = Cell<D, Old>(place.cell, offset, points.kCount).color();
  }
  result.position = position<D>(points[found.index] + place.cell.at);
  return result;
}

float smooth(float x) { return x < 0.0f ? 0.0f : x >= 1.0f ? 1.0f : x * x * (3.0f - 2.0f * x); }

// A smooth minimum: one point after the other is blended in.
template <int D, bool Old>
VoronoiPoint blended(const Place<D, Old>& place, const Voronoi& v) {
  const VoronoiMetric metric = metric_of<D>(v);
  const Points<D, 2, Old> points(place.cell, v.randomness);
  Distances<D, points.kCount> distances(points, place.local, metric, v.exponent);
  float nearest = 0.0f;
  vec3 color(0.0f);
  Coordinates<D> p(0.0f);
  for (int i = 0; i < points.kCount; ++i) {
    const float d = root(distances.of[i], metric, v.exponent);
    const float h = i == 0 ? 1.0f : smooth(0.5f + 0.5f * (nearest - d) / v.smoothness);
    if (h == 0.0f) {
      continue;
    }
    const float dip = v.smoothness * h * (1.0f - h), weak_dip = dip / (1.0f + 3.0f * v.smoothness);
    nearest += h * (d - nearest) - dip;
    if (v.wants_color) {
      const int32_t* offset = &kOffsets<D, 2>.of[0][i];
      const vec3 other = Cell<D, Old>(place.cell, offset, points.kCount).color();
      color += h * (other - color) - weak_dip;
    }
    p += h * (points[i] - p) - weak_dip;
  }
  return {nearest, color, position<D>(place.cell.at + p)};
}

template <int D, bool Old>
VoronoiPoint octave(Coordinates<D> p, const Voronoi& v) {
  const bool blends = v.feature == VoronoiFeature::SmoothF1 && v.smoothness != 0.0f;
  return blends ? blended(Place<D, Old>(p), v) : sharp(Place<D, Old>(p), v);
}

// The point that is closest by Euclid; the corner of the cell if nothing is a number.
template <int D>
Closest closest(const auto& points, Coordinates<D> from) {
  constexpr int kCount = std::remove_cvref_t<decltype(points)>::kCount;
  const Distances<D, kCount> distances(points, from, VoronoiMetric::Euclidean);
  Closest result;
  for (int i = 0; i < kCount; ++i) {
    if (distances.of[i] < result.distance) {
      result = {distances.of[i], i};
    }
  }
  return result;
}

template <int D, bool Old>
float edge(Coordinates<D> p, const Voronoi& v) {
  const Place<D, Old> place(p);
  const Points<D, 1, Old> points(place.cell, v.randomness);
  const int first = closest<D>(points, place.local).index;
  const Coordinates<D> here = first < 0 ? Coordinates<D>(0.0f) : points[first] - place.local;
  // Points on top of each other have no side in between; on a line Cycles sees one even then.
  constexpr float kApart = D == 1 ? 0.0f : 0.0001f;
  float sides[points.kCount];
  for (int i = 0; i < points.kCount; ++i) {
    float apart = 0.0f, along = 0.0f;
    for (int d = 0; d < D; ++d) {
      const float to = points.of[d][i] - place.local[d], across = to - here[d];
      apart += across * across;
      along += 0.5f * (here[d] + to) * across;
    }
    const float side = along / std::sqrt(apart);
    sides[i] = apart > kApart ? side : kFar;
  }
  float nearest = kFar;
  for (const float side : sides) {
    nearest = std::min(nearest, side);
  }
  return nearest;
}

template <int D, bool Old>
float radius(Coordinates<D> p, const Voronoi& v) {
  const Place<D, Old> place(p);
  Points<D, 1, Old> points(place.cell, v.randomness);
  const int first = std::max(closest<D>(points, place.local).index, 0);
  const int32_t* offset = &kOffsets<D, 1>.of[0][first];
  const Cell<D, Old> cell(place.cell, offset, points.kCount);
  // Relative to the closest point's cell, whose own point is in the middle, and does not count.
  points = Points<D, 1, Old>(cell, v.randomness);
  const int middle = points.kCount / 2;
  const Coordinates<D> center = points[middle];
  points.of[0][middle] = kInfinity;
  return 0.5f * std::sqrt(closest<D>(points, center).distance);
}

template <class T>
T lerp(T a, T b, float t) {
  return a + t * (b - a);
}

}  // namespace

template <int D>
VoronoiPoint voronoi_point(Coordinates<D> p, const Voronoi& v) {
  const auto at = [&](float scale) {
    return v.old_points ? octave<D, true>(p * scale, v) : octave<D, false>(p * scale, v);
  };
  VoronoiPoint result;
  float weight = 1.0f, weights = 0.0f, scale = 1.0f;
  if (v.detail == 0.0f || v.roughness == 0.0f) {
    result = at(1.0f);
    weights = 1.0f;
  } else {
    for (float i = 0.0f; i <= v.detail; i += 1.0f) {
      const VoronoiPoint o = at(scale);
      weights += weight;
      result.distance += o.distance * weight;
      result.color += o.color * weight;
      result.position = lerp(result.position, o.position / scale, weight);
      scale *= v.lacunarity;
      weight *= v.roughness;
    }
    if (const float rest = v.detail - std::floor(v.detail); rest != 0.0f) {
      const VoronoiPoint o = at(scale);
      weights += rest * weight;
      result.distance += rest * o.distance * weight;
      result.color += rest * o.color * weight;
      result.position += rest * weight * (o.position / scale - result.position);
    }
  }
  if (v.normalize) {
    struct {
      float of[D][1];
    } corner;
    for (auto& x : corner.of) {
      x[0] = 0.5f + 0.5f * v.randomness;
    }
    const Distances<D, 1> far(corner, Coordinates<D>(0.0f), metric_of<D>(v), v.exponent);
    const float farthest = root(far.of[0], metric_of<D>(v), v.exponent) *
                           (v.feature == VoronoiFeature::F2 ? 2.0f : 1.0f);
    result.distance /= weights * farthest;
    result.color /= weights;
  }
  return result;
}

template <int D>
float voronoi_edge(Coordinates<D> p, const Voronoi& v) {
  const auto at = [&](float scale) {
    return v.old_points ? edge<D, true>(p * scale, v) : edge<D, false>(p * scale, v);
  };
  const float farthest = 0.5f + 0.5f * v.randomness;
  float weight = 1.0f, limit = farthest, scale = 1.0f, nearest = 8.0f;
  if (v.detail == 0.0f || v.roughness == 0.0f) {
    nearest = at(1.0f);
  } else {
    for (float i = 0.0f; i <= v.detail; i += 1.0f) {
      limit = lerp(limit, farthest / scale, weight);
      nearest = lerp(nearest, std::min(nearest, at(scale) / scale), weight);
      scale *= v.lacunarity;
      weight *= v.roughness;
    }
    if (const float rest = v.detail - std::floor(v.detail); rest != 0.0f) {
      limit = lerp(limit, lerp(limit, farthest / scale, weight), rest);
      const float finer = lerp(nearest, std::min(nearest, at(scale) / scale), weight);
      nearest = lerp(nearest, std::min(nearest, finer), rest);
    }
  }
  return v.normalize ? nearest / limit : nearest;
}

template <int D>
float voronoi_radius(Coordinates<D> p, const Voronoi& v) {
  return v.old_points ? radius<D, true>(p, v) : radius<D, false>(p, v);
}

template VoronoiPoint voronoi_point<1>(Coordinates<1>, const Voronoi&);
template VoronoiPoint voronoi_point<2>(Coordinates<2>, const Voronoi&);
template VoronoiPoint voronoi_point<3>(Coordinates<3>, const Voronoi&);
template VoronoiPoint voronoi_point<4>(Coordinates<4>, const Voronoi&);
template float voronoi_edge<1>(Coordinates<1>, const Voronoi&);
template float voronoi_edge<2>(Coordinates<2>, const Voronoi&);
template float voronoi_edge<3>(Coordinates<3>, const Voronoi&);
template float voronoi_edge<4>(Coordinates<4>, const Voronoi&);
template float voronoi_radius<1>(Coordinates<1>, const Voronoi&);
template float voronoi_radius<2>(Coordinates<2>, const Voronoi&);
template float voronoi_radius<3>(Coordinates<3>, const Voronoi&);
template float voronoi_radius<4>(Coordinates<4>, const Voronoi&);

}  // namespace janus
