// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>

#include "janus/camera/types.h"
#include "janus/scene/panorama.h"

namespace janus {

namespace {

constexpr double kPiDouble = 3.14159265358979323846;
constexpr dvec3 kForward(0.0, 0.0, -1.0);

// Every kind of panorama: Panorama says what a film position sees, and the lens is here.
//
// The film goes on outside the frame: around the sphere, say, over the seam to the other border,
// and over a pole down the other side. So the filter of a border pixel sees what lies there, and a
// point near a seam or a pole is seen at several film positions; so is what a fisheye sees twice.
// connect() counts them and chooses one. Outside its field of view a fisheye is blind.
//
// Cycles puts a lens in the plane across each ray, its x axis towards the point straight ahead, -z
// of Panorama::lens_axes(). A lens point (a, b) of a ray D through the centre is P = a U + b V,
// where U is the derivative of D towards that point and V = D x U, and the ray goes on from P to
// f D. So P turns with D, and neighbouring rays of one (a, b) do not meet in a point. With
// L^2 = f^2 + a^2 + b^2, the point at distance t from P is
//   p = A D + B (a U + b V),  A = t f / L,  B = 1 - t / L,
// and its derivatives by D along U and V span, across the ray, the area
//   |A - B a cot(alpha)| |t - (a^2 + b^2) / L|
// per solid angle of D; alpha is the angle between D and straight ahead.
class PanoramicCamera final : public Camera {
 public:
  PanoramicCamera(const CameraDesc& desc, int width, int height)
      : pose_(desc),
        window_(desc, width, height),
        map_(desc.type, desc.fisheye),
        aperture_(desc),
        focus_(std::max(desc.focus_distance, kMinFocus)),
        near_(desc.clip_start),
        far_(desc.clip_end) {}

  CameraRay sample_ray(vec2 raster, vec2 u_lens) const override {
    const auto view = map_.look(dvec2(window_.from_raster(raster)));
    return view ? world_ray(*view, lens(u_lens)) : CameraRay::nothing(pose_.center);
  }

  std::optional<CameraConnection> connect(vec3 p, vec2 u_lens, float margin) const override {
    const dvec3 local(pose_.to_local(p));
    const Lens lens = this->lens(u_lens);
    const double distance = lens.distance(glm::dot(local, local));
    if (!(distance > lens.near && distance < far_)) {
      return std::nullopt;
    }
    std::array<dvec3, 2> chiefs;
    Panorama::Places places;
    const int count = find_chiefs(local, lens, distance, chiefs);
    for (int i = 0; i < count; ++i) {
      map_.find(chiefs[i], places);
    }
    int total = 0;
    for_each_position(places, margin, [&](dvec2, vec2) { ++total; });
    if (total == 0) {
      return std::nullopt;
    }
    const Choice choice = choose(u_lens, static_cast<uint32_t>(total));
    uint32_t skip = choice.index;
    vec2 raster(0.0f);
    std::optional<Panorama::View> view;
    for_each_position(places, margin, [&](dvec2 place, vec2 position) {
      if (skip-- == 0) {
        raster = position;
        view = map_.look(place);
      }
    });
    if (!view) {  // by rounding at the rim
      return std::nullopt;
    }
    const CameraRay ray = world_ray(*view, lens);
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
      lens.b = map_.lens_mirrored() ? -p.y : p.y;
      lens.focus = focus_;
      lens.r2 = lens.a * lens.a + lens.b * lens.b;
      lens.L = std::sqrt(lens.focus * lens.focus + lens.r2);
      lens.near = std::max(near_, static_cast<float>(2.0 * lens.r2 / lens.L));
    }
    return lens;
  }

  CameraRay world_ray(const Panorama::View& view, const Lens& lens) const {
    const auto solid_angle = static_cast<float>(window_.pixel_area() * view.solid_angle);
    dvec3 point(0.0), direction = view.direction;
    PixelDensity density{1.0f / solid_angle, true};
    if (lens.r2 > 0.0) {
      const dvec3 chief = map_.lens_axes() * view.direction;
      const double cos_alpha = glm::dot(chief, kForward);
      dvec3 u = kForward - cos_alpha * chief;
      const double sin_alpha = glm::length(u);
      u = sin_alpha > 0.0 ? u / sin_alpha : dvec3(1.0, 0.0, 0.0);
      point = lens.a * u + lens.b * glm::cross(chief, u);
      direction = (lens.focus * chief - point) / lens.L * map_.lens_axes();
      point = point * map_.lens_axes();
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
  // two, because lens points near the axis of the lens turn faster than the rays.
  int find_chiefs(dvec3 p, const Lens& lens, double distance, std::array<dvec3, 2>& chiefs) const {
    if (lens.r2 == 0.0) {
      chiefs[0] = glm::normalize(p);
      return 1;
    }
    p = map_.lens_axes() * p;
    const double a = distance * lens.focus / lens.L, b = 1.0 - distance / lens.L;
    // Along the axis: p . forward = A cos(alpha) + B a sin(alpha) = C cos(alpha - alpha_0).
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
      chiefs[count++] = dvec3(s * std::cos(beta), s * std::sin(beta), -c) * map_.lens_axes();
    }
    return count;
  }

  // All film positions of places: visit(place, raster).
  template <class Visit>
  void for_each_position(const Panorama::Places& places, float margin, Visit&& visit) const {
    const vec2 turn = glm::abs(vec2(map_.period()) / window_.pixel());  // pixels
    for (size_t i = 0; i < places.count; ++i) {
      vec2 first = window_.to_raster(vec2(places.at[i]));
      if (!std::isfinite(
              margin)) {  // anywhere: once, as close to the middle of the frame as can be
        for (const int axis : {0, 1}) {
          first[axis] = nearest(first[axis], turn[axis], 0.5f * window_.size()[axis]);
        }
        visit(places.at[i], first);
        return;
      }
      const vec2 far = window_.size() + margin;
      for (float y = begin(first.y, turn.y, -margin); y <= far.y; y += turn.y) {
        for (float x = begin(first.x, turn.x, -margin); x <= far.x; x += turn.x) {
          visit(places.at[i], vec2(x, y));
          if (turn.x == 0.0f) {
            break;
          }
        }
        if (turn.y == 0.0f) {
          break;
        }
      }
    }
  }
  static float nearest(float x, float turn, float to) {
    return turn > 0.0f ? x + turn * std::round((to - x) / turn) : x;
  }
  // The first of x, x + turn, ... from `low` on; infinite if there is none.
  static float begin(float x, float turn, float low) {
    if (turn > 0.0f) {
      return x + turn * std::ceil((low - x) / turn);
    }
    return x >= low ? x : kInfinity;
  }

  Pose pose_;
  Window window_;
  Panorama map_;
  Aperture aperture_;
  float focus_, near_, far_;
};

}  // namespace

std::unique_ptr<Camera> make_panoramic(const CameraDesc& desc, int width, int height) {
  return std::make_unique<PanoramicCamera>(desc, width, height);
}

}  // namespace janus
