// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>

#include "janus/camera/types.h"

namespace janus {

namespace {

using dvec2 = glm::dvec2;
using dvec3 = glm::dvec3;

constexpr double kPiDouble = 3.14159265358979323846;
constexpr dvec3 kForward(0.0, 0.0, -1.0);

// Longitude and latitude, as Cycles has it. Film positions outside the frame go on around the
// sphere: over the seam to the other border, and over a pole down the other side. So the filter of
// a border pixel sees what lies there, and a point near a seam or a pole is seen at several film
// positions. connect() counts them and chooses one.
//
// Cycles puts a lens in the plane across each ray, its x axis towards the point straight ahead
// (-z). A lens point (a, b) of a ray D through the centre is P = a U + b V, where U is the
// derivative of D towards that point and V = D x U, and the ray goes on from P to f D. So P turns
// with D, and neighbouring rays of one (a, b) do not meet in a point. With L^2 = f^2 + a^2 + b^2,
// the point at distance t from P is
//   p = A D + B (a U + b V),  A = t f / L,  B = 1 - t / L,
// and its derivatives by D along U and V span, across the ray, the area
//   |A - B a cot(alpha)| |t - (a^2 + b^2) / L|
// per solid angle of D; alpha is the angle between D and straight ahead.
class EquirectangularCamera final : public Camera {
 public:
  EquirectangularCamera(const CameraDesc& desc, int width, int height)
      : pose_(desc),
        window_(desc, width, height),
        aperture_(desc),
        focus_(std::max(desc.focus_distance, kMinFocus)),
        near_(desc.clip_start),
        far_(desc.clip_end) {}

  CameraRay sample_ray(vec2 raster, vec2 u_lens) const override {
    const vec2 angles = window_.from_raster(raster);
    const vec2 lon = cos_sin(angles.x), lat = cos_sin(angles.y);
    const dvec3 chief(lat.x * lon.y, lat.y, -lat.x * lon.x);
    return world_ray(chief, std::abs(lat.x), lens(u_lens));
  }

  std::optional<CameraConnection> connect(vec3 p, vec2 u_lens, float margin) const override {
    const dvec3 local(pose_.to_local(p));
    const Lens lens = this->lens(u_lens);
    const double distance = lens.distance(glm::dot(local, local));
    if (!(distance > lens.near && distance < far_)) {
      return std::nullopt;
    }
    std::array<dvec3, 2> chiefs;
    const int count = find_chiefs(local, lens, distance, chiefs);
    int total = 0;
    for (int i = 0; i < count; ++i) {
      for_each_position(chiefs[i], margin, [&](vec2) { ++total; });
    }
    if (total == 0) {
      return std::nullopt;
    }
    const Choice choice = choose(u_lens, static_cast<uint32_t>(total));
    uint32_t skip = choice.index;
    vec2 raster(0.0f);
    dvec3 chief(0.0);
    for (int i = 0; i < count; ++i) {
      for_each_position(chiefs[i], margin, [&](vec2 position) {
        if (skip-- == 0) {
          raster = position;
          chief = chiefs[i];
        }
      });
    }
    const auto cos_latitude = static_cast<float>(std::hypot(chief.x, chief.z));
    const CameraRay ray = world_ray(chief, cos_latitude, lens);
    return CameraConnection{raster,         -ray.ray.direction,
                            ray.ray.origin, static_cast<float>(distance * distance),
                            ray.density,    choice.pmf};
  }

 private:
  struct Lens {
    double a = 0.0, b = 0.0;  // the lens point
    double focus = 1.0, L = 1.0;
    double r2 = 0.0;  // a^2 + b^2
    float near = 0.0f;

    // From the lens point to a point with this squared distance from the camera; NaN where no ray
    // comes. Rays pass the camera at the distance r2 / L; what lies before twice that is
    // clipped, as it would be passed on the way there and back.
    double distance(double squared) const {
      const double closest = r2 / L;
      return closest + std::sqrt(closest * closest + squared - r2);
    }
  };

  // u.x has 24 bits. With a lens, the leading 16 place the lens point, and the others are left for
  // the choice among film positions: both are the same function of u in sample_ray and connect.
  static constexpr float kLensSteps = 65536.0f;

  struct Choice {
    uint32_t index;
    float pmf;
  };

  Choice choose(vec2 u, uint32_t count) const {
    const uint32_t levels = aperture_.pinhole() ? 1u << 24 : 256u;
    const float step = u.x * kLensSteps;
    const float rest = aperture_.pinhole() ? u.x : step - std::floor(step);
    const auto level = static_cast<uint64_t>(rest * static_cast<float>(levels));
    const auto first = [&](uint64_t index) { return (index * levels + count - 1) / count; };
    const auto index = static_cast<uint32_t>(level * count / levels);
    return {index, static_cast<float>(first(index + 1) - first(index)) / levels};
  }

  Lens lens(vec2 u) const {
    Lens lens;
    lens.near = near_;
    if (!aperture_.pinhole()) {
      u.x = (std::floor(u.x * kLensSteps) + 0.5f) / kLensSteps;
      const vec2 p = aperture_.sample(u);
      lens.a = p.x;
      lens.b = p.y;
      lens.focus = focus_;
      lens.r2 = lens.a * lens.a + lens.b * lens.b;
      lens.L = std::sqrt(lens.focus * lens.focus + lens.r2);
      lens.near = std::max(near_, static_cast<float>(2.0 * lens.r2 / lens.L));
    }
    return lens;
  }

  CameraRay world_ray(dvec3 chief, float cos_latitude, const Lens& lens) const {
    const float solid_angle = window_.pixel_area() * cos_latitude;
    dvec3 point(0.0), direction = chief;
    PixelDensity density{1.0f / solid_angle, true};
    if (lens.r2 > 0.0) {
      const double cos_alpha = glm::dot(chief, kForward);
      dvec3 u = kForward - cos_alpha * chief;
      const double sin_alpha = glm::length(u);
      u = sin_alpha > 0.0 ? u / sin_alpha : dvec3(1.0, 0.0, 0.0);
      point = lens.a * u + lens.b * glm::cross(chief, u);
      direction = (lens.focus * chief - point) / lens.L;
      const double cot = cos_alpha / sin_alpha;
      const double slope = (lens.focus + lens.a * cot) / lens.L;
      density.value /= static_cast<float>(std::abs(slope));
      density.foci = vec2(lens.r2 / lens.L, lens.a * cot / slope);
    }
    const vec3 world_point = pose_.to_world(vec3(point));
    const vec3 world = pose_.rotation * normalize(vec3(direction));
    return {Ray{world_point + lens.near * world, world, std::max(0.0f, far_ - lens.near)},
            world_point, density};
  }

  // The rays through the centre whose rays from the lens point pass `p` at `distance`; none to
  // two, because lens points near the view axis turn faster than the rays.
  static int find_chiefs(dvec3 p, const Lens& lens, double distance, std::array<dvec3, 2>& chiefs) {
    if (lens.r2 == 0.0) {
      chiefs[0] = glm::normalize(p);
      return 1;
    }
    const double a = distance * lens.focus / lens.L, b = 1.0 - distance / lens.L;
    // Along the view axis: p . forward = A cos(alpha) + B a sin(alpha) = C cos(alpha - alpha_0).
    const double alpha_0 = std::atan2(b * lens.a, a);
    const double ratio = glm::dot(p, kForward) / std::hypot(b * lens.a, a);
    if (!(std::abs(ratio) <= 1.0)) {
      return 0;
    }
    const double delta = std::acos(ratio);
    int count = 0;
    for (const double alpha :
         {alpha_0 + delta, alpha_0 - delta, alpha_0 - delta + 2.0 * kPiDouble}) {
      if (!(alpha > 0.0 && alpha < kPiDouble) || count == 2) {
        continue;
      }
      // Across the axis, as complex numbers: p = e^(i beta) (A sin - B a cos + i B b).
      const double c = std::cos(alpha), s = std::sin(alpha);
      const double beta = std::atan2(p.y, p.x) - std::atan2(b * lens.b, a * s - b * lens.a * c);
      chiefs[count++] = dvec3(s * std::cos(beta), s * std::sin(beta), -c);
    }
    return count;
  }

  // All film positions that show a direction.
  template <class Visit>
  void for_each_position(dvec3 d, float margin, Visit&& visit) const {
    const double longitude = std::atan2(d.x, -d.z);
    const double latitude = std::atan2(d.y, std::hypot(d.x, d.z));
    const float turn = 2.0f * kPi / window_.pixel().x;  // pixels; negative in a mirrored frame
    const float width = window_.size().x;
    const auto visit_turns = [&](dvec2 angles) {
      const vec2 first = window_.to_raster(vec2(angles));
      if (!std::isfinite(margin)) {  // anywhere: the one closest to the middle of the frame
        visit(vec2(first.x + turn * std::round((0.5f * width - first.x) / turn), first.y));
        return;
      }
      if (!(first.y >= -margin && first.y <= window_.size().y + margin)) {
        return;
      }
      const float size = std::abs(turn);
      const float begin = std::ceil((-margin - first.x) / size);
      for (float k = begin; first.x + k * size <= width + margin; k += 1.0f) {
        visit(vec2(first.x + k * size, first.y));
      }
    };
    visit_turns({longitude, latitude});
    if (std::isfinite(margin)) {
      visit_turns({longitude + kPiDouble, kPiDouble - latitude});
      visit_turns({longitude + kPiDouble, -kPiDouble - latitude});
    }
  }

  Pose pose_;
  Window window_;
  Aperture aperture_;
  float focus_, near_, far_;
};

}  // namespace

std::unique_ptr<Camera> make_equirectangular(const CameraDesc& desc, int width, int height) {
  return std::make_unique<EquirectangularCamera>(desc, width, height);
}

}  // namespace janus
