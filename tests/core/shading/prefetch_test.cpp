// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pictures that are looked up at one place are asked for together, before the first waits.
#include <gtest/gtest.h>

#include <algorithm>

#include "janus/shading/compiler.h"
#include "support/scene_kit.h"

namespace janus::test {
namespace {

// Emission of the sum of pictures, one for each socket of the coordinates.
Program pictures_at(std::initializer_list<const char*> sockets) {
  NodeGraph graph = single("EMISSION", {});
  graph.nodes.push_back(node("Where", "TEX_COORD", {}));
  ImageMap images;
  std::string sum;
  for (const char* socket : sockets) {
    const std::string name = "Picture " + std::to_string(images.size());
    auto image = std::make_shared<Image>(8, 8, 4);
    image->pixels.assign(image->pixels.size(), static_cast<float>(1 + images.size()) / 255.0f);
    image->pack();
    images[name] = {name, image, false};
    Node picture = node(name, "TEX_IMAGE", {{"Vector", link("Where", socket)}});
    picture.properties = {{"image", name}, {"interpolation", std::string("Linear")}};
    graph.nodes.push_back(picture);
    if (sum.empty()) {
      sum = name;
      graph.nodes[0].inputs["Color"] = link(name, "Color");
      continue;
    }
    const std::string both = "Both " + name;
    Node add = node(both, "VECT_MATH",
                    {{"Vector", link(sum, sum.starts_with("Both") ? "Vector" : "Color")},
                     {"Vector_001", link(name, "Color")}});
    add.properties["operation"] = std::string("ADD");
    graph.nodes.push_back(add);
    sum = both;
    graph.nodes[0].inputs["Color"] = link(both, "Vector");
  }
  Diagnostics diagnostics;
  Program program = compile(graph, "Material", images, diagnostics);
  EXPECT_TRUE(diagnostics.empty());
  return program;
}

TEST(Prefetch, ComesBeforeTheFirstOfALotAtOnePlace) {
  const Program one = pictures_at({"Object"}), three = pictures_at({"Object", "Object", "Object"}),
                apart = pictures_at({"Object", "Normal", "Object"});
  const auto fresh = [&](const Program& program) {  // kernels that look at the memory of others
    const auto sums = program.textures.size() - 1;
    return program.instructions.size() - program.textures.size() - sums;
  };
  EXPECT_EQ(fresh(one), 1u);    // the coordinate
  EXPECT_EQ(fresh(three), 3u);  // and two prefetches
  EXPECT_EQ(fresh(apart), 3u);  // two coordinates, one prefetch
  const Kernel lookup = one.instructions.back().kernel;
  const auto first = std::ranges::find(three.instructions, lookup, &Instruction::kernel);
  ASSERT_NE(first, three.instructions.end());
  const auto asks = std::span(first - 2, first);
  EXPECT_EQ(asks[0].kernel, asks[1].kernel);
  EXPECT_EQ(std::set({asks[0].data, asks[1].data, first->data}).size(), 3u);
}

TEST(Prefetch, IsHarmlessAnywhere) {
  const Program program = pictures_at({"Object", "Object", "Object"});
  ObjectData object;
  object.camera = std::make_shared<const CameraView>();
  ShadingPoint point{};
  point.object = &object;
  point.ng = point.ns = point.view = vec3(0, 0, 1);
  for (const float x : {0.3f, -1e8f, 1e30f, kInfinity, std::nanf("")}) {
    point.p = vec3(x, 0.2f, 0);
    ShadingResult result;
    program.run(point, result);
    EXPECT_TRUE(is_finite(result.emission));
    if (x == 0.3f) {
      EXPECT_NEAR(result.emission.x, 6.0f / 255.0f, 1e-6f);
    }
  }
}

}  // namespace
}  // namespace janus::test
