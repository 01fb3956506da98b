// SPDX-License-Identifier: GPL-3.0-or-later
//
// Passes of data of a pane before a wall, both straight ahead: all is known.
#include <gtest/gtest.h>

#include <algorithm>

#include "janus/session/session.h"
#include "support/scene_kit.h"

namespace janus::test {
namespace {

// Facing a camera that looks along +y.
mat4 upright(float y) { return translation({0, y, 0}) * rotation({1, 0, 0}, 0.5f * kPi); }

// The eye at y=-3, so that the pane, which lets half of the light through, is 3 metres away and the
// wall 5.
SceneKit pane_and_wall(const NodeGraph& pane) {
  SceneKit kit;
  kit.add("wall", plane(8, 8), diffuse(Rgb(0.8f, 0.4f, 0.2f)), upright(2));
  kit.add("pane", plane(4, 4), pane, upright(0));
  kit.world(Rgb(0.2f, 0.3f, 0.4f));
  kit.camera({0, -3, 0}, {0, 0, 0}, 1e-4f);
  return kit;
}
NodeGraph half_clear() {
  return combine("MIX_SHADER", diffuse(Rgb(0.6f, 0.5f, 0.4f)), single("BSDF_TRANSPARENT", {}));
}

// The pixel of each pass; `threshold` of alpha.
std::map<std::string, std::vector<float>> look(const SceneKit& kit, float threshold = 0.5f,
                                               float occlusion_distance = 1.0f) {
  RenderSettings settings;
  settings.width = settings.height = 1;
  settings.samples = 16;
  settings.threads = 1;
  settings.integrator = IntegratorType::PathTracer;
  std::ranges::fill(settings.data.passes, true);
  std::ranges::fill(settings.data.mattes, true);
  settings.data_settings.mist = {1.0f, 8.0f, 1.0f};
  settings.data_settings.alpha_threshold = threshold;
  settings.data_settings.occlusion_distance = occlusion_distance;
  RenderSession session(kit.build(), settings);
  session.start();
  session.finish();
  std::map<std::string, std::vector<float>> found;
  for (const std::string& name : settings.data.names()) {
    found[name] = session.snapshot(name).pixels;
  }
  return found;
}

void expect(const std::vector<float>& found, const std::vector<float>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (size_t i = 0; i < found.size(); ++i) {
    EXPECT_NEAR(found[i], expected[i], 1e-3f * std::max(1.0f, std::abs(expected[i]))) << i;
  }
}

TEST(DataPasses, SeeASurface) {
  const auto found = look(pane_and_wall(half_clear()));
  expect(found.at("Depth"), {3});
  expect(found.at("Position"), {0, 0, 0});
  expect(found.at("Normal"), {0, -1, 0});
  expect(found.at("Debug Sample Count"), {16});
  // In front of the camera, which looks along +z.
  expect(found.at("Denoising Normal"), {0, 0, -1});
  expect(found.at("Denoising Albedo"), {0.3f, 0.25f, 0.2f});
  expect(found.at("Denoising Depth"), {2.99f});  // as in Cycles, from where the view is clipped
}

TEST(DataPasses, LookThroughWhatHasLittleAlpha) {
  const auto found = look(pane_and_wall(half_clear()), 0.6f);
  expect(found.at("Depth"), {5});
  expect(found.at("Position"), {0, 2, 0});
  expect(found.at("Normal"), {0, -1, 0});
}

// Each of the two covers a half.
TEST(DataPasses, ShareMistAndMattesByAlpha) {
  const auto found = look(pane_and_wall(half_clear()), 0.6f);
  expect(found.at("Mist"), {1 - 0.5f * 0.75f - 0.5f * 0.5f});
  const float pane = cryptomatte_id(cryptomatte_hash("pane"));
  const float wall = cryptomatte_id(cryptomatte_hash("wall"));
  for (const char* name : {"CryptoObject00", "CryptoMaterial00", "CryptoAsset00"}) {
    expect(found.at(name), {pane, 0.5f, wall, 0.5f});
  }
}

// The wall is two metres behind the pane, which lets half of everything pass.
TEST(DataPasses, SayWhatOccludes) {
  expect(look(pane_and_wall(half_clear())).at("AO"), {1, 1, 1});
  SceneKit wide = pane_and_wall(half_clear());
  wide.add("pane", plane(4000, 4000), half_clear(), upright(0));
  expect(look(wide, 0.5f, 0.0f).at("AO"), {0.75f, 0.75f, 0.75f});
  SceneKit room;
  room.add("room", cuboid(vec3(-1), vec3(1)), diffuse(Rgb(0.5f)));
  room.camera({0, 0, 0}, {0, 1, 0}, 1e-4f);
  expect(look(room, 0.5f, 0.0f).at("AO"), {0, 0, 0});
  expect(look(room, 0.5f, 0.5f).at("AO"), {1, 1, 1});
}

TEST(DataPasses, FollowMirrorsForDenoisersAlone) {
  const auto found = look(pane_and_wall(mirror(Rgb(0.9f, 0.8f, 0.7f))));
  expect(found.at("Depth"), {3});
  expect(found.at("Denoising Depth"), {2.99f});     // as in Cycles, from where the view is clipped
  expect(found.at("Denoising Normal"), {0, 0, 0});  // there is nothing but the sky
  expect(found.at("Denoising Albedo"), {0.18f, 0.24f, 0.28f});
}

TEST(DataPasses, SeeNothingOfHoldouts) {
  SceneKit kit = pane_and_wall(half_clear());
  kit.add("pane", plane(4, 4), half_clear(), upright(0), kAllRays, true);
  for (const auto& [name, pixel] : look(kit)) {
    if (!name.starts_with("Denoising") && name != "Debug Sample Count") {
      const float nothing = name == "Depth" ? 1e10f : name == "Mist" ? 1.0f : 0.0f;
      expect(pixel, std::vector<float>(pixel.size(), nothing));
    }
  }
}

TEST(DataPasses, HaveNumbersAndNames) {
  SceneKit kit = pane_and_wall(half_clear());
  InstanceDesc pane;
  pane.mesh = "pane";
  pane.name = "Window";
  pane.asset = "House";
  pane.object_index = 7;
  pane.materials = {"pane"};
  pane.transform = upright(0);
  kit.builder.set_instance("pane", pane);
  kit.builder.set_material("pane", {"Glass", half_clear(), true, 9});
  const auto found = look(kit);
  expect(found.at("IndexOB"), {7});
  expect(found.at("IndexMA"), {9});
  const auto id = [](const char* name) { return cryptomatte_id(cryptomatte_hash(name)); };
  EXPECT_EQ(found.at("CryptoObject00")[0], id("Window"));
  EXPECT_EQ(found.at("CryptoMaterial00")[0], id("Glass"));
  EXPECT_EQ(found.at("CryptoAsset00")[0], id("House"));
  RenderSettings settings;
  const RenderSession session(kit.build(), settings);
  EXPECT_EQ(session.manifest(MatteKind::Asset).at("House"),
            cryptomatte_hex(cryptomatte_hash("House")));
  EXPECT_TRUE(session.manifest(MatteKind::Material).contains("Glass"));
  EXPECT_TRUE(session.manifest(MatteKind::Object).contains("Window"));
}

}  // namespace
}  // namespace janus::test
