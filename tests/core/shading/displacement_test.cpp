// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is displaced is bumped: the whole surface has the new normal. The results of trees are
// compared with Cycles in tests/images/node_cases_displacement.py.
#include "shading/compiled.h"

namespace janus::test {
namespace {

// A surface, displaced along its normal by a slope of 45 degrees along x.
NodeGraph sloped(NodeGraph graph) {
  graph.nodes.insert(graph.nodes.end(),
                     {node("Where", "NEW_GEOMETRY", {}),
                      node("Parts", "SEPXYZ", {{"Vector", link("Where", "Position")}}),
                      node("Up", "DISPLACEMENT",
                           {{"Height", link("Parts", "X")}, {"Midlevel", 0.0f}, {"Scale", 1.0f}})});
  graph.displacement = NodeLink{"Up", "Displacement"};
  return graph;
}

struct Place {
  ObjectData object;
  ShadingPoint point{};

  Place() {
    point.ng = point.ns = point.view = vec3(0, 0, 1);
    point.footprint = 1e-3f;
    point.object = &object;
  }
  ShadingResult run(const Program& program) const {
    ShadingResult result;
    program.run(point, result);
    return result;
  }
};

void expect_near(vec3 a, vec3 b) { EXPECT_LT(glm::length(a - b), 1e-3f) << a.x << " " << a.y; }

const vec3 kSlope = normalize(vec3(-1, 0, 1));

TEST(Displacement, BumpsWhatIsConstantElse) {
  const Compiled made = compiled(sloped(single("BSDF_DIFFUSE", {})));
  EXPECT_TRUE(made.diagnostics.empty());
  EXPECT_FALSE(made.program.constant());
  Place place;
  ShadingResult result = place.run(made.program);
  expect_near(result.ns, kSlope);
  expect_near(result.bsdf.lobes()[0].normal, kSlope);
  EXPECT_FALSE(result.bsdf.lobes()[0].bumped);  // its normal is the surface's
  // From behind a hill is a hollow.
  place.point.view = vec3(0, 0, -1);
  expect_near(place.run(made.program).ns, normalize(vec3(1, 0, 1)));
  EXPECT_EQ(made.program.dependence, Dependence::Side);
}

TEST(Displacement, IsSeenByAllNodes) {
  NodeGraph graph = sloped(single("EMISSION", {{"Color", link("Geometry", "Normal")}}));
  graph.nodes.push_back(node("Geometry", "NEW_GEOMETRY", {}));
  const Compiled made = compiled(graph);
  const Rgb emission = Place().run(made.program).emission;
  EXPECT_NEAR(emission.z, kSlope.z, 1e-3f);
  EXPECT_EQ(emission.x, 0.0f);  // light below 0 is none
}

// A closure with a normal of its own is bumped beside the surface as it is displaced.
TEST(Displacement, IsWhatOtherNormalsAreTurnedFrom) {
  NodeGraph graph = sloped(single("BSDF_DIFFUSE", {{"Normal", link("Flat", "True Normal")}}));
  graph.nodes.push_back(node("Flat", "NEW_GEOMETRY", {}));
  const ShadingResult result = Place().run(compiled(graph).program);
  expect_near(result.ns, kSlope);
  expect_near(result.bsdf.lobes()[0].normal, vec3(0, 0, 1));
  EXPECT_TRUE(result.bsdf.lobes()[0].bumped);
}

TEST(Displacement, OfNothingCostsNothing) {
  NodeGraph same = sloped(single("BSDF_DIFFUSE", {}));
  same.nodes.back().inputs["Height"] = 0.7f;
  expect_near(Place().run(compiled(same).program).ns, vec3(0, 0, 1));
  same.nodes.back().inputs["Normal"] = vec3(0, 1, 0);
  same.nodes.back().properties["space"] = std::string("WORLD");
  EXPECT_TRUE(compiled(same).program.constant());
}

TEST(Displacement, WhatIsNotThereIsNamed) {
  NodeGraph graph = sloped(single("BSDF_DIFFUSE", {}));
  graph.displacement->node = "Nowhere";
  EXPECT_TRUE(warned(compiled(graph), "Nowhere", "not there"));
  graph.displacement = NodeLink{"Up", "Other"};
  EXPECT_TRUE(warned(compiled(graph), "Up", "'Other'"));
  graph.displacement = NodeLink{"Up", "Displacement"};
  for (Node& n : graph.nodes) {
    n.type = n.name == "Up" ? "UNKNOWN" : n.type;
  }
  const Compiled unknown = compiled(graph);
  EXPECT_TRUE(warned(unknown, "Up", "UNKNOWN"));
  expect_near(Place().run(unknown.program).ns, vec3(0, 0, 1));
}

TEST(Displacement, OfAovsAsWell) {
  NodeGraph graph = sloped({});
  graph.nodes.push_back(node("Geometry", "NEW_GEOMETRY", {}));
  Node end = node("Normals", "OUTPUT_AOV", {{"Color", link("Geometry", "Normal")}});
  end.properties["aov_name"] = std::string("Normals");
  graph.nodes.push_back(end);
  std::vector<std::string> names;
  Diagnostics diagnostics;
  const Program program = compile_aovs(graph, "Material", {}, names, diagnostics, kAnySurface);
  program.run_aovs(Place().point, [](uint32_t, vec3 color, float) { expect_near(color, kSlope); });
  EXPECT_EQ(program.aovs.size(), 1u);
}

}  // namespace
}  // namespace janus::test
