// SPDX-License-Identifier: GPL-3.0-or-later
//
// What Cycles makes of settings at their limits and beyond; the pictures of the closures' grid
// (tests/images/closure_grid.py) say that it is so.
#include <gtest/gtest.h>

#include "janus/shading/compiler.h"
#include "janus/shading/facet_lobes.h"
#include "janus/shading/fresnel.h"
#include "janus/shading/layers.h"
#include "shading/lobes.h"
#include "support/scene_kit.h"

namespace janus::test {
namespace {

const Rgb kWhite(1);

Program compiled(const NodeGraph& graph) {
  Diagnostics diagnostics;
  Program program = compile(graph, "Material", {}, diagnostics);
  EXPECT_TRUE(diagnostics.empty());
  return program;
}

NodeGraph sum(const NodeGraph& a, const NodeGraph& b) { return combine("ADD_SHADER", a, b); }

TEST(Limits, RefractionClampsTheSquareOfItsRoughness) {
  for (const auto& [roughness, alpha] : {std::pair(-0.5f, 0.25f), {0.5f, 0.25f}, {2.0f, 1.0f}}) {
    NodeGraph graph = single("BSDF_REFRACTION", {{"Roughness", roughness}});
    graph.nodes[0].properties["distribution"] = std::string("GGX");
    const Program program = compiled(graph);
    EXPECT_FLOAT_EQ(program.lobes.at(0).alpha, alpha);
  }
  EXPECT_FLOAT_EQ(compiled(single("BSDF_GLASS", {{"Roughness", -0.5f}})).lobes.at(0).alpha, 0.0f);
}

TEST(Limits, EmissionIsASumThatIsNotBelowZero) {
  EXPECT_EQ(compiled(emission(Rgb(-1, 1, -2), -2)).emission, Rgb(2, 0, 4));
  EXPECT_EQ(compiled(sum(emission(kWhite, 1), emission(Rgb(1, 0.5f, 2), -1))).emission,
            Rgb(0, 0.5f, 0));
  // Of which a part varies.
  NodeGraph varies = sum(emission(kWhite, 1), emission(Rgb(1, 0.25f, 3), -0.5f));
  varies.nodes[0].inputs["Strength"] = link("Geometry", "Backfacing");
  varies.nodes.push_back(node("Geometry", "NEW_GEOMETRY", {}));
  const Program program = compiled(varies);
  ShadingPoint point{};
  point.ng = point.ns = kNg;
  ShadingResult seen;
  point.view = -kNg;
  program.run(point, seen);
  EXPECT_EQ(seen.emission, Rgb(0.5f, 0.875f, 0));
  point.view = kNg;
  program.run(point, seen);
  EXPECT_EQ(seen.emission, Rgb(0));
}

TEST(Limits, DielectricsReflectNoLessThanStraightOn) {
  for (const float eta : {8.0f, 1 / 8.0f}) {
    const float f0 = fresnel_normal(eta);
    bool floored = false;
    for (float cos = 0.0f; cos <= 1.0f; cos += 0.0005f) {
      EXPECT_GE(fresnel_closure(cos, eta), f0);
      floored |= fresnel_dielectric(cos, eta) < 0.98f * f0;
    }
    EXPECT_TRUE(floored);
  }
  const float brewster = std::cos(std::atan(8.0f));
  for (const Lobe& lobe : {specular_lobe(kWhite, 8, 0), glass_lobe(kWhite, kWhite, true, 8, 0)}) {
    const Bsdf bsdf = make({lobe});
    const auto s =
        bsdf.view(kNg).sample(at_cosine(brewster), 0.5f, vec2(0), TransportMode::Radiance);
    ASSERT_TRUE(s && !s->transmitted);
    const float probability = lobe.type == LobeType::Glass ? s->pdf_solid : 1.0f;
    EXPECT_NEAR(s->weight.x * probability, fresnel_normal(8), 1e-5);
  }
}

TEST(Limits, PrincipledLayerMayHideAllBelow) {
  const auto lobes = compiled(single("BSDF_PRINCIPLED", {{"Specular IOR Level", 40.0f}})).lobes;
  ASSERT_EQ(lobes.size(), 2u);
  for (const float mu : {0.1f, 0.7f, 1.0f}) {
    EXPECT_EQ(reflectance(lobes[0], mu), kWhite);
    EXPECT_EQ(layer_transmittance(lobes[0], mu), Rgb(0));
  }
}

// Colours above 1 gain at every bounce between facets; where that has no sum, there is a limit.
TEST(Limits, BrightMultiscatter) {
  const Bsdf one = make({glossy_lobe(Rgb(1.0f), 0.5f, true, Rgb(1.0f))}),
             bright = make({glossy_lobe(Rgb(1.5f), 0.5f, true, Rgb(1.5f))}),
             wild = make({glossy_lobe(Rgb(1.0f), 1.0f, true, Rgb(50.0f))});
  EXPECT_GT(integrated(bright.view(kNg), at_cosine(0.6f)),
            1.55 * integrated(one.view(kNg), at_cosine(0.6f)));
  const double limited = integrated(wild.view(kNg), at_cosine(0.6f));
  EXPECT_GT(limited, 1.0);
  EXPECT_LT(limited, 1000.0);
}

// --- Normals that are the closure's own ----------------------------------------------------------

Bsdf bumped(Lobe lobe, vec3 normal) {
  lobe.bumped = true;
  return make({placed(lobe, normal)});
}

TEST(Bumps, LightEndsAtTheSurfaceAndAtTheBump) {
  Random random(3);
  const vec3 ns = normalize(vec3(0.1f, 0.0f, 1.0f));
  const Bsdf tilted = bumped(diffuse_lobe(kWhite), kTilted),
             away = bumped(diffuse_lobe(kWhite), normalize(vec3(1, 0, -0.5f)));
  int softened = 0;
  for (int i = 0; i < 2000; ++i) {
    vec3 wo = random.direction(), wi = random.direction();
    wo.z = std::abs(wo.z);
    wi.z = std::abs(wi.z);
    const float lambert = std::max(0.0f, dot(wi, kTilted)) * kInvPi,
                value = tilted.view(kNg, ns).eval_cos(wo, wi).x;
    if (dot(wi, ns) < 0.0f) {
      EXPECT_EQ(value, 0.0f);
    } else {
      EXPECT_LE(value, lambert * 1.00001f);
      softened += value < 0.9f * lambert;
      EXPECT_GE(value, (dot(wi, ns) > 0.3f ? 0.9f : 0.0f) * lambert);
      EXPECT_EQ(away.view(kNg, ns).eval_cos(wo, wi).x, 0.0f);
    }
    // The same from behind.
    EXPECT_NEAR(tilted.view(kNg, ns).eval_cos(-wo, -wi).x, value, 1e-6);
  }
  EXPECT_GT(softened, 20);
}

TEST(Bumps, AreMarkedWhereANormalIsLinked) {
  NodeGraph graph = single("BSDF_DIFFUSE", {{"Normal", link("Flat", "True Normal")}});
  graph.nodes.push_back(node("Flat", "NEW_GEOMETRY", {}));
  const Program program = compiled(graph);
  ShadingPoint point{};
  point.ng = point.view = kNg;
  for (const vec3 ns : {kNg, kTilted}) {
    point.ns = ns;
    ShadingResult result;
    program.run(point, result);
    EXPECT_EQ(result.bsdf.lobes()[0].bumped, ns != kNg);
  }
}

}  // namespace
}  // namespace janus::test
