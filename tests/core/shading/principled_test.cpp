// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the compiler makes of Principled BSDFs, and of facets of two widths.
#include "shading/compiled.h"

namespace janus::test {
namespace {

// Principled BSDF: parts and what they leave to the next.
TEST(Compiler, Principled) {
  const Rgb base(0.9f, 0.4f, 0.1f);
  const auto principled = [&](std::map<std::string, NodeInput> inputs) {
    inputs["Base Color"] = vec4(base, 1);
    return compiled(single("BSDF_PRINCIPLED", std::move(inputs)));
  };
  const Compiled plain = principled({});
  EXPECT_TRUE(plain.diagnostics.empty());
  ASSERT_EQ(plain.program.lobes.size(), 2u);
  EXPECT_EQ(plain.program.lobes[0].type, LobeType::Specular);
  EXPECT_FLOAT_EQ(plain.program.lobes[0].alpha, 0.25f);
  EXPECT_TRUE(plain.program.lobes[0].multiscatter);
  EXPECT_EQ(plain.program.lobes[1].type, LobeType::Diffuse);
  EXPECT_EQ(plain.program.lobes[1].above, 1);
  EXPECT_EQ(plain.program.lobes[1].weight, base);
  EXPECT_EQ(plain.program.emission, Rgb(0));

  const Compiled parts = principled({{"Alpha", 0.8f},
                                     {"Metallic", 0.5f},
                                     {"Transmission Weight", 0.25f},
                                     {"Emission Strength", 2.0f},
                                     {"Diffuse Roughness", 0.4f}});
  ASSERT_EQ(parts.program.lobes.size(), 4u);
  const auto& lobes = parts.program.lobes;
  EXPECT_EQ(lobes[0].type, LobeType::Metal);
  EXPECT_NEAR(lobes[0].weight.x, 0.4, 1e-6);
  EXPECT_EQ(lobes[0].color, base);
  EXPECT_EQ(lobes[1].type, LobeType::Glass);
  EXPECT_NEAR(lobes[1].weight.x, 0.1, 1e-6);
  EXPECT_NEAR(lobes[1].color.y, std::sqrt(0.4f), 1e-6);
  EXPECT_NEAR(lobes[2].weight.x, 0.3, 1e-6);
  EXPECT_EQ(lobes[3].type, LobeType::OrenNayar);
  EXPECT_NEAR(lobes[3].weight.x, 0.27, 1e-6);
  EXPECT_NEAR(parts.program.transparency.x, 0.2, 1e-6);
  EXPECT_NEAR(parts.program.emission.x, 1.6, 1e-6);

  EXPECT_EQ(principled({{"Metallic", 1.0f}}).program.lobes.size(), 1u);
  // No layer, nothing to attenuate: level 0 has the index 1.
  const Compiled bare = principled({{"Specular IOR Level", 0.0f}});
  ASSERT_EQ(bare.program.lobes.size(), 1u);
  EXPECT_EQ(bare.program.lobes[0].above, 0);
  // Level 1 doubles F0.
  const Compiled shiny = principled({{"Specular IOR Level", 1.0f}});
  const float eta = shiny.program.lobes[0].ior;
  EXPECT_NEAR(sqr((eta - 1) / (eta + 1)), 0.08, 1e-5);
}

TEST(Compiler, PrincipledNamesWhatIsLeftOut) {
  const auto message = [](std::map<std::string, NodeInput> inputs, const char* part,
                          const char* method = "RANDOM_WALK") {
    NodeGraph graph = single("BSDF_PRINCIPLED", std::move(inputs));
    graph.nodes.front().properties = {{"subsurface_method", std::string(method)}};
    return warned(compiled(graph), "Shader", part);
  };
  for (const NodeInput& input : {NodeInput(0.5f), link("Noise")}) {
    EXPECT_TRUE(message({{"Subsurface Weight", input}}, "BURLEY", "BURLEY"));
  }
  EXPECT_FALSE(message({{"Subsurface Weight", 0.5f}}, "BURLEY"));
  EXPECT_FALSE(message({}, "BURLEY", "BURLEY"));  // where there is none
  EXPECT_FALSE(message({{"Subsurface Weight", 0.5f}, {"Thin Wall", 1.0f}}, "BURLEY", "BURLEY"));
  EXPECT_TRUE(warned(compiled(subsurface(Rgb(0.5f), {}, "BURLEY")), "Shader", "BURLEY"));
}

// Sheen over coat over all else: each knows what covers it.
TEST(Compiler, PrincipledCovers) {
  const auto lobes = [](std::map<std::string, NodeInput> inputs) {
    const Compiled result = compiled(single("BSDF_PRINCIPLED", std::move(inputs)));
    EXPECT_TRUE(result.diagnostics.empty());
    EXPECT_TRUE(result.program.constant());
    return result.program.lobes;
  };
  const auto all = lobes({{"Sheen Weight", 0.5f},
                          {"Coat Weight", 0.8f},
                          {"Metallic", 0.5f},
                          {"Transmission Weight", 0.5f}});
  const std::pair<LobeType, int> expected[] = {{LobeType::Sheen, 0},    {LobeType::Coat, 1},
                                               {LobeType::Metal, 1},    {LobeType::Glass, 2},
                                               {LobeType::Specular, 3}, {LobeType::Diffuse, 1}};
  ASSERT_EQ(all.size(), std::size(expected));
  for (size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(std::pair(all[i].type, int{all[i].above}), expected[i]) << i;
  }
  EXPECT_FLOAT_EQ(all[0].weight.x, 0.5f);
  EXPECT_FLOAT_EQ(all[1].weight.x, 0.8f);
  EXPECT_FLOAT_EQ(all[1].sigma, 0.8f);
  EXPECT_EQ(lobes({{"Coat Weight", -1.0f}}).size(), 2u);
  // What glows below a cover depends on the view; on nothing else does it.
  const Compiled glow =
      compiled(single("BSDF_PRINCIPLED", {{"Coat Weight", 1.0f}, {"Emission Strength", 2.0f}}));
  EXPECT_EQ(glow.program.dependence, Dependence::View);
}

// Facets of two widths need a tangent, and nothing else does.
TEST(Compiler, AnisotropyReadsATangent) {
  for (const auto& [type, input] :
       {std::pair("BSDF_PRINCIPLED", "Anisotropic"), std::pair("BSDF_GLOSSY", "Anisotropy"),
        std::pair("BSDF_METALLIC", "Anisotropy")}) {
    const Program turned = compiled(single(type, {{input, 0.5f}})).program;
    EXPECT_FALSE(turned.constant()) << type;
    EXPECT_EQ(turned.attributes.size(), 1u) << type;
    const Program round = compiled(single(type, {{input, 0.0f}})).program;
    EXPECT_TRUE(round.constant()) << type;
    EXPECT_TRUE(round.attributes.empty()) << type;
  }
}

}  // namespace
}  // namespace janus::test
