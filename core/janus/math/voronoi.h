// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cellular noise (Worley 1996) in one to four dimensions, with a point in each cell of a grid:
// Cycles' functions, number for number.
#pragma once

#include "janus/math/white_noise.h"

namespace janus {

enum class VoronoiFeature { F1, F2, SmoothF1, DistanceToEdge, NSphereRadius };
enum class VoronoiMetric { Euclidean, Manhattan, Chebychev, Minkowski };

struct Voronoi {
  VoronoiFeature feature = VoronoiFeature::F1;
  VoronoiMetric metric = VoronoiMetric::Euclidean;
  // Octaves as those of a Fractal; `randomness`: how far points leave the grid, 0 to 1;
  // `smoothness`: of SmoothF1, 0 to 0.5; `exponent`: of Minkowski's metric.
  float detail = 0.0f, roughness = 0.5f, lacunarity = 2.0f;
  float smoothness = 0.5f, exponent = 0.5f, randomness = 1.0f;
  bool normalize = false;    // distances and colours in about [0, 1]
  bool old_points = false;   // as before Blender 5.0
  bool wants_color = false;  // or it is not computed
};

struct VoronoiPoint {
  float distance = 0.0f;
  vec3 color = vec3(0.0f);
  vec4 position = vec4(0.0f);  // what there are no dimensions for is 0; of one dimension it is w
};

// The closest point, the second, or a smooth blend.
template <int D>
VoronoiPoint voronoi_point(Coordinates<D> p, const Voronoi& voronoi);

// How far the side of the cell is.
template <int D>
float voronoi_edge(Coordinates<D> p, const Voronoi& voronoi);

// Half the distance of the closest point from the one that is closest to it.
template <int D>
float voronoi_radius(Coordinates<D> p, const Voronoi& voronoi);

}  // namespace janus
