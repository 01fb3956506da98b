// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfaces whose lobes depend on the view: sampling and evaluation fit together from both sides.
#include <gtest/gtest.h>

#include <random>

#include "janus/math/warp.h"
#include "janus/shading/compiler.h"
#include "support/scene_kit.h"
#include "support/statistics.h"

namespace janus::test {
namespace {

// Gloss that grows towards grazing angles over a diffuse ground.
Program coated() {
  NodeGraph graph;
  graph.nodes = {
      node("Weight", "LAYER_WEIGHT", {{"Blend", 0.8f}}),
      node("A", "BSDF_DIFFUSE", {{"Color", vec4(0.9f)}}),
      node("B", "BSDF_GLOSSY", {{"Color", vec4(0.9f)}, {"Roughness", 0.6f}}),
      node("Mix", "MIX_SHADER",
           {{"Fac", link("Weight", "Facing")}, {"Shader", link("A")}, {"Shader_001", link("B")}})};
  graph.surface = NodeLink{"Mix", "Shader"};
  Diagnostics diagnostics;
  Program program = compile(graph, "Coated", {}, diagnostics);
  EXPECT_TRUE(diagnostics.empty());
  return program;
}

class Reshadings : public ::testing::TestWithParam<TransportMode> {};

// The mean weight of what sample() draws is the integral of the value over all directions.
TEST_P(Reshadings, SampledWeightsIntegrateTheValue) {
  const TransportMode mode = GetParam();
  const Program program = coated();
  Reshading reshading{&program, {}};
  reshading.point.ns = reshading.point.ng = vec3(0, 0, 1);
  for (const float z : {0.95f, 0.5f, 0.15f}) {
    const vec3 from(std::sqrt(1.0f - z * z), 0, z);
    reshading.point.view = from;
    ShadingResult shading;
    program.run(reshading.point, shading);
    const BsdfView bsdf = shading.bsdf.view(vec3(0, 0, 1), vec3(0, 0, 1), &reshading);
    std::mt19937 random(5);
    std::uniform_real_distribution<float> uniform;
    const auto next_2d = [&] { return vec2(uniform(random), uniform(random)); };
    Mean drawn, integral;
    for (int i = 0; i < 100000; ++i) {
      const float u_lobe = uniform(random);
      const auto sample = bsdf.sample(from, u_lobe, next_2d(), mode);
      drawn.add(sample ? sample->weight.x : 0.0f);
      const vec3 to = square_to_cosine_hemisphere(next_2d());
      const bool radiance = mode == TransportMode::Radiance;
      const Rgb f = bsdf.eval(radiance ? from : to, radiance ? to : from, mode);
      integral.add(to.z > 0.0f ? f.x * kPi / to.z : 0.0f);
    }
    EXPECT_TRUE(agree(drawn, integral, 4.0)) << z;
    EXPECT_LT(drawn.error() / drawn.mean(), 0.004) << z;
  }
}

INSTANTIATE_TEST_SUITE_P(Modes, Reshadings,
                         ::testing::Values(TransportMode::Radiance, TransportMode::Importance));

}  // namespace
}  // namespace janus::test
