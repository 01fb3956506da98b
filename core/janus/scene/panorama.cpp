// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/scene/panorama.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "janus/math/polynomial.h"

namespace janus {

namespace {

constexpr double kPiDouble = 3.14159265358979323846;
constexpr double kTurn = 2.0 * kPiDouble;

double longitude(dvec3 d) { return std::atan2(d.x, -d.z); }

// A direction as its angle from the view axis and the way from there across the axis.
struct Polar {
  explicit Polar(dvec3 d) {
    const double across = std::hypot(d.x, d.y);
    angle = std::atan2(across, -d.z);
    way = across > 0.0 ? dvec2(d.x, d.y) / across : dvec2(0.0);
  }
  double angle;
  dvec2 way;  // unit; 0 on the axis
};

dvec3 from_axis(double angle, dvec2 place, double radius) {
  const dvec2 way = radius > 0.0 ? place / radius : dvec2(1.0, 0.0);
  return dvec3(std::sin(angle) * way, -std::cos(angle));
}

// A bound of the absolute values of the roots (Cauchy).
double largest_root(std::span<const double> c) {
  size_t degree = c.size() - 1;
  while (degree > 0 && c[degree] == 0.0) {
    --degree;
  }
  double most = 0.0;
  for (size_t i = 0; i < degree; ++i) {
    most = std::max(most, std::abs(c[i] / c[degree]));
  }
  return 1.0 + most;
}

}  // namespace

bool usable_fisheye(const FisheyeDesc& fisheye) {
  const auto& k = fisheye.polynomial;
  return fisheye.fov > 0.0f && fisheye.fov < 10.001f * kPi && fisheye.lens > 0.0f &&
         std::isfinite(fisheye.lens) &&
         std::ranges::all_of(k, [](float x) { return std::isfinite(x); }) &&
         std::any_of(k.begin() + 1, k.end(), [](float x) { return x != 0.0f; });
}

Panorama::Panorama(CameraType type, const FisheyeDesc& fisheye)
    : type_(type), half_fov_(0.5 * fisheye.fov) {
  if (type == CameraType::FisheyeEquisolid) {
    lens_ = fisheye.lens;
    rim_ = 2.0 * lens_ * std::sin(0.5 * half_fov_);
  } else if (type == CameraType::MirrorBall) {
    lens_axes_ = glm::transpose(
        glm::dmat3(dvec3(0.0, 1.0, 0.0), dvec3(0.0, 0.0, -1.0), dvec3(-1.0, 0.0, 0.0)));
  } else if (type == CameraType::FisheyeEquidistant) {
    polynomial_[1] = 1.0;
    pieces_.push_back({0.0, half_fov_, 0.0, half_fov_});
  } else if (type == CameraType::FisheyeLensPolynomial) {
    std::ranges::transform(fisheye.polynomial, polynomial_.begin(), std::negate<double>());
    // Behind the last place where it comes to the rim it never comes back.
    std::vector<double> stops = {0.0};
    double last = 0.0;
    for (const double rim : {-half_fov_, half_fov_}) {
      auto beyond = polynomial_;
      beyond[0] -= rim;
      for (const double radius : roots(beyond, 0.0, largest_root(beyond))) {
        last = std::max(last, radius);
      }
    }
    std::vector<double> slope;
    for (size_t i = 1; i < polynomial_.size(); ++i) {
      slope.push_back(static_cast<double>(i) * polynomial_[i]);
    }
    for (const double radius : roots(slope, 0.0, last)) {
      stops.push_back(radius);
    }
    stops.push_back(last);
    for (size_t i = 0; i + 1 < stops.size(); ++i) {
      const double a = evaluate(polynomial_, stops[i]).value;
      const double b = evaluate(polynomial_, stops[i + 1]).value;
      const double least = std::max(std::min(a, b), -half_fov_);
      const double most = std::min(std::max(a, b), half_fov_);
      if (least < most) {
        pieces_.push_back({stops[i], stops[i + 1], least, most});
      }
    }
  }
}

std::optional<Panorama::View> Panorama::look(dvec2 place) const {
  switch (type_) {
    case CameraType::EquiangularCubemapFace: {
      // By its height and width on the plane at distance 1, a direction's solid angle is 1 / r^3.
      const double x = std::tan(place.x), y = std::tan(place.y);
      const double r2 = 1.0 + x * x + y * y, r = std::sqrt(r2);
      return View{dvec3(x, y, -1.0) / r, (1.0 + x * x) * (1.0 + y * y) / (r2 * r)};
    }
    case CameraType::CentralCylindrical: {
      const double r2 = 1.0 + place.y * place.y, r = std::sqrt(r2);
      return View{dvec3(std::sin(place.x), place.y, -std::cos(place.x)) / r, 1.0 / (r2 * r)};
    }
    case CameraType::FisheyeEquisolid:
    case CameraType::MirrorBall:
      return look_equisolid(place);
    case CameraType::FisheyeEquidistant:
    case CameraType::FisheyeLensPolynomial:
      return look_polynomial(place);
    default: {
      const double c = std::cos(place.y);
      return View{dvec3(c * std::sin(place.x), std::sin(place.y), -c * std::cos(place.x)),
                  std::abs(c)};
    }
  }
}

std::optional<Panorama::View> Panorama::look_equisolid(dvec2 place) const {
  const double radius = glm::length(place);
  if (!(radius <= rim_)) {
    return std::nullopt;
  }
  const double angle = 2.0 * std::asin(std::min(radius / (2.0 * lens_), 1.0));
  return View{from_axis(angle, place, radius), 1.0 / (lens_ * lens_)};
}

std::optional<Panorama::View> Panorama::look_polynomial(dvec2 place) const {
  const double radius = glm::length(place);
  const PolynomialValue angle = evaluate(polynomial_, radius);
  if (!(std::abs(angle.value) <= half_fov_)) {
    return std::nullopt;
  }
  // A ring of width dr has the solid angle 2 pi sin(angle) d(angle). In the middle it is a disk.
  const double stretch = radius > 0.0 ? std::sin(angle.value) / radius : angle.slope;
  return View{from_axis(angle.value, place, radius), std::abs(stretch * angle.slope)};
}

void Panorama::find(dvec3 d, Places& places) const {
  switch (type_) {
    case CameraType::EquiangularCubemapFace:
      if (d.z < 0.0) {
        places.add({longitude(d), std::atan2(d.y, -d.z)});
      }
      break;
    case CameraType::CentralCylindrical: {
      const double across = std::hypot(d.x, d.z);
      if (across > 0.0) {
        places.add({longitude(d), d.y / across});
      }
      break;
    }
    case CameraType::FisheyeEquisolid:
    case CameraType::MirrorBall:
      find_equisolid(d, places);
      break;
    case CameraType::FisheyeEquidistant:
    case CameraType::FisheyeLensPolynomial:
      find_polynomial(d, places);
      break;
    default: {  // and from over the pole
      const double latitude = std::atan2(d.y, std::hypot(d.x, d.z));
      places.add({longitude(d), latitude});
      places.add({longitude(d) + kPiDouble, kPiDouble - latitude});
    }
  }
}

void Panorama::find_equisolid(dvec3 d, Places& places) const {
  const Polar to(d);
  const double radius = 2.0 * lens_ * std::sin(0.5 * to.angle);
  if (radius <= rim_) {
    places.add(radius * to.way);
  }
}

void Panorama::find_polynomial(dvec3 d, Places& places) const {
  const Polar to(d);
  for (const Piece& piece : pieces_) {
    // Film angles have the same direction after a turn, and from the other side of the axis.
    for (const double side : {1.0, -1.0}) {
      if (side < 0.0 && to.angle == 0.0) {
        continue;
      }
      const double first = std::ceil((piece.least - side * to.angle) / kTurn);
      for (double k = first; side * to.angle + k * kTurn <= piece.most; k += 1.0) {
        const double angle = side * to.angle + k * kTurn;
        places.add(side * root_between(polynomial_, angle, piece.from, piece.to) * to.way);
      }
    }
  }
}

dvec2 Panorama::period() const {
  switch (type_) {
    case CameraType::Equirectangular:
      return {kTurn, kTurn};
    case CameraType::EquiangularCubemapFace:
      return {kPiDouble, kPiDouble};
    case CameraType::CentralCylindrical:
      return {kTurn, 0.0};
    default:
      return {0.0, 0.0};
  }
}

dvec2 window_place(CameraType type, const FisheyeDesc& fisheye, dvec3 d) {
  const Polar to(d);
  switch (type) {
    case CameraType::FisheyeEquidistant:
      return to.angle * to.way;
    case CameraType::FisheyeEquisolid:
      return 2.0 * fisheye.lens * std::sin(0.5 * to.angle) * to.way;
    case CameraType::MirrorBall:
      return std::sin(0.5 * to.angle) * to.way;
    case CameraType::FisheyeLensPolynomial: {
      // Cycles takes the root at which Newton's method arrives from that of the first two terms.
      std::array<double, 5> c{};
      std::ranges::copy(fisheye.polynomial, c.begin());
      double radius = (-to.angle - c[0]) / c[1];
      for (int i = 0; i < 20; ++i) {
        const PolynomialValue at = evaluate(c, radius);
        const double step = (-to.angle - at.value) / at.slope;
        radius += step;
        if (!(std::abs(step) >= 1e-6)) {
          break;
        }
      }
      return std::isfinite(radius) ? radius * to.way : dvec2(0.0);
    }
    case CameraType::EquiangularCubemapFace:
      return {longitude(d), std::atan2(d.y, -d.z)};
    case CameraType::CentralCylindrical: {
      const double across = std::hypot(d.x, d.z);
      return {longitude(d), across > 0.0 ? d.y / across : 0.0};
    }
    default:
      return {longitude(d), std::atan2(d.y, std::hypot(d.x, d.z))};
  }
}

// Cycles looks from pixel to pixel: towards the border of its film a panorama may have others.
float pixel_scale(CameraType type, const FisheyeDesc& fisheye) {
  switch (type) {
    case CameraType::FisheyeEquisolid:
      return 1.0f / fisheye.lens;
    case CameraType::FisheyeLensPolynomial:
      return fisheye.polynomial[1] != 0.0f ? std::abs(fisheye.polynomial[1]) : 1.0f;
    case CameraType::MirrorBall:
      return 2.0f;
    default:
      return 1.0f;
  }
}

}  // namespace janus
