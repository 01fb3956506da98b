// SPDX-License-Identifier: GPL-3.0-or-later
//
// The same picture at a millimetre and at a kilometre, at the origin and far from it: in closed
// scenes of known radiance, light that leaks out or is lost at its own surface shows at once.
#include "support/pictures.h"
#include "support/scene_kit.h"

namespace janus::test {
namespace {

// Size, distance from the origin in sizes, whether the size is in the mesh.
class Scale : public ::testing::TestWithParam<std::tuple<float, float, bool>> {
 protected:
  Scale() {
    const auto& [size, distance, in_mesh] = GetParam();
    const mat4 place = translation(size * distance * vec3(0.6f, -0.7f, 0.4f)) *
                       rotation({1, 2, 3}, 0.7f) * scaling({1.0f, 1.7f, 0.6f});
    transform_ = place * scaling(vec3(in_mesh ? 1.0f : size));
    CameraDesc camera;
    camera.name = "Camera";
    const mat4 to_world = place * scaling(vec3(size));
    camera.transform = look_at(vec3(to_world * vec4(0, -0.9f, 0, 1)), vec3(to_world[3]));
    camera.clip_start = 1e-3f * size;
    camera.clip_end = 1e3f * size;
    kit_.builder.set_camera(camera);
  }
  MeshDesc sized(MeshDesc mesh) const {
    for (vec3& p : mesh.positions) {
      p *= std::get<2>(GetParam()) ? std::get<0>(GetParam()) : 1.0f;
    }
    return mesh;
  }
  // Every path counts, so that there is hardly any noise: what differs is lost or leaked.
  void expect(float radiance, double tolerance, int bounces) {
    for (const IntegratorType type : {IntegratorType::PathTracer, IntegratorType::Bdpt}) {
      RenderSettings settings = small_picture(type, samples(16));
      settings.max_bounces = bounces;
      const Mean mean = quarters(kit_.build(), settings, 4)[0];
      EXPECT_NEAR(mean.mean(), radiance, tolerance * radiance) << static_cast<int>(type);
    }
  }
  SceneKit kit_;
  mat4 transform_;
};

// Emission and albedo in a closed box with boxes in it: L = e / (1 - a).
TEST_P(Scale, GlowingRoom) {
  const NodeGraph glow = combine("ADD_SHADER", diffuse(Rgb(0.5f)), emission(Rgb(1), 1));
  kit_.add("room", sized(cuboid(vec3(-1), vec3(1))), glow, transform_)
      .add("block", sized(cuboid(vec3(-0.3f), vec3(0.3f))), glow,
           transform_ * translation(vec3(std::get<2>(GetParam()) ? std::get<0>(GetParam()) : 1.0f) *
                                    vec3(0.2f, 0.5f, -0.7f)));  // stands on the floor
  expect(2.0f, 0.01, 40);
}

// Glass that absorbs nothing vanishes in a white world, whatever its thickness.
TEST_P(Scale, GlassInAWhiteWorld) {
  kit_.add("glass", sized(ball(0.6f, 24)), glass(Rgb(1), 1.5f), transform_);
  kit_.world(Rgb(1.0f));
  expect(1.0f, 0.001, 200);
}

INSTANTIATE_TEST_SUITE_P(Sizes, Scale,
                         ::testing::Combine(::testing::Values(1e-3f, 1.0f, 1e3f),
                                            ::testing::Values(0.0f, 1000.0f), ::testing::Bool()));

}  // namespace
}  // namespace janus::test
