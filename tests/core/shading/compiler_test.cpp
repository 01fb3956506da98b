// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/shading/compiler.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "janus/shading/node_types.h"
#include "support/scene_kit.h"

namespace janus::test {
namespace {

struct Compiled {
  Program program;
  Diagnostics diagnostics;
};

Compiled compiled(const NodeGraph& graph) {
  Compiled result;
  result.program = compile(graph, "Material", result.diagnostics);
  return result;
}

bool warned(const Compiled& c, const std::string& node, const std::string& part) {
  return std::any_of(c.diagnostics.begin(), c.diagnostics.end(), [&](const Diagnostic& d) {
    return d.material == "Material" && d.node == node && d.message.find(part) != std::string::npos;
  });
}

TEST(Compiler, EachClosure) {
  struct Case {
    NodeGraph graph;
    LobeType type;
    float ior;
  };
  const Rgb color(0.1f, 0.2f, 0.3f);
  for (const Case& c :
       {Case{diffuse(color), LobeType::Diffuse, 1}, Case{mirror(color), LobeType::Mirror, 1},
        Case{glass(color, 1.7f), LobeType::Dielectric, 1.7f}}) {
    const Compiled result = compiled(c.graph);
    EXPECT_TRUE(result.diagnostics.empty());
    ASSERT_EQ(result.program.instructions.size(), 1u);
    EXPECT_EQ(result.program.instructions[0].type, c.type);
    EXPECT_EQ(result.program.instructions[0].weight, color);
    EXPECT_FLOAT_EQ(result.program.instructions[0].ior, c.ior);
  }
  for (const char* type : {"EMISSION", "BACKGROUND"}) {
    const Compiled result = compiled(single(type, {{"Color", vec4(color, 1)}, {"Strength", 2.0f}}));
    EXPECT_EQ(result.program.emission, 2.0f * color);
    EXPECT_TRUE(result.program.instructions.empty() && result.diagnostics.empty());
  }
}

TEST(Compiler, OmittedInputsTakeTheDeclaredDefaults) {
  EXPECT_EQ(compiled(single("BSDF_DIFFUSE", {})).program.instructions[0].weight, Rgb(0.8f));
  EXPECT_FLOAT_EQ(compiled(single("BSDF_GLASS", {})).program.instructions[0].ior, 1.5f);
  EXPECT_EQ(compiled(single("EMISSION", {})).program.emission, Rgb(1.0f));
}

// Every type of the table compiles: none is declared and forgotten.
TEST(Compiler, KnowsEveryDeclaredNode) {
  for (const NodeDecl& decl : node_types()) {
    EXPECT_FALSE(warned(compiled(single(std::string(decl.type), {})), "Shader", "rendered black"))
        << decl.type;
    EXPECT_EQ(find_node_type(decl.type), &decl);
  }
}

TEST(Compiler, UnknownNodesAreBlackAndNamed) {
  const Compiled result = compiled(single("BSDF_NOVELTY", {}));
  EXPECT_TRUE(result.program.instructions.empty());
  EXPECT_EQ(result.program.emission, Rgb(0));
  EXPECT_TRUE(warned(result, "Shader", "BSDF_NOVELTY"));
}

TEST(Compiler, MixAndAddShares) {
  const Rgb a(0.4f), b(0.8f);
  const auto weights = [&](const char* type, float factor) {
    const Program p = compiled(combine(type, diffuse(a), mirror(b), factor)).program;
    vec2 out(0);
    for (const auto& i : p.instructions) {
      out[i.type == LobeType::Mirror] += i.weight.x;
    }
    return out;
  };
  EXPECT_NEAR(glm::length(weights("MIX_SHADER", 0.25f) - vec2(0.3f, 0.2f)), 0, 1e-6);
  EXPECT_EQ(weights("MIX_SHADER", 0), vec2(0.4f, 0));
  EXPECT_EQ(weights("MIX_SHADER", 1), vec2(0, 0.8f));
  EXPECT_EQ(weights("MIX_SHADER", 3), vec2(0, 0.8f));  // clamped, as in Blender
  EXPECT_EQ(weights("ADD_SHADER", 0.25f), vec2(0.4f, 0.8f));
}

TEST(Compiler, MixedEmissionAndMissingLinks) {
  const Compiled result =
      compiled(combine("MIX_SHADER", diffuse(Rgb(1)), emission(Rgb(1), 4), 0.75f));
  EXPECT_FLOAT_EQ(result.program.emission.x, 3);
  NodeGraph half;  // one socket of the mix is empty, the other leads nowhere
  half.nodes = {node("Top", "MIX_SHADER", {{"Shader_001", link("Missing")}})};
  half.surface = NodeLink{"Top", "Shader"};
  EXPECT_TRUE(compiled(half).program.instructions.empty());
  EXPECT_TRUE(compiled(NodeGraph{}).program.instructions.empty());
  half.surface = NodeLink{"Nobody", "BSDF"};
  EXPECT_TRUE(compiled(half).program.instructions.empty());
}

TEST(Compiler, SaysWhatItCannotDo) {
  EXPECT_TRUE(
      warned(compiled(single("BSDF_GLOSSY", {{"Roughness", 0.3f}})), "Shader", "roughness"));
  EXPECT_TRUE(warned(compiled(single("BSDF_DIFFUSE", {{"Color", link("Noise", "Color")}})),
                     "Shader", "'Color' is linked to 'Noise'"));
  EXPECT_TRUE(warned(compiled(single("BSDF_DIFFUSE", {{"Normal", link("Bump", "Normal")}})),
                     "Shader", "'Normal' is linked to 'Bump'"));
  EXPECT_TRUE(warned(compiled(single("BSDF_PRINCIPLED", {})), "Shader", "Principled"));
  const Compiled bad = compiled(single("BSDF_DIFFUSE", {{"Color", vec4(NAN, 0, 0, 1)}}));
  EXPECT_TRUE(warned(bad, "Shader", "not a finite number"));
  EXPECT_EQ(bad.program.instructions[0].weight, Rgb(0.8f));
}

TEST(Compiler, NegativeColoursDoNotDarken) {
  EXPECT_TRUE(compiled(diffuse(Rgb(-1))).program.instructions.empty());
  EXPECT_EQ(compiled(emission(Rgb(-1, 1, 1), 2)).program.emission, Rgb(0, 2, 2));
}

TEST(Compiler, CutsCycles) {
  NodeGraph graph;  // a shader that adds itself to itself
  graph.nodes = {node("Loop", "ADD_SHADER", {{"Shader", link("Loop")}, {"Shader_001", link("D")}}),
                 node("D", "BSDF_DIFFUSE", {})};
  graph.surface = NodeLink{"Loop", "Shader"};
  const Compiled result = compiled(graph);
  EXPECT_TRUE(warned(result, "Loop", "cycle"));
  EXPECT_EQ(result.program.instructions.size(), 1u);
}

// Sixty nodes, each of which uses the next one twice: 2^60 ways to the last.
TEST(Compiler, SharedBranchesDoNotExplode) {
  NodeGraph graph;
  for (int i = 0; i < 60; ++i) {
    const NodeInput next = link(std::to_string(i + 1));
    graph.nodes.push_back(
        node(std::to_string(i), "ADD_SHADER", {{"Shader", next}, {"Shader_001", next}}));
  }
  graph.nodes.push_back(node("60", "EMISSION", {}));
  graph.surface = NodeLink{"0", "Shader"};
  EXPECT_FALSE(compiled(graph).diagnostics.empty());
}

TEST(Compiler, TooManyClosures) {
  NodeGraph graph;
  for (int i = 0; i < kMaxLobes + 2; ++i) {
    graph.nodes.push_back(node("D" + std::to_string(i), "BSDF_DIFFUSE", {}));
    graph.nodes.push_back(node("A" + std::to_string(i), "ADD_SHADER",
                               {{"Shader", link("D" + std::to_string(i))},
                                {"Shader_001", link("A" + std::to_string(i + 1))}}));
  }
  graph.surface = NodeLink{"A0", "Shader"};
  const Compiled result = compiled(graph);
  EXPECT_EQ(result.program.instructions.size(), static_cast<size_t>(kMaxLobes));
  EXPECT_TRUE(warned(result, "D" + std::to_string(kMaxLobes), "left out"));
}

}  // namespace
}  // namespace janus::test
