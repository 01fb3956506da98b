// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every MIS weight of the recursion against its definition: the densities of all techniques of the
// whole path. Weights that follow the definition sum to 1 over the techniques of any path.
#include "janus/path/oracle.h"

#include <gtest/gtest.h>

#include "light/light_cases.h"
#include "support/by_path.h"
#include "support/statistics.h"

namespace janus::test {
namespace {

struct OracleScene {
  const char* name;
  SceneKit (*make)();
  bool light_is_point = false;  // cannot be hit
  bool nee = true;              // some light is sampled by next event estimation
};

NodeGraph glossy_coat() {  // delta and diffuse on one surface
  return combine("MIX_SHADER", diffuse(Rgb(0.7f, 0.5f, 0.3f)), glass(Rgb(0.9f), 1.45f), 0.4f);
}

const OracleScene kScenes[] = {
    {"area",
     [] { return open_box().light("lamp", area_light({0, 0, 0.9f}, {0, 0, 0}, 0.5f, 20)); }},
    {"area_spread",
     [] {
       return open_box().light("lamp", area_light({0, 0, 0.9f}, {0.3f, 0, 0}, 0.5f, 20, 1.2f));
     }},
    {"point", [] { return open_box().light("lamp", point_light({0.2f, 0, 0.5f}, 20)); }, true},
    {"point_soft", [] { return open_box().light("lamp", point_light({0.2f, 0, 0.5f}, 20, 0.2f)); }},
    {"point_sphere",
     [] { return open_box().light("lamp", point_light({0.2f, 0, 0.5f}, 20, 0.2f, false)); }},
    {"mesh",
     [] {
       return open_box().add("lamp", ball(0.3f, 8), emission(Rgb(1, 0.8f, 0.6f), 3),
                             translation({0.1f, 0, 0.4f}) * scaling({1, 0.6f, 0.8f}));
     }},
    {"world", [] { return open_box().world(Rgb(0.5f, 0.7f, 1)); }, false, false},
    {"glass_and_mirror",
     [] {
       return open_box()
           .add("cube", cuboid(vec3(-0.3f), vec3(0.3f)), glass(Rgb(0.95f), 1.5f),
                translation({-0.4f, 0, -0.4f}) * rotation({1, 1, 0}, 0.5f))
           .add("ball", ball(0.3f, 12, true), glass(Rgb(1), 1.33f), translation({0.4f, -0.3f, 0}))
           .add("mirror", plane(1, 1), mirror(Rgb(0.9f)),
                translation({0, 0.8f, 0}) * rotation({1, 0, 0}, 1.3f))
           .light("lamp", area_light({0, 0, 0.9f}, {0, 0, 0}, 0.6f, 20));
     }},
    {"mixture",
     [] {
       return open_box()
           .add("cube", cuboid(vec3(-0.35f), vec3(0.35f)), glossy_coat(),
                translation({-0.4f, 0, -0.4f}) * rotation({1, 1, 0}, 0.5f))
           .add("coat", plane(2, 2), combine("ADD_SHADER", diffuse(Rgb(0.3f)), mirror(Rgb(0.4f))),
                translation({0, 0, -0.95f}))
           .light("lamp", point_light({0.2f, 0, 0.5f}, 20, 0.15f));
     }},
    {"smooth_normals",
     [] {
       return open_box()
           .add("ball", ball(0.4f, 8, true), diffuse(Rgb(0.8f)), translation({0.2f, 0, -0.5f}))
           .add("glass", ball(0.3f, 8, true), glass(Rgb(1), 1.5f), translation({-0.5f, 0, -0.5f}))
           .light("lamp", area_light({0, 0, 0.9f}, {0, 0, 0}, 0.5f, 20));
     }},
    {"many_lights",
     [] {
       return open_box()
           .add("lamp", plane(0.4f, 0.3f), emission(Rgb(2, 1, 1), 3), translation({0, 0, 0.8f}))
           .add("ball", ball(0.3f, 8), glossy_coat(), translation({-0.4f, 0, -0.4f}))
           .light("a", area_light({0.5f, 0, 0.9f}, {0, 0, 0}, 0.3f, 5, 2.0f))
           .light("p", point_light({-0.5f, 0, 0.5f}, 5))
           .light("s", point_light({0.5f, -0.5f, 0.2f}, 5, 0.1f, false))
           .world(Rgb(0.3f));
     }},
    {"rough",  // both sides of surfaces, densities that differ by the side that a walk comes from
     [] {
       const NodeGraph frosted = single("BSDF_GLASS", {{"Roughness", 0.4f}, {"IOR", 1.5f}});
       return open_box()
           .add("glass", ball(0.35f, 10, true), frosted, translation({0.4f, -0.2f, -0.3f}))
           .add("bent", cuboid(vec3(-0.25f), vec3(0.25f)),
                single("BSDF_REFRACTION", {{"Roughness", 0.5f}, {"IOR", 1.3f}}),
                translation({-0.5f, -0.3f, -0.5f}) * rotation({1, 2, 0}, 0.6f))
           .add("leaf", plane(0.8f, 0.8f), single("BSDF_TRANSLUCENT", {}),
                translation({-0.4f, 0.2f, 0.3f}) * rotation({1, 1, 0}, 0.7f))
           .add("metal", plane(1.4f, 1.4f), single("BSDF_GLOSSY", {{"Roughness", 0.5f}}),
                translation({0, 0.9f, 0}) * rotation({1, 0, 0}, 1.4f))
           .light("lamp", area_light({0, 0, 0.9f}, {0, 0, 0}, 0.6f, 20));
     }},
    {"hair",  // where light walks end
     [] {
       return strands_in(open_box()).light("lamp", area_light({0, 0, 0.9f}, {0, 0, 0}, 0.6f, 20));
     }},
    {"principled",
     [] {
       const auto ball_of = [](SceneKit& kit, const char* name, vec3 p,
                               std::map<std::string, NodeInput> inputs) {
         kit.add(name, ball(0.3f, 10, true), single("BSDF_PRINCIPLED", std::move(inputs)),
                 translation(p));
       };
       SceneKit kit = open_box();
       ball_of(kit, "plastic", {-0.6f, 0, -0.5f}, {{"Roughness", 0.4f}});
       ball_of(kit, "coated", {0, -0.2f, -0.5f}, {{"Roughness", 0.0f}});
       ball_of(kit, "metal", {0.6f, 0, -0.5f}, {{"Roughness", 0.4f}, {"Metallic", 0.7f}});
       ball_of(kit, "glassy", {-0.4f, 0.3f, 0.3f},
               {{"Roughness", 0.5f}, {"Transmission Weight", 0.5f}});
       ball_of(kit, "ember", {0.5f, 0.2f, 0.3f}, {{"Emission Strength", 2.0f}});
       return kit.light("lamp", area_light({0, 0, 0.9f}, {0, 0, 0}, 0.6f, 20));
     }},
    {"subsurface",  // one vertex with two ends, which light walks pass in some of these
     [] {
       const auto principled = [](std::map<std::string, NodeInput> inputs) {
         inputs.insert({{"Subsurface Weight", 0.7f}, {"Subsurface Scale", 0.5f}});
         return single("BSDF_PRINCIPLED", std::move(inputs));
       };
       SceneKit kit = open_box(Rgb(0.6f, 0.5f, 0.4f));
       const auto add = [&](const char* name, vec3 p, const NodeGraph& graph) {
         kit.add(name, ball(0.3f, 10, true), graph, translation(p));
       };
       add("wax", {-0.6f, 0, -0.5f}, subsurface(Rgb(0.9f, 0.6f, 0.3f)));
       add("skin", {0, -0.2f, -0.5f}, subsurface(Rgb(0.8f), {}, "RANDOM_WALK_SKIN"));
       add("jelly", {0.6f, 0, -0.5f},
           subsurface(Rgb(0.7f), {{"Anisotropy", 0.8f}, {"Roughness", 0.3f}},
                      "RANDOM_WALK_LEGACY"));
       add("plastic", {0.5f, 0.2f, 0.3f}, principled({{"Coat Weight", 0.5f}}));
       add("smooth", {-0.4f, 0.3f, 0.3f}, principled({{"Roughness", 0.0f}}));
       add("twofold", {0, 0.4f, 0},
           combine("MIX_SHADER", subsurface(Rgb(0.8f)), subsurface(Rgb(0.2f, 0.5f, 0.8f))));
       return kit.light("lamp", area_light({0, 0, 0.9f}, {0, 0, 0}, 0.6f, 20));
     }},
    {"covers",  // they dim what they cover, and are in no density
     [] {
       SceneKit kit = open_box();
       const auto ball_of = [&](const char* name, vec3 p, const char* type,
                                std::map<std::string, NodeInput> inputs) {
         kit.add(name, ball(0.3f, 10, true), single(type, std::move(inputs)), translation(p));
       };
       ball_of("coated", {-0.6f, 0, -0.5f}, "BSDF_PRINCIPLED",
               {{"Coat Weight", 1.0f}, {"Coat Roughness", 0.4f}, {"Coat Tint", vec4(0.5f)}});
       ball_of("polished", {0, -0.2f, -0.5f}, "BSDF_PRINCIPLED",
               {{"Coat Weight", 0.7f}, {"Coat Roughness", 0.0f}, {"Roughness", 0.5f}});
       ball_of("dusty", {0.6f, 0, -0.5f}, "BSDF_PRINCIPLED",
               {{"Sheen Weight", 1.0f}, {"Sheen Roughness", 0.5f}, {"Metallic", 0.5f}});
       ball_of("ember", {0.5f, 0.2f, 0.3f}, "BSDF_PRINCIPLED",
               {{"Coat Weight", 1.0f}, {"Coat Roughness", 0.5f}, {"Emission Strength", 2.0f}});
       ball_of("velvet", {-0.4f, 0.3f, 0.3f}, "BSDF_SHEEN", {{"Roughness", 0.4f}});
       ball_of("bubble", {-0.1f, -0.6f, 0.1f}, "BSDF_GLASS",
               {{"Thin Film Thickness", 400.0f}, {"Thin Film IOR", 1.9f}, {"Roughness", 0.0f}});
       ball_of("comic", {0, 0.5f, 0}, "BSDF_TOON", {{"Size", 0.7f}, {"Smooth", 0.2f}});
       return kit.light("lamp", area_light({0, 0, 0.9f}, {0, 0, 0}, 0.6f, 20));
     }},
    {"crossings",  // they are in no density
     [] {
       const NodeGraph pane = single("BSDF_TRANSPARENT", {{"Color", vec4(0.9f, 0.7f, 0.5f, 1)}});
       return open_box()
           .add("pane", plane(1.9f, 1.9f), pane, translation({0, 0, 0.5f}))
           .add("screen", plane(1.5f, 1.5f), combine("MIX_SHADER", diffuse(Rgb(0.8f)), pane),
                rotation({1, 0, 0}, 1.3f))
           .add("lamp", cuboid({-0.3f, -0.3f, 0.7f}, {0.3f, 0.3f, 0.9f}),
                single("BSDF_PRINCIPLED", {{"Alpha", 0.5f}, {"Emission Strength", 5.0f}}));
     }},
    {"surfaces_by_path", &surfaces_by_path},    // where light walks end, too
    {"emitters_by_path", &emitters_by_path},    // which make none
    {"crossings_by_path", &crossings_by_path},  // and of these, over which they do not go
    {"world_by_path",
     [] { return world_by_path(lamp_by_path(emitters_by_path(), "Ray Depth", 1.5f)); }},
    {"wax_by_path",
     [] {
       return crossings_by_path().add(
           "wax", ball(0.3f, 10, true),
           by_count("Ray Depth", 0.5f, subsurface(Rgb(0.9f, 0.5f, 0.3f)), diffuse(Rgb(0.6f))),
           translation({-0.3f, -0.5f, 0.3f}));
     }},
    {"sun_spot_and_sky",
     [] {
       Image sky(8, 4, 3);
       for (size_t i = 0; i < sky.pixels.size(); ++i) {
         sky.pixels[i] = 0.1f * static_cast<float>(i % 7) + (i / 3 == 21 ? 5.0f : 0.0f);
       }
       return open_box()
           .light("sun", sun_light({0.1f, -1, 0.4f}, 1, 0.3f))
           .light("spot", spot_light({0.3f, -0.2f, 0.8f}, {0, 0, -0.5f}, 20, 1.4f, 0.4f))
           .light("soft", spot_light({-0.4f, 0, 0.8f}, {0, 0, -0.5f}, 20, 1.2f, 0.4f, 0.2f))
           .world(std::move(sky));
     }},
    {"sky_texture",  // its sun is a light of its own
     [] {
       SceneKit kit = open_box();
       kit.builder.set_world(
           {"World", sky_texture("SINGLE_SCATTERING",
                                 {{"sun_size", 0.8f}, {"sun_rotation", kPi}, {"altitude", 0.0f}})});
       return kit;
     }},
};

std::ostream& operator<<(std::ostream& out, const OracleScene& scene) { return out << scene.name; }

const SampleCounts kAllOne{1, 1, 1, 1};

WeightCheck check(const Scene& scene, Heuristic heuristic, const SampleCounts& counts,
                  int paths = 4000, int max_edges = 8) {
  constexpr int kSide = 32;
  const auto camera = make_camera(scene.camera, kSide, kSide);
  Random random(7);
  WalkSettings settings;
  settings.max_edges = max_edges;
  settings.by_path = scene.has_by_path;
  WeightCheck sum;
  for (int i = 0; i < samples(paths); ++i) {
    const vec2 raster = static_cast<float>(kSide) * random.next_2d();
    const WeightCheck c = check_weights(scene, *camera, raster, heuristic, counts, settings, 3, i);
    sum.paths += c.paths;
    sum.max_error = std::max(sum.max_error, c.max_error);
    sum.sum_error += c.sum_error;
    sum.inaccurate += c.inaccurate;
    sum.degenerate += c.degenerate;
    for (int k = 0; k < 4; ++k) {
      sum.by_class[k] += c.by_class[k];
    }
  }
  return sum;
}

// The recursion works in single precision: at grazing angles, one join in a thousand may lose
// digits.
void expect_exact(const WeightCheck& result) {
  EXPECT_LT(result.sum_error, 3e-6 * static_cast<double>(result.paths));
  EXPECT_LT(result.inaccurate, 1 + result.paths / 1000);
  EXPECT_LT(result.max_error, 2e-3);
  EXPECT_LT(result.degenerate, 1 + result.paths / 100);
}

class Oracle : public ::testing::TestWithParam<OracleScene> {};

TEST_P(Oracle, WeightsFollowTheDefinition) {
  const OracleScene& param = GetParam();
  const auto scene = param.make().build();
  const SampleCounts settings[] = {
      kAllOne,
      {1, 1, 0.37f, 1024},  // a render: light paths of a whole frame
      {0, 1, 1, 1},         // each class left out in turn
      {1, 0, 1, 1},
      {1, 1, 0, 300},
      {1, 1, 1, 0},
      {1, 1, 0, 0},   // path tracing
      {0, 0, 0, 64},  // light tracing
      {0.3f, 2.5f, 7, 0.2f},
      {1, 1, 1, 300, 0.5f},  // with merging, which takes its share
  };
  for (const Heuristic heuristic : {Heuristic::Balance, Heuristic::Power}) {
    for (const SampleCounts& counts : settings) {
      const WeightCheck result = check(*scene, heuristic, counts);
      SCOPED_TRACE(::testing::Message()
                   << "counts " << counts.hit << " " << counts.nee << " " << counts.connection
                   << " " << counts.splat << ", power " << (heuristic == Heuristic::Power));
      expect_exact(result);
      // What was meant to be tested has been.
      EXPECT_EQ(result.by_class[0] > 20, counts.hit > 0 && !param.light_is_point);
      EXPECT_EQ(result.by_class[1] > 100, counts.nee > 0 && param.nee);
      EXPECT_EQ(result.by_class[2] > 200, counts.connection > 0);
      EXPECT_EQ(result.by_class[3] > 100, counts.splat > 0);
    }
  }
}

// Long paths, where a factor that is lost at each vertex grows.
TEST_P(Oracle, LongPaths) {
  const auto scene = GetParam().make().build();
  for (const Heuristic heuristic : {Heuristic::Balance, Heuristic::Power}) {
    expect_exact(check(*scene, heuristic, {1, 1, 0.5f, 256}, 1000, 20));
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Oracle, ::testing::ValuesIn(kScenes),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace janus::test
