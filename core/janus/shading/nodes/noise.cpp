// SPDX-License-Identifier: GPL-3.0-or-later
//
// Random numbers of places: White Noise, Noise.
#include "janus/math/noise.h"
#include "janus/shading/node_emitter.h"
#include "janus/shading/nodes/coordinates.h"
#include "janus/shading/nodes/families.h"
#include "janus/shading/scalar.h"

namespace janus {

namespace {

using enum SocketType;

// --- White Noise ---------------------------------------------------------------------------------

constexpr SocketDecl kWhiteInputs[] = {{"Vector", Vector, 0.0f}, {"W", Float, 0.0f}};
constexpr std::string_view kWhiteOutputs[] = {"Value", "Color"};

template <int D>
float white_value(vec3 v, float w) {
  return white_number(coordinates<D>(v, w));
}
template <int D>
vec3 white_color_at(vec3 v, float w) {
  return white_color(coordinates<D>(v, w));
}

constexpr Dimensional kWhiteValue = {pure<&white_value<1>>, pure<&white_value<2>>,
                                     pure<&white_value<3>>, pure<&white_value<4>>};
constexpr Dimensional kWhiteColor = {pure<&white_color_at<1>>, pure<&white_color_at<2>>,
                                     pure<&white_color_at<3>>, pure<&white_color_at<4>>};

void emit_white_noise(NodeEmitter& e) {
  const int dimensions = dimensions_of(e.property("noise_dimensions", "3D"));
  const Value v = used_vector(e, dimensions), w = used_w(e, dimensions);
  e.output("Value", e.emit(kWhiteValue[dimensions], {v, w}));
  e.output("Color", e.convert(e.emit(kWhiteColor[dimensions], {v, w}), Color));
}

// --- Noise ---------------------------------------------------------------------------------------

constexpr SocketDecl kNoiseInputs[] = {{"Vector", Vector, Implicit::Generated},
                                       {"W", Float, 0.0f},
                                       {"Scale", Float, 5.0f},
                                       {"Detail", Float, 2.0f},
                                       {"Roughness", Float, 0.5f},
                                       {"Lacunarity", Float, 2.0f},
                                       {"Offset", Float, 0.0f},
                                       {"Gain", Float, 1.0f},
                                       {"Distortion", Float, 0.0f}};
constexpr std::string_view kNoiseOutputs[] = {"Fac", "Color"};
constexpr std::string_view kNoiseTypes[] = {"MULTIFRACTAL", "RIDGED_MULTIFRACTAL",
                                            "HYBRID_MULTIFRACTAL", "FBM", "HETERO_TERRAIN"};
constexpr uint32_t kNormalize = 8;  // of `data`, beside the type

// Far away from where one looks, in a direction of its own for each seed: other noise.
template <int D>
constexpr std::array<float, D> far_away(int seed) {
  std::array<float, D> result{};
  const float s = static_cast<float>(seed);
  for (int d = 0; d < D; ++d) {
    const float n = D == 1 ? jenkins_number(s) : jenkins_number(s, static_cast<float>(d));
    result[d] = 100.0f + 100.0f * n;
  }
  return result;
}
template <int D, int Seed>
Coordinates<D> elsewhere(Coordinates<D> p) {
  static constexpr auto kAway = far_away<D>(Seed);
  for (int d = 0; d < D; ++d) {
    p[d] += kAway[d];
  }
  return p;
}

// Each coordinate is moved by noise of its own.
template <int D, int... Seeds>
Coordinates<D> distorted(Coordinates<D> p, float distortion, std::integer_sequence<int, Seeds...>) {
  return p + distortion * Coordinates<D>(perlin_noise<D>(elsewhere<D, Seeds>(p))...);
}

template <int D>
Coordinates<D> noise_place(vec3 v, float w, float scale, float distortion) {
  const Coordinates<D> p = coordinates<D>(v * scale, w * scale);
  return distortion == 0.0f ? p : distorted<D>(p, distortion, std::make_integer_sequence<int, D>());
}

Fractal fractal_of(const Context& c, float detail, float roughness, float lacunarity, float offset,
                   float gain) {
  return {.type = static_cast<NoiseType>(c.data & ~kNormalize),
          .detail = limited(detail, 0.0f, 15.0f),
          .roughness = std::max(0.0f, roughness),
          .lacunarity = lacunarity,
          .offset = offset,
          .gain = gain,
          .normalize = (c.data & kNormalize) != 0};
}

template <int D>
float noise_value(const Context& c, vec3 v, float w, float scale, float detail, float roughness,
                  float lacunarity, float offset, float gain, float distortion) {
  return fractal_noise<D>(noise_place<D>(v, w, scale, distortion),
                          fractal_of(c, detail, roughness, lacunarity, offset, gain));
}
template <int D>
vec3 noise_color(const Context& c, vec3 v, float w, float scale, float detail, float roughness,
                 float lacunarity, float offset, float gain, float distortion) {
  const Fractal fractal = fractal_of(c, detail, roughness, lacunarity, offset, gain);
  const Coordinates<D> p = noise_place<D>(v, w, scale, distortion);
  return vec3(fractal_noise<D>(p, fractal), fractal_noise<D>(elsewhere<D, D>(p), fractal),
              fractal_noise<D>(elsewhere<D, D + 1>(p), fractal));
}

constexpr Dimensional kNoiseValue = {pure<&noise_value<1>>, pure<&noise_value<2>>,
                                     pure<&noise_value<3>>, pure<&noise_value<4>>};
constexpr Dimensional kNoiseColor = {pure<&noise_color<1>>, pure<&noise_color<2>>,
                                     pure<&noise_color<3>>, pure<&noise_color<4>>};

void emit_noise(NodeEmitter& e) {
  const int dimensions = dimensions_of(e.property("noise_dimensions", "3D"));
  const uint32_t data = number_of(kNoiseTypes, e.property("noise_type", "FBM")) |
                        (e.flag("normalize") ? kNormalize : 0);
  const Value v = used_vector(e, dimensions), w = used_w(e, dimensions);
  const auto noise = [&](const Operation& operation) {
    return e.emit(
        operation,
        {v, w, e.input("Scale"), e.input("Detail"), e.input("Roughness"), e.input("Lacunarity"),
         e.input("Offset"), e.input("Gain"), e.input("Distortion")},
        data);
  };
  const Value color = noise(kNoiseColor[dimensions]);
  // Red is the factor: whoever needs the colour has it already.
  e.output("Fac",
           e.output_linked("Color") ? e.emit(kFirst, {color}) : noise(kNoiseValue[dimensions]));
  e.output("Color", e.convert(color, Color));
}

constexpr EnumDecl kWhite[] = {{"noise_dimensions", kDimensions}},
                   kNoise[] = {{"noise_dimensions", kDimensions}, {"noise_type", kNoiseTypes}};

}  // namespace

std::span<const NodeDecl> noise_nodes() {
  static const NodeDecl kNodes[] = {
      {"TEX_WHITE_NOISE", kWhiteInputs, kWhiteOutputs, &emit_white_noise, nullptr, MixOp::None,
       kWhite},
      {"TEX_NOISE", kNoiseInputs, kNoiseOutputs, &emit_noise, nullptr, MixOp::None, kNoise},
  };
  return kNodes;
}

}  // namespace janus
