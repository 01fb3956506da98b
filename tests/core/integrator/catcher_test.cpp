// SPDX-License-Identifier: GPL-3.0-or-later
//
// Shadow catchers: what the rest of a scene does to their light, and to the footage behind them.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "support/pictures.h"
#include "support/scene_kit.h"

namespace janus::test {
namespace {

constexpr const char* kFactor = "Shadow Catcher";

void add_catcher(SceneKit& kit, const std::string& name, MeshDesc mesh, const NodeGraph& material,
                 const mat4& transform = mat4(1.0f)) {
  kit.builder.set_material(name, MaterialDesc{name, material});
  kit.builder.set_mesh(name, std::move(mesh));
  InstanceDesc instance;
  instance.mesh = name;
  instance.transform = transform;
  instance.materials.emplace_back(name);
  instance.shadow_catcher = true;
  kit.builder.set_instance(name, std::move(instance));
}

NodeGraph veil(Rgb color, Rgb through, float share) {
  return combine("MIX_SHADER", diffuse(color),
                 single("BSDF_TRANSPARENT", {{"Color", vec4(through, 1)}}), share);
}

std::unique_ptr<RenderSession> rendered(const std::shared_ptr<const Scene>& scene,
                                        const RenderSettings& settings) {
  auto session = std::make_unique<RenderSession>(scene, settings);
  session->start();
  session->finish();
  return session;
}

// The mean of each channel of the matte picture, of its alpha and of the factor.
std::vector<Mean> parts(const std::shared_ptr<const Scene>& scene, RenderSettings settings,
                        int count = seeds()) {
  settings.shadow_catcher = true;
  settings.seed += 1000 * (static_cast<uint32_t>(settings.integrator) + 1);
  std::vector<Mean> means(7);
  for (int i = 0; i < count; ++i, ++settings.seed) {
    const auto session = rendered(scene, settings);
    const Image matte = session->snapshot(), factor = session->snapshot(kFactor);
    std::vector<double> sums(7);
    const size_t pixels = static_cast<size_t>(matte.width) * matte.height;
    for (size_t p = 0; p < pixels; ++p) {
      for (size_t c = 0; c < 4; ++c) {
        sums[c] += matte.pixels[4 * p + c] / static_cast<double>(pixels);
      }
      for (size_t c = 0; c < 3; ++c) {
        sums[4 + c] += factor.pixels[3 * p + c] / static_cast<double>(pixels);
      }
    }
    for (size_t k = 0; k < sums.size(); ++k) {
      means[k].add(sums[k]);
    }
  }
  return means;
}

void expect_same_parts(const std::vector<Mean>& a, const std::vector<Mean>& b,
                       double tolerance = 0.01) {
  for (size_t k = 0; k < a.size(); ++k) {
    EXPECT_TRUE(agree(a[k], b[k], 4.8)) << "part " << k;
  }
  EXPECT_TRUE(close(a[4], b[4], tolerance));
}

// A room that catches, with things in it that are added: an object, a lamp, a leaf before the
// camera, and a veil that catches and shows what is behind it.
SceneKit footage() {
  SceneKit kit;
  add_catcher(kit, "box", cuboid(vec3(-1.0f), vec3(1.0f), true), diffuse(Rgb(0.6f, 0.5f, 0.4f)));
  kit.camera({0, -3.2f, 0}, {0, 0, 0}, 0.42f);
  kit.add("block", cuboid({-0.7f, -0.2f, -1}, {-0.2f, 0.4f, 0.1f}), diffuse(Rgb(0.7f, 0.2f, 0.2f)));
  kit.add("lamp", plane(0.5f, 0.3f), emission(Rgb(1, 0.8f, 0.5f), 2),
          translation({0.7f, 0.3f, 0}) * rotation({0, 1, 0}, -1.2f));
  const mat4 upright = rotation({1, 0, 0}, 0.5f * kPi);
  kit.add("leaf", plane(0.8f, 0.6f), veil(Rgb(0.2f, 0.7f, 0.3f), Rgb(0.9f, 0.7f, 0.8f), 0.6f),
          translation({0.4f, -1.2f, -0.4f}) * upright);
  add_catcher(kit, "veil", plane(0.7f, 0.9f), veil(Rgb(0.4f), Rgb(0.8f, 0.9f, 0.7f), 0.5f),
              translation({-0.4f, -0.7f, 0.3f}) * upright);
  kit.light("l", area_light({0, -0.2f, 0.9f}, {0, 0, 0}, 0.5f, 20));
  LightDesc added = area_light({-0.8f, -0.6f, 0.6f}, {0, 0, -1}, 0.3f, 4);
  added.lights_catchers = false;
  kit.light("added", added);
  return kit.world(Rgb(0.2f, 0.3f, 0.4f));
}

TEST(Catchers, AreTheSameByAllIntegrators) {
  const auto scene = footage().build();
  EXPECT_TRUE(scene->diagnostics.empty());
  for (const bool transparent : {false, true}) {
    const auto picture = [&](IntegratorType integrator, int count) {
      RenderSettings settings = small_picture(integrator, samples(count));
      settings.film_transparent = transparent;
      return settings;
    };
    const auto pt = parts(scene, picture(IntegratorType::PathTracer, 384));
    expect_same_parts(pt, parts(scene, picture(IntegratorType::Bdpt, 192)));
    expect_same_parts(pt, parts(scene, picture(IntegratorType::LightTracer, 256)));
    RenderSettings classic = picture(IntegratorType::Bdpt, 96);
    classic.connection_mode = ConnectionMode::Classic;
    expect_same_parts(pt, parts(scene, classic));
  }
}

// Light paths that hit the lens.
TEST(Catchers, AreTheSameWithoutNextEvents) {
  SceneKit kit = footage();
  CameraDesc camera;
  camera.transform = look_at({0, -3.2f, 0}, {0, 0, 0});
  camera.left = camera.bottom = -0.42f;
  camera.right = camera.top = 0.42f;
  camera.clip_start = 0.01f;
  camera.aperture_radius = 0.3f;
  camera.focus_distance = 3.2f;
  kit.builder.set_camera(camera);
  const auto scene = kit.build();
  // Large pixels: a factor with noise is too large.
  RenderSettings settings = small_picture(IntegratorType::PathTracer, samples(1024));
  settings.width = settings.height = 2;
  const auto pt = parts(scene, settings);
  settings.integrator = IntegratorType::LightTracer;
  settings.next_event = false;
  settings.light_paths = 64;
  settings.samples = samples(2048);
  expect_same_parts(pt, parts(scene, settings), 0.04);
}

TEST(Catchers, AreTheSameWhileThingsMove) {
  SceneKit kit = footage();
  kit.builder.set_instance_motion("block", {mat4(1.0f), translation({0.5f, 0.1f, 0.3f})});
  kit.builder.set_instance_motion("lamp",
                                  {translation({0.7f, 0.3f, 0}) * rotation({0, 1, 0}, -1.2f),
                                   translation({0.6f, -0.3f, 0.4f})});
  const auto scene = kit.build();
  const auto pt = parts(scene, small_picture(IntegratorType::PathTracer, samples(256)));
  expect_same_parts(pt, parts(scene, small_picture(IntegratorType::Bdpt, samples(128))));
  expect_same_parts(pt, parts(scene, small_picture(IntegratorType::LightTracer, samples(192))));
}

// --- Known answers -------------------------------------------------------------------------------

// A floor below the camera under a red and a blue sun. `hidden`: from the red one, by something
// that the camera does not see.
SceneKit floor_under_suns(bool hidden) {
  SceneKit kit;
  kit.camera({0, 0, 3}, {0, 0, 0}, 0.3f);
  add_catcher(kit, "floor", plane(8, 8), diffuse(Rgb(0.5f)));
  LightDesc red = sun_light({1, 0, 1}, 2, 0), blue = sun_light({-1, 0, 1}, 2, 0);
  red.color = Rgb(1, 0.5f, 0);
  blue.color = Rgb(0, 0.5f, 1);
  kit.light("red", red).light("blue", blue);
  if (hidden) {
    kit.add("roof", plane(4, 8), diffuse(Rgb(0)), translation({4, 0, 3}),
            kAllRays & ~ray_bit(RayType::Camera));
  }
  return kit;
}

constexpr float kNoise = 0.05f;  // of which sun is chosen

void expect_pixels(const Image& image, std::vector<float> expected, float tolerance = 1e-4f) {
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    ASSERT_NEAR(image.pixels[i], expected[i % expected.size()], tolerance) << i;
  }
}

TEST(Catchers, ShowWhatIsLeftOfLight) {
  for (const auto integrator : {IntegratorType::PathTracer, IntegratorType::Bdpt}) {
    RenderSettings settings = small_picture(integrator, 1024);
    settings.film_transparent = true;
    const auto scene = floor_under_suns(true).build();
    expect_pixels(render(scene, settings), {0, 0, 0, 0.5f}, kNoise);
    settings.shadow_catcher = true;
    const auto session = rendered(scene, settings);
    expect_pixels(session->snapshot(), {0, 0, 0, 0});
    expect_pixels(session->snapshot(kFactor), {0, 0.5f, 1}, kNoise);
  }
}

TEST(Catchers, ShowAddedLightInTheFactorAlone) {
  SceneKit kit = floor_under_suns(false);
  LightDesc added = sun_light({0, 1, 1}, 2, 0);
  added.color = Rgb(1, 0, 0);
  added.lights_catchers = false;
  kit.light("added", added);
  RenderSettings settings = small_picture(IntegratorType::PathTracer, 4096);
  settings.film_transparent = true;
  expect_pixels(render(kit.build(), settings), {0, 0, 0, 0});  // no shadow is less than none
  settings.shadow_catcher = true;
  expect_pixels(rendered(kit.build(), settings)->snapshot(kFactor), {2, 1, 1}, 0.2f);
}

TEST(Catchers, DarkenTheBackgroundWhereTheFilmShowsIt) {
  SceneKit kit = floor_under_suns(true);
  WorldDesc world{"World", single("BACKGROUND", {{"Color", vec4(0.2f, 0.4f, 0.8f, 1)}})};
  world.visibility = ray_bit(RayType::Camera);
  kit.builder.set_world(world);
  RenderSettings settings = small_picture(IntegratorType::PathTracer, 1024);
  settings.film_exposure = 2;
  settings.light_passes = {"Env"};
  const auto session = rendered(kit.build(), settings);
  expect_pixels(session->snapshot(), {0.2f, 0.4f, 0.8f, 1}, 1.6f * kNoise);
  expect_pixels(session->snapshot("Env"), {0.4f, 0.8f, 1.6f});
}

TEST(Catchers, AloneChangeNothing) {
  SceneKit kit = footage();
  for (const char* name : {"block", "lamp", "leaf", "added"}) {
    kit.builder.remove(name);
  }
  for (const auto integrator :
       {IntegratorType::PathTracer, IntegratorType::Bdpt, IntegratorType::LightTracer}) {
    RenderSettings settings = small_picture(integrator, 16);
    settings.film_transparent = true;
    expect_pixels(render(floor_under_suns(false).build(), settings), {0, 0, 0, 0}, 1e-5f);
    settings.shadow_catcher = true;
    expect_pixels(rendered(kit.build(), settings)->snapshot(kFactor), {1}, 1e-5f);
  }
}

// What the camera alone sees takes a share of the pixels, and no light, wherever it is.
TEST(Catchers, StandBehindWhatMoves) {
  SceneKit kit = floor_under_suns(false);
  kit.add("thing", plane(0.5f, 0.5f), diffuse(Rgb(0.5f)), translation({0, 0, 1}),
          ray_bit(RayType::Camera));
  kit.builder.set_instance_motion("thing", {translation({-0.5f, 0, 1}), translation({0.5f, 0, 1})});
  RenderSettings settings = small_picture(IntegratorType::PathTracer, 16);
  settings.shadow_catcher = true;
  expect_pixels(rendered(kit.build(), settings)->snapshot(kFactor), {1}, 1e-5f);
}

// --- The picture ---------------------------------------------------------------------------------

TEST(Catchers, ArePutTogetherFromTheirParts) {
  const auto scene = footage().build();
  for (const bool transparent : {true, false}) {
    RenderSettings settings = small_picture(IntegratorType::Bdpt, 8);
    settings.film_transparent = transparent;
    settings.light_passes = {"Env"};
    settings.film_exposure = 1.5f;
    const Image whole = render(scene, settings);
    settings.shadow_catcher = true;
    const auto session = rendered(scene, settings);
    const Image matte = session->snapshot(), factor = session->snapshot(kFactor);
    for (size_t p = 0; p < whole.pixels.size() / 4; ++p) {
      const float* m = &matte.pixels[4 * p];
      const float* f = &factor.pixels[3 * p];
      const float shadow = 1.0f - std::clamp((f[0] + f[1] + f[2]) / 3.0f, 0.0f, 1.0f);
      if (transparent) {
        EXPECT_EQ(whole.pixels[4 * p], m[0]);
        EXPECT_NEAR(whole.pixels[4 * p + 3], m[3] + (1.0f - m[3]) * shadow, 1e-5f);
      } else {
        EXPECT_GE(whole.pixels[4 * p], m[0]);
        EXPECT_EQ(whole.pixels[4 * p + 3], 1.0f);
      }
    }
  }
}

// Passes of light are those of the picture, as in Cycles.
TEST(Catchers, AreNotInPassesOfLight) {
  for (const auto integrator :
       {IntegratorType::PathTracer, IntegratorType::Bdpt, IntegratorType::LightTracer}) {
    RenderSettings settings = small_picture(integrator, 8);
    settings.film_transparent = true;
    settings.expressions = {{"all", "L.*E"}};
    const auto session = rendered(footage().build(), settings);
    const Image whole = session->snapshot(), all = session->snapshot("all");
    for (size_t p = 0; p < all.pixels.size() / 3; ++p) {
      for (size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(whole.pixels[4 * p + c], all.pixels[3 * p + c], 1e-4f);
      }
    }
  }
}

TEST(Catchers, AreTheSameBitForBitOnAllThreads) {
  const auto scene = footage().build();
  for (const auto integrator :
       {IntegratorType::PathTracer, IntegratorType::Bdpt, IntegratorType::LightTracer}) {
    RenderSettings settings = small_picture(integrator, 4);
    settings.filter = FilterType::BlackmanHarris;
    settings.threads = 1;
    const Image one = render(scene, settings);
    settings.threads = 3;
    EXPECT_EQ(one.pixels, render(scene, settings).pixels);
  }
}

TEST(Catchers, StopWithTheWholePicture) {
  const auto scene = footage().build();
  RenderSettings settings = small_picture(IntegratorType::PathTracer, 512);
  settings.data.passes[static_cast<size_t>(DataPass::SampleCount)] = true;
  settings.noise_threshold = 0.03f;
  settings.shadow_catcher = true;
  const auto session = rendered(scene, settings);
  const Image counts = session->snapshot("Debug Sample Count");
  const auto [least, most] = std::ranges::minmax(counts.pixels);
  EXPECT_LT(least, most);
  settings.noise_threshold = 0.0f;
  const Image factor = session->snapshot(kFactor),
              all = rendered(scene, settings)->snapshot(kFactor);
  const auto sum = [](const Image& image) {
    return std::accumulate(image.pixels.begin(), image.pixels.end(), 0.0);
  };
  EXPECT_NEAR(sum(factor) / sum(all), 1.0, 0.03);
}

TEST(Catchers, CostNothingWhereThereAreNone) {
  const auto scene = room().light("l", area_light({0, 0, 0.9f}, {0, 0, 0}, 0.5f, 20)).build();
  EXPECT_EQ(scene->catchers_alone, nullptr);
  RenderSettings settings = small_picture(IntegratorType::Bdpt, 4);
  const Image image = render(scene, settings);
  settings.shadow_catcher = true;
  const auto session = rendered(scene, settings);
  EXPECT_EQ(session->snapshot().pixels, image.pixels);
  expect_pixels(session->snapshot(kFactor), {1}, 0.0f);
}

TEST(Catchers, ShareWhatIsHeavy) {
  const auto scene = footage().build();
  ASSERT_NE(scene->catchers_alone, nullptr);
  EXPECT_EQ(scene->catchers_alone->instances.size(), 2u);
  EXPECT_EQ(scene->catchers_alone->accel->built(), 0u);
  EXPECT_EQ(scene->catchers_alone->lights.size(), scene->lights.size());
  EXPECT_EQ(scene->catchers_alone->lamps.size(), 2u);  // "l" and the world
}

// What holds out is no catcher, and neither is what the camera does not see.
TEST(Catchers, AreSeenByTheCamera) {
  InstanceDesc desc;
  desc.mesh = "mesh";
  desc.shadow_catcher = true;
  for (const bool holdout : {true, false}) {
    SceneKit kit;
    kit.builder.set_mesh("mesh", plane(1, 1));
    desc.holdout = holdout;
    desc.visibility = holdout ? kAllRays : kAllRays & ~ray_bit(RayType::Camera);
    kit.builder.set_instance("mesh", desc);
    EXPECT_EQ(kit.build()->catchers_alone, nullptr);
  }
}

}  // namespace
}  // namespace janus::test
