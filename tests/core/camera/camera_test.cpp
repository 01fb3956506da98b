// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every kind of camera: sample_ray and connect are each other's inverse, and the density is the
// inverse of the area that a pixel covers.
#include "janus/camera/camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "janus/camera/aperture.h"
#include "support/scene_kit.h"
#include "support/statistics.h"

namespace janus::test {
namespace {

constexpr int kWidth = 40, kHeight = 30;

CameraDesc shifted_camera() {  // off-centre window, scaled object, pixels that are not square
  CameraDesc desc;
  desc.transform = look_at({1, -2, 3}, {0.3f, 0.2f, 0}) * scaling({2, 3, 0.5f});
  desc.left = -0.3f, desc.right = 0.6f, desc.bottom = -0.5f, desc.top = 0.2f;
  desc.clip_start = 0.5f, desc.clip_end = 20;
  return desc;
}

CameraDesc with_lens(CameraDesc desc, float radius) {
  desc.aperture_radius = radius;
  desc.focus_distance = 3.0f;
  desc.aperture_blades = 5;
  desc.aperture_rotation = 0.4f;
  desc.aperture_ratio = 1.5f;
  return desc;
}

CameraDesc orthographic() {
  CameraDesc desc = shifted_camera();
  desc.type = CameraType::Orthographic;
  desc.left = -1.5f, desc.right = 0.5f, desc.bottom = -0.8f, desc.top = 1.0f;
  return desc;
}

CameraDesc panorama(float left, float right, float bottom, float top) {
  CameraDesc desc = shifted_camera();
  desc.type = CameraType::Equirectangular;
  desc.left = left, desc.right = right, desc.bottom = bottom, desc.top = top;
  return desc;
}
CameraDesc whole_sphere() { return panorama(-kPi, kPi, -0.5f * kPi, 0.5f * kPi); }

// `size`: half of the frame's width, in the units of its film. The frame is higher than wide, and
// not in the middle.
CameraDesc film(CameraType type, float size, float fov = kPi) {
  CameraDesc desc = panorama(-0.9f * size, 1.1f * size, -1.3f * size, size);
  desc.type = type;
  desc.fisheye.fov = fov;
  return desc;
}
CameraDesc polynomial(std::array<float, 5> k, float size, float fov = kPi) {
  CameraDesc desc = film(CameraType::FisheyeLensPolynomial, size, fov);
  desc.fisheye.polynomial = k;
  return desc;
}
CameraDesc fisheye() { return film(CameraType::FisheyeEquidistant, 1.2f); }
CameraDesc equisolid() { return film(CameraType::FisheyeEquisolid, 14.0f, 3.0f); }
CameraDesc blenders_polynomial() {
  return polynomial({-1.1735e-5f, -0.019988f, -3.3525e-6f, 3.0995e-6f, -2.6064e-8f}, 18.0f, 1.3f);
}
// Its angle grows out of its field of view and comes back into it at 19 mm.
CameraDesc returning_polynomial() {
  return polynomial({-0.05f, -0.25f, 0.01f, 0.0f, 0.0f}, 13.5f, 2.4f);
}
CameraDesc mirror_ball() { return film(CameraType::MirrorBall, 0.9f); }
CameraDesc cubemap_face() { return film(CameraType::EquiangularCubemapFace, 0.7f); }
CameraDesc cylinder() { return film(CameraType::CentralCylindrical, 1.6f); }

struct Kind {
  std::string name;
  CameraDesc desc;
};

const Kind kKinds[] = {
    {"perspective", shifted_camera()},
    {"perspective_lens", with_lens(shifted_camera(), 0.2f)},
    {"orthographic", orthographic()},
    {"orthographic_lens", with_lens(orthographic(), 0.2f)},
    {"sphere", whole_sphere()},
    {"sphere_lens", with_lens(whole_sphere(), 0.2f)},
    {"panorama", panorama(2.0f, -0.5f, -0.4f, 1.2f)},  // mirrored
    {"panorama_lens", with_lens(panorama(-0.5f, 0.8f, -0.4f, 1.2f), 0.1f)},
    {"two_turns", panorama(-5.0f, 2.5f * kPi, -0.4f, 1.2f)},
    {"fisheye", fisheye()},
    {"fisheye_lens", with_lens(fisheye(), 0.1f)},
    {"equisolid", equisolid()},
    {"equisolid_lens", with_lens(equisolid(), 0.1f)},
    {"polynomial", blenders_polynomial()},
    {"polynomial_lens", with_lens(blenders_polynomial(), 0.1f)},
    {"mirror_ball", mirror_ball()},
    {"mirror_ball_lens", with_lens(mirror_ball(), 0.1f)},
    {"cubemap_face", cubemap_face()},
    {"cubemap_face_lens", with_lens(cubemap_face(), 0.1f)},
    {"cylinder", cylinder()},
    {"cylinder_lens", with_lens(cylinder(), 0.1f)},
    // What they see they see several times.
    {"many_fisheye", film(CameraType::FisheyeEquidistant, 4.0f, 2.6f * kPi)},
    {"many_polynomial", returning_polynomial()},
    {"many_cylinder", film(CameraType::CentralCylindrical, 4.0f)},
};

std::ostream& operator<<(std::ostream& out, const Kind& kind) { return out << kind.name; }

class Cameras : public ::testing::TestWithParam<Kind> {
 protected:
  const std::unique_ptr<Camera> camera_ = make_camera(GetParam().desc, kWidth, kHeight);
};

TEST_P(Cameras, ConnectInvertsSampleRay) {
  Random random(6);
  int other = 0;
  for (int i = 0; i < 3000; ++i) {
    const vec2 raster = random.next_2d() * vec2(kWidth + 4, kHeight + 4) - 2.0f;
    const vec2 u = random.next_2d();
    const CameraRay ray = camera_->sample_ray(raster, u);
    if (ray.blind()) {
      continue;
    }
    const vec3 p = ray.ray.origin + random.in(0.01f, 0.99f) * ray.ray.t_max * ray.ray.direction;
    const auto c = camera_->connect(p, u, 2.001f);
    ASSERT_TRUE(c);
    // Where a point is seen at several positions, what counts is the ray at the one returned.
    const CameraRay back = camera_->sample_ray(c->raster, u);
    const bool same = glm::length(c->raster - raster) < 0.1f;
    if (c->pmf == 1.0f) {
      EXPECT_NEAR(c->raster.x, raster.x, 2e-3);
      EXPECT_NEAR(c->raster.y, raster.y, 2e-3);
    }
    other += !same;
    const vec3 to_p = p - back.ray.origin;
    const float along = dot(to_p, back.ray.direction);
    EXPECT_NEAR(glm::length(to_p - along * back.ray.direction), 0, 2e-4 * (1 + along));
    EXPECT_TRUE(along > 0 && along < back.ray.t_max);
    EXPECT_NEAR(glm::length(c->wo + back.ray.direction), 0, 1e-4);
    EXPECT_NEAR(glm::length(c->target - back.ray.origin), 0, 1e-3);
    EXPECT_NEAR(c->distance2 / length2(p - back.lens), 1, 1e-4);
    const float expected = camera_density(back.density, 1.0f, length2(p - back.lens));
    EXPECT_NEAR(c->importance() / expected, 1, 0.01);
  }
  const auto starts = [](const char* with) { return GetParam().name.find(with) == 0; };
  // Close to its axis, all that it shows, a lens may see a point from two sides.
  if (GetParam().name != "polynomial_lens") {
    EXPECT_EQ(other > 0, starts("sphere") || starts("two_turns") || starts("many"));
  }
}

// The rays of a film position and of its neighbours, for the same u_lens.
TEST_P(Cameras, DensityIsTheInverseOfAPixelsArea) {
  Random random(7);
  constexpr float h = 0.02f;
  int compared = 0, total = 0;
  for (int i = 0; i < 2000; ++i) {
    // Not in the last row at a pole, where the density changes fast; nor close to a focus, below.
    const vec2 raster = vec2(0, 1) + random.next_2d() * vec2(kWidth, kHeight - 2);
    const vec2 u = random.next_2d();
    const CameraRay ray = camera_->sample_ray(raster, u);
    const float t = random.in(0.6f, 10.0f);
    const auto blind = [&](float x, float y) {
      return camera_->sample_ray(raster + vec2(x, y), u).blind();
    };
    if (ray.blind() || blind(1, 0) || blind(-1, 0) || blind(0, 1) || blind(0, -1)) {  // the rim
      continue;
    }
    ++total;
    const vec3 d = ray.ray.direction, p = ray.lens + t * d;
    const auto across = [&](float x, float y) {  // on the plane through p across the ray
      const CameraRay r = camera_->sample_ray(raster + h * vec2(x, y), u);
      return r.lens + dot(p - r.lens, d) / dot(r.ray.direction, d) * r.ray.direction;
    };
    const vec3 dx = across(1, 0) - across(-1, 0), dy = across(0, 1) - across(0, -1);
    const float area = glm::length(cross(dx, dy)) / (4 * h * h);
    const float expected = camera_density(ray.density, 1.0f, t * t);
    if (expected * area > 0 && area > 1e-4f) {
      ++compared;
      EXPECT_NEAR(expected * area, 1, 0.03) << raster.x << " " << raster.y << " t " << t;
    }
  }
  EXPECT_GT(total, 200);
  EXPECT_GT(compared, 0.9 * total);
}

// One film position per pixel: over a sphere around the camera, the density integrates to the
// number of pixels that see anything, for any lens point.
TEST_P(Cameras, DensityIntegratesToThePixels) {
  const CameraDesc& desc = GetParam().desc;
  const vec3 center(desc.transform[3]);
  constexpr float kRadius = 6.0f;
  constexpr int kCells = 700;
  constexpr int kGrid = 20;  // per pixel
  int seeing = 0;
  for (int x = 0; x < kWidth * kGrid; ++x) {
    for (int y = 0; y < kHeight * kGrid; ++y) {
      seeing += !camera_->sample_ray((vec2(x, y) + 0.5f) / float{kGrid}, vec2(0.5f)).blind();
    }
  }
  const double pixels = seeing / double{kGrid * kGrid};
  for (const vec2 u : {vec2(0.5f), vec2(0.13f, 0.87f)}) {
    double sum = 0;
    Random random(8);
    for (int i = 0; i < kCells; ++i) {
      const float z = -1 + 2 * (i + 0.5f) / kCells, r = std::sqrt(1 - z * z);
      for (int j = 0; j < kCells; ++j) {
        const float phi = 2 * kPi * (j + 0.5f) / kCells;
        const vec3 n(r * std::cos(phi), r * std::sin(phi), z);
        // The low bits of u choose among film positions and move the lens point by next to nothing;
        // without a lens all of them choose.
        const float bits = desc.aperture_radius > 0.0f ? 1.0f / 65536.0f : 1.0f;
        const vec2 u_chosen(bits < 1.0f ? u.x + bits * random.next() : random.next(), u.y);
        if (const auto c = camera_->connect(center + kRadius * n, u_chosen, 0.0f)) {
          sum += std::abs(dot(c->wo, n)) * c->importance() / c->pmf;
        }
      }
    }
    EXPECT_NEAR(sum * 4 * kPi * sqr(kRadius / kCells) / pixels, 1, 0.005);
  }
}

TEST_P(Cameras, ClipsAtBothEnds) {
  Random random(9);
  for (int i = 0; i < 200; ++i) {
    const vec2 raster = random.next_2d() * vec2(kWidth, kHeight), u = random.next_2d();
    const CameraRay ray = camera_->sample_ray(raster, u);
    if (ray.blind()) {
      continue;
    }
    const auto seen = [&](float t) {
      return camera_->connect(ray.ray.origin + t * ray.ray.direction, u, 1e-2f).has_value();
    };
    EXPECT_TRUE(seen(1e-3f));
    EXPECT_FALSE(seen(-1e-3f));
    EXPECT_TRUE(seen(ray.ray.t_max - 2e-3f));
    EXPECT_FALSE(seen(ray.ray.t_max + 2e-3f));
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, Cameras, ::testing::ValuesIn(kKinds),
                         [](const auto& info) { return info.param.name; });

TEST(Camera, ClipsAndCrops) {
  const CameraDesc desc = shifted_camera();
  const auto camera = make_camera(desc, kWidth, kHeight);
  const CameraRay ray = camera->sample_ray(vec2(3, 4), vec2(0.5f));
  const vec3 axis = -normalize(vec3(desc.transform[2]));
  const vec3 d = ray.ray.direction / dot(ray.ray.direction, axis);  // per unit of depth
  EXPECT_FALSE(camera->connect(ray.lens + 0.499f * d, vec2(0.5f), 0));
  EXPECT_TRUE(camera->connect(ray.lens + 0.501f * d, vec2(0.5f), 0));
  EXPECT_TRUE(camera->connect(ray.lens + 19.99f * d, vec2(0.5f), 0));
  EXPECT_FALSE(camera->connect(ray.lens + 20.01f * d, vec2(0.5f), 0));
  EXPECT_FALSE(camera->connect(ray.lens - 5.0f * d, vec2(0.5f), 0));  // behind
  const CameraRay out = camera->sample_ray(vec2(-1.5f, 4), vec2(0.5f));
  EXPECT_FALSE(camera->connect(out.ray.origin + out.ray.direction, vec2(0.5f), 1.0f));
  EXPECT_TRUE(camera->connect(out.ray.origin + out.ray.direction, vec2(0.5f), 2.0f));
}

TEST(Camera, LensesFocusWhereTheySay) {
  Random random(10);
  for (const CameraDesc& desc : {with_lens(shifted_camera(), 0.2f), with_lens(orthographic(), 0.2f),
                                 with_lens(whole_sphere(), 0.2f), with_lens(fisheye(), 0.2f),
                                 with_lens(mirror_ball(), 0.2f), with_lens(cylinder(), 0.2f)}) {
    const auto camera = make_camera(desc, kWidth, kHeight);
    CameraDesc sharp = desc;
    sharp.aperture_radius = 0.0f;
    const auto pinhole = make_camera(sharp, kWidth, kHeight);
    for (int i = 0; i < 300; ++i) {
      const vec2 raster = random.next_2d() * vec2(kWidth, kHeight);
      const Ray chief = pinhole->sample_ray(raster, vec2(0.5f)).ray;
      if (chief.t_max < 0.0f) {
        continue;
      }
      const float slant = desc.type == CameraType::Perspective
                              ? 1 / dot(chief.direction, -normalize(vec3(desc.transform[2])))
                              : 1.0f;
      const vec3 focus = pinhole->sample_ray(raster, vec2(0.5f)).lens +
                         desc.focus_distance * slant * chief.direction;
      const CameraRay ray = camera->sample_ray(raster, random.next_2d());
      const vec3 to_focus = focus - ray.lens;
      EXPECT_NEAR(glm::length(cross(to_focus, ray.ray.direction)), 0, 2e-5);
    }
  }
}

// A fisheye of 120 degrees in a frame that shows 240 across, 20 pixels of its film to 60 degrees.
TEST(Camera, FisheyesSeeNothingOutsideTheirField) {
  CameraDesc desc = film(CameraType::FisheyeEquidistant, 1.0f, kPi * 2 / 3);
  desc.left = -kPi * 2 / 3, desc.right = kPi * 2 / 3;
  desc.bottom = -kPi / 2, desc.top = kPi / 2;
  desc.transform = mat4(1.0f);
  for (const float radius : {0.0f, 0.1f}) {
    const auto camera = make_camera(with_lens(desc, radius), kWidth, kHeight);
    const vec2 u(0.3f, 0.6f);
    const auto sees = [&](vec2 raster) { return !camera->sample_ray(raster, u).blind(); };
    EXPECT_TRUE(sees({20, 15}) && sees({29.9f, 15}) && sees({20, 5.1f}) && sees({27, 22}));
    EXPECT_FALSE(sees({30.1f, 15}) || sees({20, 4.9f}) || sees({27.2f, 22.2f}) || sees({-1, 15}));
  }
  const auto camera = make_camera(desc, kWidth, kHeight);
  const auto connects = [&](float angle) {
    const vec3 p = 2.0f * vec3(0, std::sin(angle), -std::cos(angle));
    return camera->connect(p, vec2(0.5f), kInfinity).has_value();
  };
  EXPECT_TRUE(connects(0.01f) && connects(-1.0f) && connects(1.04f));
  EXPECT_FALSE(connects(1.05f) || connects(-2.0f) || connects(3.0f));
}

// Positions over the seam and over the poles are found as often as not.
TEST(Camera, APanoramaSeesAroundItsBorders) {
  const auto camera = make_camera(whole_sphere(), kWidth, kHeight);
  const auto positions = [&](vec2 raster, float margin) {
    const CameraRay ray = camera->sample_ray(raster, vec2(0.5f));
    std::set<std::pair<int, int>> found;
    Random random(11);
    float pmf = 0.0f;
    for (int i = 0; i < 100; ++i) {
      const auto c = camera->connect(ray.ray.origin + ray.ray.direction, random.next_2d(), margin);
      if (c) {
        found.insert({std::lround(4 * c->raster.x), std::lround(4 * c->raster.y)});
        pmf = c->pmf;
      }
    }
    EXPECT_NEAR(pmf, 1.0f / static_cast<float>(found.size()), 1e-6f);
    return found;
  };
  using Set = std::set<std::pair<int, int>>;
  EXPECT_EQ(positions({20.25f, 15.5f}, 2), (Set{{81, 62}}));
  EXPECT_EQ(positions({0.5f, 15.5f}, 2), (Set{{2, 62}, {162, 62}}));
  EXPECT_EQ(positions({0.5f, 15.5f}, 0), (Set{{2, 62}}));
  EXPECT_EQ(positions({10.5f, 29.5f}, 2), (Set{{42, 118}, {122, 122}}));
  EXPECT_EQ(positions({10.5f, 0.25f}, 2), (Set{{42, 1}, {122, -1}}));
  EXPECT_EQ(positions({0.5f, 29.5f}, 2), (Set{{2, 118}, {162, 118}, {82, 122}}));
}

TEST(Aperture, IsUniformOnItsPolygon) {
  for (const int blades : {0, 3, 5, 6, 16}) {
    CameraDesc desc;
    desc.aperture_radius = 0.3f;
    desc.aperture_blades = blades;
    desc.aperture_rotation = 0.4f;
    desc.aperture_ratio = 2.0f;
    const Aperture aperture(desc);
    const auto inside = [&](vec2 p) {  // half planes, after undoing size and ratio
      const vec2 q = p / 0.3f * vec2(2, 1);
      for (int i = 0; i < blades; ++i) {
        const float angle = 0.4f + 2 * kPi * i / blades;
        if (q.x * std::cos(angle) + q.y * std::sin(angle) > std::cos(kPi / blades)) {
          return false;
        }
      }
      return blades > 0 || dot(q, q) <= 1.0f;
    };
    constexpr int kCells = 20, kGrid = 20, kSamples = 200000;
    std::vector<double> expected(kCells * kCells), counts(kCells * kCells);
    const auto cell = [](vec2 p) {
      const auto index = [](float x, float half) {
        return std::clamp(static_cast<int>((x / half * 0.5f + 0.5f) * kCells), 0, kCells - 1);
      };
      return index(p.y, 0.3f) * kCells + index(p.x, 0.15f);
    };
    double total = 0;
    for (int i = 0; i < kCells * kGrid; ++i) {
      for (int j = 0; j < kCells * kGrid; ++j) {
        const vec2 p((2 * (i + 0.5f) / (kCells * kGrid) - 1) * 0.15f,
                     (2 * (j + 0.5f) / (kCells * kGrid) - 1) * 0.3f);
        expected[cell(p)] += inside(p);
        total += inside(p);
      }
    }
    for (double& e : expected) {
      e *= kSamples / total;
    }
    Random random(12);
    int outside = 0;
    for (int i = 0; i < kSamples; ++i) {
      const vec2 p = aperture.sample(random.next_2d());
      counts[cell(p)] += 1;
      outside += !inside(0.99999f * p);
    }
    EXPECT_EQ(outside, 0);
    EXPECT_LT(chi_square_z(counts, expected), 4.0) << blades << " blades";
  }
}

}  // namespace
}  // namespace janus::test
