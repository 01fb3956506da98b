// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lights in whole pictures: path tracing (next event estimation and hits), light tracing (emission)
// and BDPT agree, and every weight is what its definition says.
#include <gtest/gtest.h>

#include "janus/path/oracle.h"
#include "light/light_cases.h"
#include "support/pictures.h"

namespace janus::test {
namespace {

struct TransportCase {
  std::string name;
  SceneKit (*make)();
  int samples = 16;
};

// Open towards the camera, with a block for shadows.
SceneKit room() {
  return open_box().add("block", cuboid({-0.7f, -0.2f, -1}, {-0.2f, 0.4f, 0.1f}),
                        diffuse(Rgb(0.7f)));
}

// Bright off the plane of its centre: where it lies flat to its receiver, it hardly shines.
LightDesc bright_off_the_middle(LightDesc desc) {
  NodeGraph graph = single("EMISSION", {{"Strength", link("Times", "Value")}});
  const auto math = [](const char* name, const char* operation, const NodeInput& a) {
    Node n = node(name, "MATH", {{"Value", a}, {"Value_001", 8.0f}});
    n.properties = {{"operation", std::string(operation)}};
    return n;
  };
  graph.nodes.insert(
      graph.nodes.end(),
      {math("Times", "MULTIPLY", link("Off", "Value")), math("Off", "ABSOLUTE", link("Split", "Z")),
       node("Split", "SEPXYZ", {{"Vector", link("Where", "Object")}}),
       node("Where", "TEX_COORD", {})});
  desc.graph = graph;
  return desc;
}

const TransportCase kCases[] = {
    {"soft_point_by_nodes",  // its disk turns to each receiver
     [] {
       return room().light("l", bright_off_the_middle(point_light({0.1f, 0, 0.1f}, 20, 0.5f)));
     },
     48},
    {"soft_point_falling_by_nodes",
     [] { return room().light("l", falling(point_light({0.1f, 0, 0.1f}, 20, 0.5f))); }, 48},
    {"spot",
     [] { return room().light("l", spot_light({0.1f, 0, 0.9f}, {0, 0.2f, 0}, 30, 1.2f, 0.3f)); }},
    {"spot_soft",
     [] {
       LightDesc l = spot_light({0.1f, 0, 0.7f}, {0, 0.3f, 0}, 30, 1.3f, 0.5f, 0.25f);
       l.transform = l.transform * scaling({1, 0.6f, 1}) * sheared(1, 0, 0.3f);
       return room().light("l", l);
     },
     32},
    {"spot_sphere",
     [] {
       return room().light("l",
                           spot_light({0.1f, 0, 0.6f}, {0, 0, 0}, 30, 1.5f, 0.5f, 0.25f, false));
     },
     32},
    {"sphere_around_a_part",
     [] { return room().light("l", point_light({0.2f, 0, 0}, 20, 0.9f, false)); }, 40},
    {"sun", [] { return room().light("l", sun_light({0.2f, -1, 0.5f}, 3, 0)); }, 32},
    {"sun_disk", [] { return room().light("l", sun_light({0.2f, -1, 0.5f}, 3, 0.5f)); }, 40},
    {"world_image", [] { return room().world(sky()); }, 128},
    {"spot_by_nodes",
     [] {
       return room().light(
           "l", by_nodes(spot_light({0.1f, 0, 0.7f}, {0, 0.3f, 0}, 60, 1.3f, 0.5f, 0.25f)));
     },
     32},
    {"area_by_nodes",
     [] { return room().light("l", by_nodes(area_light({0, 0, 0.9f}, {0.1f, 0, 0}, 0.8f, 40))); },
     32},
    {"world_of_nodes",  // a light from behind the camera and from above: through the open side
     [] {
       return world_of_nodes(
           SceneKit()
               .add("floor", plane(3, 3), diffuse(Rgb(0.7f, 0.6f, 0.5f)), translation({0, 0, -1}))
               .add("block", cuboid({-0.7f, -0.2f, -1}, {-0.2f, 0.4f, 0.1f}), diffuse(Rgb(0.7f)))
               .add("wall", plane(2, 2), diffuse(Rgb(0.4f, 0.5f, 0.6f)),
                    translation({0.4f, 0.9f, 0}) * rotation({1, 0, 0}, 0.5f * kPi))
               .camera({0, -3, 0.8f}, {0, 0, -0.5f}));
     },
     96},
    {"area_narrow",
     [] { return room().light("l", area_light({0, 0, 0.95f}, {0.1f, 0, 0}, 1.2f, 20, 0.6f)); }, 48},
    {"many",  // all at once: the choice of lights matters
     [] {
       SceneKit kit = room();
       kit.add("lamp", ball(0.1f, 6), emission(Rgb(1, 0.7f, 0.5f), 20),
               translation({0.5f, 0, -0.5f}));
       for (int i = 0; i < 12; ++i) {
         const float x = -0.8f + 0.14f * i;
         kit.light("p" + std::to_string(10 + i),
                   point_light({x, 0.6f, 0.8f}, 1, i % 2 ? 0.0f : 0.05f, i % 3 == 0));
         kit.light("s" + std::to_string(10 + i),
                   spot_light({x, -0.4f, 0.8f}, {x, 0, -1}, 4, 0.8f, 0.5f));
       }
       return kit.light("sun", sun_light({0.2f, -1, 0.5f}, 0.5f, 0.3f)).world(sky(), 0.05f);
     },
     40},
};

std::ostream& operator<<(std::ostream& out, const TransportCase& c) { return out << c.name; }

class LightTransport : public ::testing::TestWithParam<TransportCase> {};

TEST_P(LightTransport, IntegratorsAgree) {
  const auto& [name, make, count] = GetParam();
  const auto scene = make().build();
  EXPECT_TRUE(scene->diagnostics.empty());
  const auto pt = quarters(scene, small_picture(IntegratorType::PathTracer, samples(2 * count)));
  expect_agreement(quarters(scene, small_picture(IntegratorType::Bdpt, samples(count))), pt);
  expect_agreement(quarters(scene, small_picture(IntegratorType::LightTracer, samples(count))), pt);
}

TEST_P(LightTransport, WeightsFollowTheDefinition) {
  const auto scene = GetParam().make().build();
  const auto camera = make_camera(scene->camera, 32, 32);
  Random random(7);
  uint64_t paths = 0;
  WalkSettings settings;
  settings.max_edges = 7;
  for (int i = 0; i < samples(1000); ++i) {
    const WeightCheck c = check_weights(*scene, *camera, 32.0f * random.next_2d(),
                                        Heuristic::Balance, {1, 1, 0.5f, 2}, settings, 3, i);
    paths += c.paths;
    ASSERT_LT(c.max_error, 1e-3);
  }
  EXPECT_GT(paths, 1500u);
}

INSTANTIATE_TEST_SUITE_P(Scenes, LightTransport, ::testing::ValuesIn(kCases),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace janus::test
