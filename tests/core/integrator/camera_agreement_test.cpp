// SPDX-License-Identifier: GPL-3.0-or-later
//
// Path tracing, light tracing and BDPT have the same expectation through every kind of camera. The
// filter is wide, so that the borders of the frame count: there a splat must find the film
// positions beyond it that camera rays start from.
#include "janus/path/oracle.h"
#include "support/pictures.h"
#include "support/scene_kit.h"

namespace janus::test {
namespace {

struct CameraCase {
  std::string name;
  void (*change)(CameraDesc&);
  int samples = 16;
};

void frame(CameraDesc& c, float left, float right, float bottom, float top) {
  c.left = left, c.right = right, c.bottom = bottom, c.top = top;
}

void lens(CameraDesc& c, float radius, float focus) {
  c.aperture_radius = radius;
  c.focus_distance = focus;
  c.aperture_blades = 5;
  c.aperture_rotation = 0.3f;
  c.aperture_ratio = 2.0f;
}

void panorama(CameraDesc& c, float left, float right, float bottom, float top) {
  c.type = CameraType::Equirectangular;
  c.transform = look_at({0.1f, -0.3f, 0.2f}, {0.4f, 1.0f, -0.1f});
  frame(c, left, right, bottom, top);
}

void fisheye(CameraDesc& c, CameraType type, float size, float fov) {
  panorama(c, -size, size, -0.9f * size, 1.1f * size);
  c.type = type;
  c.fisheye.fov = fov;
}

const CameraCase kCases[] = {
    {"shifted", [](CameraDesc& c) { frame(c, -0.1f, 0.4f, -0.4f, 0.2f); }},
    {"lens",
     [](CameraDesc& c) {
       c.aperture_radius = 0.3f;
       c.focus_distance = 2.5f;
     }},
    {"polygon_lens", [](CameraDesc& c) { lens(c, 0.3f, 2.2f); }},
    {"orthographic",
     [](CameraDesc& c) {
       c.type = CameraType::Orthographic;
       frame(c, -1.1f, 0.8f, -0.9f, 1.2f);
     }},
    {"orthographic_lens",
     [](CameraDesc& c) {
       c.type = CameraType::Orthographic;
       frame(c, -1.1f, 0.8f, -0.9f, 1.2f);
       lens(c, 0.3f, 3.2f);
     }},
    {"sphere", [](CameraDesc& c) { panorama(c, -kPi, kPi, -0.5f * kPi, 0.5f * kPi); }, 48},
    {"sphere_lens",
     [](CameraDesc& c) {
       panorama(c, -kPi, kPi, -0.5f * kPi, 0.5f * kPi);
       lens(c, 0.05f, 0.8f);
     },
     120},
    {"panorama", [](CameraDesc& c) { panorama(c, -1.2f, 0.9f, -0.7f, 1.0f); }, 24},
    {"fisheye", [](CameraDesc& c) { fisheye(c, CameraType::FisheyeEquidistant, 1.3f, 2.6f); }, 24},
    {"fisheye_lens",
     [](CameraDesc& c) {
       fisheye(c, CameraType::FisheyeEquisolid, 12.0f, 2.6f);
       lens(c, 0.05f, 0.8f);
     },
     48},
    {"polynomial",  // an angle that turns back, so that it sees things twice
     [](CameraDesc& c) {
       fisheye(c, CameraType::FisheyeLensPolynomial, 16.0f, 2.4f);
       c.fisheye.polynomial = {-0.05f, -0.19f, 0.01f, 0.0f, 0.0f};
     },
     48},
    {"mirror_ball", [](CameraDesc& c) { fisheye(c, CameraType::MirrorBall, 1.05f, kPi); }, 48},
    {"cubemap_face_lens",
     [](CameraDesc& c) {
       fisheye(c, CameraType::EquiangularCubemapFace, 0.7f, kPi);
       lens(c, 0.05f, 0.8f);
     },
     24},
    {"cylinder", [](CameraDesc& c) { fisheye(c, CameraType::CentralCylindrical, 1.3f, kPi); }, 24},
};

std::ostream& operator<<(std::ostream& out, const CameraCase& c) { return out << c.name; }

class CameraAgreement : public ::testing::TestWithParam<CameraCase> {
 protected:
  std::shared_ptr<const Scene> scene() const {
    SceneKit kit = open_box();
    LightDesc lamp = area_light({0, 0, 0.9f}, {0, 0, 0}, 0.5f, 20);
    lamp.visibility = kLabels;  // seen from the side it is most of the noise
    kit.add("block", cuboid({-0.7f, -0.2f, -1}, {-0.2f, 0.4f, 0.1f}), diffuse(Rgb(0.7f)))
        .add("low", cuboid({0.2f, -0.6f, -1}, {0.7f, 0.0f, -0.4f}), diffuse(Rgb(0.2f, 0.5f, 0.8f)))
        .light("l", lamp);
    CameraDesc desc;
    desc.name = "Camera";
    desc.transform = look_at({0, -3.2f, 0}, {0, 0, 0});
    frame(desc, -0.42f, 0.42f, -0.42f, 0.42f);
    desc.clip_start = 0.01f;
    GetParam().change(desc);
    kit.builder.set_camera(desc);
    return kit.build();
  }
};

TEST_P(CameraAgreement, AllIntegrators) {
  const auto scene = this->scene();
  const auto wide = [](IntegratorType type, int count) {
    RenderSettings settings = small_picture(type, samples(count));
    settings.filter = FilterType::BlackmanHarris;
    settings.filter_width = 4.0f;
    return settings;
  };
  const int count = GetParam().samples;
  const auto bdpt = quarters(scene, wide(IntegratorType::Bdpt, count));
  const auto pt = quarters(scene, wide(IntegratorType::PathTracer, 2 * count));
  const auto lt = quarters(scene, wide(IntegratorType::LightTracer, count));
  expect_agreement(bdpt, pt);
  expect_agreement(lt, pt);
}

TEST_P(CameraAgreement, WeightsFollowTheDefinition) {
  const auto scene = this->scene();
  const auto camera = make_camera(scene->camera, 16, 16);
  const SampleCounts counts{1, 1, 0.7f, 300};
  Random random(3);
  WeightCheck sum;
  for (int i = 0; i < 300; ++i) {
    const WeightCheck check = check_weights(*scene, *camera, random.next_2d() * 16.0f,
                                            Heuristic::Balance, counts, {}, 1, i);
    sum.paths += check.paths;
    sum.sum_error += check.sum_error;
    sum.max_error = std::max(sum.max_error, check.max_error);
  }
  EXPECT_GT(sum.paths, 1000);
  EXPECT_LT(sum.sum_error / sum.paths, 1e-5);
  EXPECT_LT(sum.max_error, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Kinds, CameraAgreement, ::testing::ValuesIn(kCases),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace janus::test
