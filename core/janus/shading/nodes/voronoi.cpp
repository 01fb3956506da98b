// SPDX-License-Identifier: GPL-3.0-or-later
//
// Voronoi.
#include "janus/math/voronoi.h"

#include "janus/shading/nodes/coordinates.h"
#include "janus/shading/nodes/families.h"
#include "janus/shading/rotation.h"
#include "janus/shading/scalar.h"

namespace janus {

namespace {

using enum SocketType;

constexpr SocketDecl kInputs[] = {{"Vector", Vector, Implicit::Generated},
                                  {"W", Float, 0.0f},
                                  {"Scale", Float, 5.0f},
                                  {"Detail", Float, 0.0f},
                                  {"Roughness", Float, 0.5f},
                                  {"Lacunarity", Float, 2.0f},
                                  {"Smoothness", Float, 1.0f},
                                  {"Exponent", Float, 0.5f},
                                  {"Randomness", Float, 1.0f}};
constexpr std::string_view kOutputs[] = {"Distance", "Color", "Position", "W", "Radius"};
constexpr std::string_view kFeatures[] = {"F1", "F2", "SMOOTH_F1", "DISTANCE_TO_EDGE",
                                          "N_SPHERE_RADIUS"};
constexpr std::string_view kMetrics[] = {"EUCLIDEAN", "MANHATTAN", "CHEBYCHEV", "MINKOWSKI"};

// Of `data`, beside the feature and, from this bit on, the metric.
constexpr uint32_t kMetric = 3, kNormalize = 1u << 5, kOldPoints = 1u << 6;

// `Result`: what is asked of a place.
template <int D, auto Result>
auto voronoi_at(const Context& c, vec3 p, float w, float scale, float detail, float roughness,
                float lacunarity, float smoothness, float exponent, float randomness) {
  const Voronoi voronoi{.feature = static_cast<VoronoiFeature>(c.data & 7),
                        .metric = static_cast<VoronoiMetric>(c.data >> kMetric & 3),
                        .detail = limited(detail, 0.0f, 15.0f),
                        .roughness = clamp01(roughness),
                        .lacunarity = lacunarity,
                        .smoothness = 0.5f * clamp01(smoothness),
                        .exponent = exponent,
                        .randomness = clamp01(randomness),
                        .normalize = (c.data & kNormalize) != 0,
                        .old_points = (c.data & kOldPoints) != 0};
  return Result(coordinates<D>(p * scale, w * scale), voronoi, scale);
}
template <auto Result>
constexpr Dimensional kAt = {pure<&voronoi_at<1, Result>>, pure<&voronoi_at<2, Result>>,
                             pure<&voronoi_at<3, Result>>, pure<&voronoi_at<4, Result>>};

vec4 unscaled(vec4 position, float scale) { return scale != 0.0f ? position / scale : vec4(0.0f); }

constexpr auto kDistance = [](auto p, const Voronoi& v, float) {
  return voronoi_point(p, v).distance;
};
constexpr auto kColor = [](auto p, Voronoi v, float) {
  v.wants_color = true;
  return voronoi_point(p, v).color;
};
constexpr auto kPosition = [](auto p, const Voronoi& v, float scale) {
  return vec3(unscaled(voronoi_point(p, v).position, scale));
};
constexpr auto kW = [](auto p, const Voronoi& v, float scale) {
  return unscaled(voronoi_point(p, v).position, scale).w;
};
constexpr auto kEdge = [](auto p, const Voronoi& v, float) { return voronoi_edge(p, v); };
constexpr auto kRadius = [](auto p, const Voronoi& v, float) { return voronoi_radius(p, v); };

void emit_voronoi(NodeEmitter& e) {
  const int dimensions = dimensions_of(e.property("voronoi_dimensions", "3D"));
  const std::string feature = e.property("feature", "F1");
  const uint32_t data = number_of(kFeatures, feature) |
                        number_of(kMetrics, e.property("distance", "EUCLIDEAN")) << kMetric |
                        (e.flag("normalize") ? kNormalize : 0) |
                        (e.flag("old_points") ? kOldPoints : 0);
  const Value v = used_vector(e, dimensions), w = used_w(e, dimensions);
  const auto at = [&](const Dimensional& operations) {
    return e.emit(
        operations[dimensions],
        {v, w, e.input("Scale"), e.input("Detail"), e.input("Roughness"), e.input("Lacunarity"),
         e.input("Smoothness"), e.input("Exponent"), e.input("Randomness")},
        data);
  };
  // What a feature has no use for is 0.
  const bool edge = feature == "DISTANCE_TO_EDGE", radius = feature == "N_SPHERE_RADIUS";
  const Value nothing = e.constant(0.0f);
  e.output("Distance", edge ? at(kAt<kEdge>) : radius ? nothing : at(kAt<kDistance>));
  e.output("Color", e.convert(edge || radius ? nothing : at(kAt<kColor>), Color));
  e.output("Position", edge || radius ? e.convert(nothing, Vector) : at(kAt<kPosition>));
  e.output("W", edge || radius ? nothing : at(kAt<kW>));
  e.output("Radius", radius ? at(kAt<kRadius>) : nothing);
}

constexpr EnumDecl kSettings[] = {
    {"voronoi_dimensions", kDimensions}, {"feature", kFeatures}, {"distance", kMetrics}};

}  // namespace

std::span<const NodeDecl> voronoi_nodes() {
  static const NodeDecl kNodes[] = {
      {"TEX_VORONOI", kInputs, kOutputs, &emit_voronoi, nullptr, MixOp::None, kSettings},
  };
  return kNodes;
}

}  // namespace janus
