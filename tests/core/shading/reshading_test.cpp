// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfaces whose lobes depend on the view: sampling and evaluation fit together from both sides.
#include <gtest/gtest.h>

#include <algorithm>
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
  Reshading reshading;
  reshading.program = &program;
  reshading.point.ns = reshading.point.ng = vec3(0, 0, 1);
  for (const float z : {0.95f, 0.5f, 0.15f}) {
    const vec3 from(std::sqrt(1.0f - z * z), 0, z);
    reshading.point.view = from;
    ShadingResult shading;
    reshading.run(shading);
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

// Colours of a noise, bumped by it, under gloss that Fresnel and facing decide; `displaced`: the
// surface itself is bumped, too; `bent`: bumped by what depends on the view, instead.
Program layered(bool displaced, bool bent) {
  NodeGraph graph;
  graph.nodes = {
      node("Place", "NEW_GEOMETRY", {}),
      node("Noise", "TEX_NOISE", {{"Vector", link("Place", "Position")}, {"Scale", 3.0f}}),
      node("Bump", "BUMP", {{"Height", link("Noise", "Fac")}, {"Strength", 0.5f}}),
      node("Fresnel", "FRESNEL", {{"Normal", link("Bump", "Normal")}}),
      node("Weight", "LAYER_WEIGHT", {{"Blend", link("Noise", "Fac")}}),
      node("Ripple", "BUMP", {{"Height", link("Weight", "Facing")}}),
      node("A", "BSDF_DIFFUSE",
           {{"Color", link("Noise", "Color")},
            {"Normal", link(bent ? "Ripple" : "Bump", "Normal")}}),
      node("B", "BSDF_GLOSSY",
           {{"Color", vec4(0.9f)}, {"Roughness", link("Weight", "Facing")}, {"Anisotropy", 0.5f}}),
      node("Mix", "MIX_SHADER",
           {{"Fac", link("Fresnel", "Fac")}, {"Shader", link("A")}, {"Shader_001", link("B")}}),
      node("Up", "DISPLACEMENT", {{"Height", link("Noise", "Fac")}, {"Scale", 0.1f}})};
  graph.surface = NodeLink{"Mix", "Shader"};
  if (displaced) {
    graph.displacement = NodeLink{"Up", "Displacement"};
  }
  Diagnostics diagnostics;
  Program program = compile(graph, "Layered", {}, diagnostics);
  EXPECT_TRUE(diagnostics.empty()) << diagnostics.front().message;
  return program;
}

bool same(std::span<const Lobe> a, std::span<const Lobe> b) {
  const auto alike = [](const Lobe& x, const Lobe& y) {
    return x.weight == y.weight && x.color == y.color && x.normal == y.normal &&
           x.alpha == y.alpha && x.alpha_y == y.alpha_y && x.tangent == y.tangent &&
           x.pmf_normal == y.pmf_normal && x.type == y.type;
  };
  return std::ranges::equal(a, b, alike);
}

// What a run keeps for another view is all that the other view needs.
TEST(RunAgain, IsLikeANewRun) {
  const ObjectData object;
  for (const bool displaced : {false, true}) {
    for (const bool bent : {false, true}) {
      const Program program = layered(displaced, bent);
      EXPECT_EQ(program.dependence, Dependence::View);
      EXPECT_GT(program.kept_count, 0);
      EXPECT_GT(program.side_instructions, program.bump_instructions);
      EXPECT_GT(program.instructions.size(), program.side_instructions);
      EXPECT_EQ(program.view_beside, bent);
      Reshading reshading;
      reshading.program = &program;
      ShadingPoint& point = reshading.point;
      point = {};
      point.object = &object;
      point.ns = point.ng = vec3(0, 0, 1);
      point.edge_u = vec3(1, 0, 0);
      point.edge_v = vec3(0, 1, 0);
      point.footprint = 0.01f;
      std::mt19937 random(7);
      std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
      const auto direction = [&] {
        return normalize(vec3(uniform(random), uniform(random), uniform(random)));
      };
      int differ = 0;
      for (int i = 0; i < 200; ++i) {
        point.p = 10.0f * direction();
        point.view = direction();
        ShadingResult first, fresh;
        reshading.run(first);
        const Reshading copy = reshading;
        ShadingPoint other = point;
        other.view = direction();
        program.run(other, fresh);
        Bsdf again;
        lobes_for_view(copy, other.view, again);
        differ += same(first.bsdf.lobes(), fresh.bsdf.lobes()) ? 0 : 1;
        ASSERT_TRUE(same(again.lobes(), fresh.bsdf.lobes())) << displaced << bent << i;
      }
      EXPECT_GT(differ, 150);
    }
  }
}

}  // namespace
}  // namespace janus::test
