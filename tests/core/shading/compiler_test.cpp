// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "janus/shading/node_types.h"
#include "shading/compiled.h"

namespace janus::test {
namespace {

TEST(Compiler, EachClosure) {
  struct Case {
    NodeGraph graph;
    LobeType type;
    Rgb weight;
    float ior, alpha;
  };
  const Rgb color(0.1f, 0.2f, 0.3f);
  const vec4 input(color, 1);
  for (const Case& c : {
           Case{diffuse(color), LobeType::Diffuse, color, 1, 0},
           Case{single("BSDF_DIFFUSE", {{"Color", input}, {"Roughness", 0.3f}}),
                LobeType::OrenNayar, color, 1, 0},
           Case{mirror(color), LobeType::Glossy, color, 1, 0},
           Case{single("BSDF_GLOSSY", {{"Color", input}, {"Roughness", 0.5f}}), LobeType::Glossy,
                color, 1, 0.25f},
           Case{glass(color, 1.7f), LobeType::Glass, Rgb(1), 1.7f, 0},
           Case{single("BSDF_REFRACTION", {{"Color", input}, {"IOR", 1.3f}}), LobeType::Refraction,
                color, 1.3f, 0},
           Case{single("BSDF_TRANSLUCENT", {{"Color", input}}), LobeType::Translucent, color, 1, 0},
       }) {
    const Compiled result = compiled(c.graph);
    EXPECT_TRUE(result.diagnostics.empty());
    ASSERT_EQ(result.program.lobes.size(), 1u);
    const Lobe& lobe = result.program.lobes[0];
    EXPECT_EQ(lobe.type, c.type);
    EXPECT_EQ(lobe.weight, c.weight);
    EXPECT_FLOAT_EQ(lobe.ior, c.ior);
    EXPECT_FLOAT_EQ(lobe.alpha, c.alpha);
    EXPECT_FALSE(result.program.has_transparency());
  }
  for (const char* type : {"EMISSION", "BACKGROUND"}) {
    const Compiled result = compiled(single(type, {{"Color", vec4(color, 1)}, {"Strength", 2.0f}}));
    EXPECT_EQ(result.program.emission, 2.0f * color);
    EXPECT_TRUE(result.program.lobes.empty() && result.diagnostics.empty());
  }
}

TEST(Compiler, TransparencyIsNoLobe) {
  const Rgb color(0.1f, 0.2f, 0.3f);
  const NodeGraph transparent = single("BSDF_TRANSPARENT", {{"Color", vec4(color, 1)}});
  const Compiled alone = compiled(transparent);
  EXPECT_TRUE(alone.program.lobes.empty() && alone.diagnostics.empty());
  EXPECT_EQ(alone.program.transparency, color);
  EXPECT_TRUE(alone.program.has_transparency());
  const Compiled mixed = compiled(combine("MIX_SHADER", diffuse(Rgb(1)), transparent, 0.25f));
  EXPECT_EQ(mixed.program.transparency, 0.25f * color);
  EXPECT_FLOAT_EQ(mixed.program.lobes[0].weight.x, 0.75f);
}

TEST(Compiler, Distributions) {
  const auto with = [](const char* type, const char* distribution, float roughness) {
    NodeGraph graph = single(type, {{"Roughness", roughness}});
    graph.nodes[0].properties["distribution"] = distribution;
    return compiled(graph);
  };
  for (const char* type : {"BSDF_GLOSSY", "BSDF_GLASS"}) {
    EXPECT_FALSE(with(type, "GGX", 0.5f).program.lobes[0].multiscatter);
    EXPECT_TRUE(with(type, "MULTI_GGX", 0.5f).program.lobes[0].multiscatter);
  }
  for (const char* type : {"BSDF_GLOSSY", "BSDF_GLASS", "BSDF_REFRACTION", "BSDF_METALLIC"}) {
    const Compiled beckmann = with(type, "BECKMANN", 0.5f);
    EXPECT_TRUE(beckmann.diagnostics.empty());
    EXPECT_TRUE(beckmann.program.lobes[0].beckmann) << type;
    EXPECT_FALSE(with(type, "GGX", 0.5f).program.lobes[0].beckmann) << type;
  }
  for (const float roughness : {0.0f, 0.01f, 0.5f}) {  // smooth ones are mirrors
    const Compiled made = with("BSDF_GLOSSY", "ASHIKHMIN_SHIRLEY", roughness);
    EXPECT_TRUE(made.diagnostics.empty());
    EXPECT_EQ(made.program.lobes[0].type,
              roughness < 0.1f ? LobeType::Glossy : LobeType::AshikhminShirley);
    EXPECT_EQ(is_delta(made.program.lobes[0]), roughness < 0.1f);
  }
}

TEST(Compiler, OmittedInputsTakeTheDeclaredDefaults) {
  EXPECT_EQ(compiled(single("BSDF_DIFFUSE", {})).program.lobes[0].weight, Rgb(0.8f));
  EXPECT_FLOAT_EQ(compiled(single("BSDF_GLASS", {})).program.lobes[0].ior, 1.5f);
  EXPECT_EQ(compiled(single("EMISSION", {})).program.emission, Rgb(1.0f));
}

// Every type of the table compiles: none is declared and forgotten.
TEST(Compiler, KnowsEveryDeclaredNode) {
  for (const NodeDecl& decl : node_types()) {
    EXPECT_EQ(find_node_type(decl.type), &decl);
    if (decl.outputs.empty()) {  // an end of its own
      continue;
    }
    if (!decl.emit) {
      EXPECT_FALSE(warned(compiled(single(std::string(decl.type), {})), "Shader", "rendered black"))
          << decl.type;
      continue;
    }
    NodeGraph graph = emission(Rgb(1), 1);
    graph.nodes.push_back(node("Value", std::string(decl.type), {}));
    graph.nodes[0].inputs["Color"] = link("Value", std::string(decl.outputs[0]));
    EXPECT_FALSE(warned(compiled(graph), "Value", "node type")) << decl.type;
  }
}

TEST(Compiler, UnknownNodesAreBlackAndNamed) {
  const Compiled result = compiled(single("BSDF_NOVELTY", {}));
  EXPECT_TRUE(result.program.lobes.empty());
  EXPECT_EQ(result.program.emission, Rgb(0));
  EXPECT_TRUE(warned(result, "Shader", "BSDF_NOVELTY"));
}

TEST(Compiler, MixAndAddShares) {
  const Rgb a(0.4f), b(0.8f);
  const auto weights = [&](const char* type, float factor) {
    const Program p = compiled(combine(type, diffuse(a), mirror(b), factor)).program;
    vec2 out(0);
    for (const auto& i : p.lobes) {
      out[i.type == LobeType::Glossy] += i.weight.x;
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
  EXPECT_TRUE(compiled(half).program.lobes.empty());
  EXPECT_TRUE(compiled(NodeGraph{}).program.lobes.empty());
  half.surface = NodeLink{"Nobody", "BSDF"};
  EXPECT_TRUE(compiled(half).program.lobes.empty());
}

TEST(Compiler, SaysWhatItCannotDo) {
  EXPECT_TRUE(warned(compiled(single("BSDF_DIFFUSE", {{"Color", link("Noise", "Color")}})),
                     "Shader", "'Color' is linked to 'Noise', which is not"));
  EXPECT_TRUE(warned(compiled(single("BSDF_DIFFUSE", {{"Normal", link("Bump", "Normal")}})),
                     "Shader", "'Normal' is linked to 'Bump', which is not"));
  const Compiled bad = compiled(single("BSDF_DIFFUSE", {{"Color", vec4(NAN, 0, 0, 1)}}));
  EXPECT_TRUE(warned(bad, "Shader", "not a finite number"));
  EXPECT_EQ(bad.program.lobes[0].weight, Rgb(0.8f));
}

TEST(Compiler, NegativeColoursDoNotDarken) {
  EXPECT_TRUE(compiled(diffuse(Rgb(-1))).program.lobes.empty());
  EXPECT_EQ(compiled(emission(Rgb(-1, 1, 1), 2)).program.emission, Rgb(0, 2, 2));
}

Node math(const std::string& name, const std::string& operation, NodeInput a, NodeInput b) {
  Node n = node(name, "MATH", {{"Value", std::move(a)}, {"Value_001", std::move(b)}});
  n.properties["operation"] = operation;
  return n;
}

// Emission whose strength is `top`, a node among `nodes`.
NodeGraph glow(std::vector<Node> nodes, const std::string& top, const std::string& output) {
  NodeGraph graph = emission(Rgb(1), 1);
  graph.nodes[0].inputs["Strength"] = link(top, output);
  graph.nodes.insert(graph.nodes.end(), nodes.begin(), nodes.end());
  return graph;
}

TEST(Compiler, ConstantsFold) {
  const Compiled result = compiled(glow(
      {math("Sum", "ADD", 2.0f, 3.0f), math("Product", "MULTIPLY", link("Sum", "Value"), 4.0f)},
      "Product", "Value"));
  EXPECT_TRUE(result.diagnostics.empty());
  EXPECT_TRUE(result.program.constant());
  EXPECT_FLOAT_EQ(result.program.emission.x, 20);
}

TEST(Compiler, SharesEqualSubgraphsAndDropsWhatNobodyReads) {
  const Node geometry = node("Geometry", "NEW_GEOMETRY", {});
  const Node split = node("Split", "SEPXYZ", {{"Vector", link("Geometry", "Position")}});
  const Node again = node("Again", "SEPXYZ", {{"Vector", link("Geometry", "Position")}});
  const Node sum = math("Sum", "ADD", link("Split", "X"), link("Again", "X"));
  const Compiled result = compiled(glow({geometry, split, again, sum}, "Sum", "Value"));
  EXPECT_TRUE(result.diagnostics.empty());
  // Position, its x, and the sum: one of each; y, z, the normal and the rest are not there.
  EXPECT_EQ(result.program.instructions.size(), 3u);
  ShadingPoint point{};
  point.p = vec3(1.5f, 7, 8);
  ShadingResult shading;
  result.program.run(point, shading);
  EXPECT_FLOAT_EQ(shading.emission.x, 3);
}

// Registers are used again: a chain needs no more of them than a few.
TEST(Compiler, LongChainsNeitherOverflowNorRunOutOfRegisters) {
  constexpr int kLength = 20000;
  std::vector<Node> nodes = {node("Geometry", "NEW_GEOMETRY", {}),
                             node("0", "SEPXYZ", {{"Vector", link("Geometry", "Position")}})};
  for (int i = 1; i <= kLength; ++i) {
    nodes.push_back(
        math(std::to_string(i), "ADD", link(std::to_string(i - 1), i == 1 ? "X" : "Value"), 1.0f));
  }
  const Compiled result = compiled(glow(nodes, std::to_string(kLength), "Value"));
  EXPECT_TRUE(result.diagnostics.empty());
  ShadingResult shading;
  result.program.run(ShadingPoint(), shading);
  EXPECT_FLOAT_EQ(shading.emission.x, kLength);
}

TEST(Compiler, CutsCyclesOfValues) {
  const Compiled result = compiled(glow({math("Egg", "ADD", link("Hen", "Value"), 1.0f),
                                         math("Hen", "ADD", link("Egg", "Value"), 1.0f)},
                                        "Hen", "Value"));
  EXPECT_TRUE(std::any_of(result.diagnostics.begin(), result.diagnostics.end(), [](const auto& d) {
    return d.message.find("cycle") != std::string::npos;
  }));
}

// A number that is none mixes nothing in: no lobe is not finite.
TEST(Compiler, SharesThatAreNoNumbersCountAsNone) {
  NodeGraph graph = combine("MIX_SHADER", diffuse(Rgb(1)), mirror(Rgb(1)));
  graph.nodes.push_back(node("Where", "NEW_GEOMETRY", {}));
  graph.nodes.push_back(node("Split", "SEPXYZ", {{"Vector", link("Where", "Position")}}));
  graph.nodes[2].inputs["Fac"] = link("Split", "X");
  const Compiled result = compiled(graph);
  ShadingPoint point{};
  point.ns = point.ng = point.view = vec3(0, 0, 1);
  ShadingResult shading;
  for (const float x : {0.25f, NAN, INFINITY}) {
    point.p.x = x;
    result.program.run(point, shading);
    EXPECT_EQ(shading.bsdf.size(), x == 0.25f ? 2 : std::isnan(x) ? 0 : 1) << x;
    for (const Lobe& lobe : shading.bsdf.lobes()) {
      EXPECT_TRUE(is_finite(lobe.weight));
    }
  }
}

// A colour is a number by its luminance, a vector by its mean, as in Blender.
TEST(Compiler, SocketsConvert) {
  const auto strength = [](const std::string& type, const std::string& output) {
    Node source =
        node("Source", type,
             type == "COMBXYZ"
                 ? std::map<std::string, NodeInput>{{"X", 3.0f}, {"Y", 6.0f}, {"Z", 0.0f}}
                 : std::map<std::string, NodeInput>{{"Color", vec4(0, 1, 0, 1)}, {"Gamma", 1.0f}});
    return compiled(glow({source}, "Source", output)).program.emission.x;
  };
  EXPECT_FLOAT_EQ(strength("COMBXYZ", "Vector"), 3);
  EXPECT_NEAR(strength("GAMMA", "Color"), 0.7152, 1e-4);
}

TEST(Compiler, CutsCycles) {
  NodeGraph graph;  // a shader that adds itself to itself
  graph.nodes = {node("Loop", "ADD_SHADER", {{"Shader", link("Loop")}, {"Shader_001", link("D")}}),
                 node("D", "BSDF_DIFFUSE", {})};
  graph.surface = NodeLink{"Loop", "Shader"};
  const Compiled result = compiled(graph);
  EXPECT_TRUE(warned(result, "Loop", "cycle"));
  EXPECT_EQ(result.program.lobes.size(), 1u);
}

// What kind of ray asks is constant; what the path counts is not, and nobody else may ask.
TEST(Compiler, LightPath) {
  NodeGraph graph = combine("MIX_SHADER", emission(Rgb(1), 1), emission(Rgb(1), 3));
  graph.nodes.back().inputs["Fac"] = link("Path", "Is Glossy Ray");
  graph.nodes.push_back(node("Path", "LIGHT_PATH", {}));
  NodeGraph deep = graph;
  deep.nodes[2].inputs["Fac"] = link("Path", "Ray Depth");
  const Compiled counting = compiled(deep);
  EXPECT_TRUE(counting.diagnostics.empty());
  EXPECT_TRUE(counting.program.by_path);
  deep.nodes[2].inputs["Fac"] = link("Path", "Is Singular Ray");
  EXPECT_TRUE(warned(compiled(deep), "Path", "'Is Singular Ray' is not supported"));
  Diagnostics said;
  const Program glossy = compile(graph, "World", {}, said, {SeenTree::Of::World, RayType::Glossy});
  const Program camera = compile(graph, "World", {}, said, {SeenTree::Of::World, RayType::Camera});
  EXPECT_TRUE(said.empty());
  EXPECT_TRUE(glossy.constant() && camera.constant());
  EXPECT_FALSE(glossy.by_path);
  EXPECT_EQ(glossy.emission, Rgb(3));
  EXPECT_EQ(camera.emission, Rgb(1));
  EXPECT_TRUE(glossy.emits_like(
      compile(graph, "World", {}, said, {SeenTree::Of::World, RayType::Transmission})));
  EXPECT_FALSE(glossy.emits_like(camera));
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
  EXPECT_EQ(result.program.lobes.size(), static_cast<size_t>(kMaxLobes));
  EXPECT_TRUE(warned(result, "D" + std::to_string(kMaxLobes), "left out"));
}

// Of a closure whose parts are known only where it is shaded, those count that may be there.
TEST(Compiler, PartsThatAreNeverThereNeedNoRoom) {
  const auto sum = [](int count, float subsurface) {
    NodeGraph graph;
    graph.nodes.push_back(node("Where", "NEW_GEOMETRY", {}));
    for (int i = 0; i < count; ++i) {
      const std::string n = std::to_string(i);
      graph.nodes.push_back(
          node("P" + n, "BSDF_PRINCIPLED",
               {{"Base Color", link("Where", "Position")}, {"Subsurface Weight", subsurface}}));
      graph.nodes.push_back(
          node("A" + n, "ADD_SHADER",
               {{"Shader", link("P" + n)}, {"Shader_001", link("A" + std::to_string(i + 1))}}));
    }
    graph.surface = NodeLink{"A0", "Shader"};
    return compiled(graph);
  };
  constexpr int kPlain = kMaxLobes / 2;  // specular and diffuse
  EXPECT_FALSE(warned(sum(kPlain, 0), "P" + std::to_string(kPlain - 1), "left out"));
  EXPECT_TRUE(warned(sum(kPlain + 1, 0), "P" + std::to_string(kPlain), "left out"));
  constexpr int kWax = kMaxLobes / 4;  // and two below the surface
  EXPECT_FALSE(warned(sum(kWax, 0.5f), "P" + std::to_string(kWax - 1), "left out"));
  EXPECT_TRUE(warned(sum(kWax + 1, 0.5f), "P" + std::to_string(kWax), "left out"));
}

}  // namespace
}  // namespace janus::test
