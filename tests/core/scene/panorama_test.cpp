// SPDX-License-Identifier: GPL-3.0-or-later
//
// Panoramas by themselves: known places, fisheyes that fold, and polynomials.
#include "janus/scene/panorama.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "janus/math/polynomial.h"

namespace janus::test {
namespace {

void expect_looks(CameraType type, const FisheyeDesc& fisheye, dvec2 place, dvec3 direction) {
  const auto view = Panorama(type, fisheye).look(place);
  ASSERT_TRUE(view);
  EXPECT_NEAR(glm::distance(view->direction, glm::normalize(direction)), 0.0, 1e-6);
  const dvec2 window = window_place(type, fisheye, 3.0 * direction);
  EXPECT_NEAR(glm::distance(window, place), 0.0, 1e-4);
}

TEST(Panorama, KnownPlaces) {
  const double quarter = 0.25 * kPi, half = 0.5 * kPi, root = std::sqrt(0.5);
  const FisheyeDesc wide{2.0f * kPi, 10.0f, {0.0f, -0.1f, 0.0f, 0.0f, 0.0f}};
  expect_looks(CameraType::FisheyeEquidistant, wide, {half, 0}, {1, 0, 0});
  expect_looks(CameraType::FisheyeEquidistant, wide, {0, -quarter}, {0, -1, -1});
  expect_looks(CameraType::FisheyeEquisolid, wide, {0, 20.0 * root}, {0, 1, 0});
  expect_looks(CameraType::FisheyeEquisolid, wide, {-10, 0}, {-std::sqrt(3.0), 0, -1});
  expect_looks(CameraType::FisheyeLensPolynomial, wide, {0, 10.0 * half}, {0, 1, 0});
  expect_looks(CameraType::MirrorBall, {}, {root, 0}, {1, 0, 0});
  expect_looks(CameraType::MirrorBall, {}, {0, -root}, {0, -1, 0});
  expect_looks(CameraType::EquiangularCubemapFace, {}, {quarter, -quarter}, {1, -1, -1});
  expect_looks(CameraType::EquiangularCubemapFace, {}, {quarter / 3, 0},
               {std::tan(quarter / 3), 0, -1});
  expect_looks(CameraType::CentralCylindrical, {}, {half, -2}, {1, -2, 0});
  expect_looks(CameraType::Equirectangular, {}, {-half, quarter}, {-1, 1, 0});
}

TEST(Panorama, EndsOfTheField) {
  const auto sees = [](CameraType type, float fov, double radius) {
    return Panorama(type, {fov, 10.0f, {-0.1f, -0.1f, 0.0f, 0.0f, 0.0f}})
        .look({0.6 * radius, -0.8 * radius})
        .has_value();
  };
  EXPECT_TRUE(sees(CameraType::FisheyeEquidistant, 2.0f, 0.999));
  EXPECT_FALSE(sees(CameraType::FisheyeEquidistant, 2.0f, 1.001));
  EXPECT_TRUE(sees(CameraType::FisheyeEquisolid, 2.0f, 19.99 * std::sin(0.5)));
  EXPECT_FALSE(sees(CameraType::FisheyeEquisolid, 2.0f, 20.01 * std::sin(0.5)));
  EXPECT_TRUE(sees(CameraType::FisheyeLensPolynomial, 2.0f, 8.99));
  EXPECT_FALSE(sees(CameraType::FisheyeLensPolynomial, 2.0f, 9.01));
  EXPECT_TRUE(sees(CameraType::MirrorBall, 2.0f, 0.999));
  EXPECT_FALSE(sees(CameraType::MirrorBall, 2.0f, 1.001));
}

// All places that see a direction are found, and they alone.
TEST(Panorama, FindsWhatFisheyesSeeTwice) {
  const auto radii = [](CameraType type, const FisheyeDesc& fisheye, double angle) {
    Panorama::Places places;
    Panorama(type, fisheye).find({std::sin(angle), 0.0, -std::cos(angle)}, places);
    std::vector<double> found;
    for (size_t i = 0; i < places.count; ++i) {
      const auto view = Panorama(type, fisheye).look(places.at[i]);
      EXPECT_TRUE(view);
      EXPECT_NEAR(view->direction.x, std::sin(angle), 1e-9);
      found.push_back(places.at[i].x);
    }
    std::ranges::sort(found);
    return found;
  };
  const auto near = [](const std::vector<double>& a, const std::vector<double>& b) {
    return a.size() == b.size() &&
           std::ranges::equal(a, b, [](double x, double y) { return std::abs(x - y) < 1e-6; });
  };
  const FisheyeDesc turns{3.0f * kPi};
  const double turn = 2.0 * kPi;
  EXPECT_TRUE(near(radii(CameraType::FisheyeEquidistant, turns, 1.0), {1.0}));
  EXPECT_TRUE(near(radii(CameraType::FisheyeEquidistant, turns, 2.0), {2.0 - turn, 2.0}));
  const FisheyeDesc five{10.0f * kPi};
  EXPECT_EQ(radii(CameraType::FisheyeEquidistant, five, 1.0).size(), 5u);
  // The angle is r (3 - r): up to 2.25 at 1.5, down to 0 at 3, and on the other side behind it.
  const FisheyeDesc folded{4.0f, 10.0f, {0.0f, -3.0f, 1.0f, 0.0f, 0.0f}};
  EXPECT_TRUE(near(radii(CameraType::FisheyeLensPolynomial, folded, 1.25),
                   {-(1.5 + std::sqrt(3.5)), 0.5, 2.5}));
  const FisheyeDesc unseen{1.0f, 10.0f, {-3.0f, -0.1f, 0.0f, 0.0f, 0.0f}};
  EXPECT_TRUE(radii(CameraType::FisheyeLensPolynomial, unseen, 0.2).empty());
}

TEST(Panorama, RefusesWhatIsNoFisheye) {
  EXPECT_TRUE(usable_fisheye({}));
  EXPECT_FALSE(usable_fisheye({0.0f}));
  EXPECT_FALSE(usable_fisheye({11.0f * kPi}));
  EXPECT_FALSE(usable_fisheye({NAN}));
  EXPECT_FALSE(usable_fisheye({1.0f, 0.0f}));
  EXPECT_FALSE(usable_fisheye({1.0f, 10.0f, {0.1f, 0.0f, 0.0f, 0.0f, 0.0f}}));
  EXPECT_FALSE(usable_fisheye({1.0f, 10.0f, {0.1f, NAN, 0.0f, 0.0f, 0.0f}}));
}

TEST(Polynomial, FindsAllRoots) {
  const auto expect_roots = [](std::vector<double> c, std::vector<double> expected) {
    const auto found = roots(c, -2.0, 5.0);
    ASSERT_EQ(found.size(), expected.size());
    for (size_t i = 0; i < found.size(); ++i) {
      EXPECT_NEAR(found[i], expected[i], 1e-12);
    }
  };
  expect_roots({-6, 11, -6, 1}, {1, 2, 3});
  expect_roots({24, -50, 35, -10, 1}, {1, 2, 3, 4});
  expect_roots({0, 1}, {0});
  expect_roots({-2, 0, 1, 0, 0}, {-std::sqrt(2.0), std::sqrt(2.0)});
  expect_roots({1, 0, 1}, {});
  expect_roots({-6, 1}, {});
  expect_roots({3}, {});
  expect_roots({}, {});
}

}  // namespace
}  // namespace janus::test
