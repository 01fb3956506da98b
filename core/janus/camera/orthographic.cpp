// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/camera/types.h"

namespace janus {

namespace {

// Parallel rays. With a lens they tilt about the plane of focus, all alike for one lens point.
class OrthographicCamera final : public Camera {
 public:
  OrthographicCamera(const CameraDesc& desc, int width, int height)
      : pose_(desc),
        window_(desc, width, height),
        aperture_(desc),
        focus_(std::max(desc.focus_distance, kMinFocus)),
        near_(desc.clip_start),
        length_(desc.clip_end - desc.clip_start) {}

  CameraRay sample_ray(vec2 raster, vec2 u_lens) const override {
    const vec2 lens = sample_lens(u_lens);
    const vec3 local = direction(lens);
    const vec3 world = pose_.rotation * local;
    const vec3 start = pose_.to_world(vec3(window_.from_raster(raster) + lens, 0.0f));
    // The near end is a plane, the far end is not: as in Cycles.
    return {Ray{start + near_ / -local.z * world, world, length_}, start, density(local)};
  }

  std::optional<CameraConnection> connect(vec3 p, vec2 u_lens, float margin) const override {
    const vec2 lens = sample_lens(u_lens);
    const vec3 d = direction(lens);
    const vec3 local = pose_.to_local(p);
    const float distance = local.z / d.z, near_distance = near_ / -d.z;
    if (!(distance > near_distance && distance < near_distance + length_)) {
      return std::nullopt;
    }
    const vec2 start = vec2(local) - distance * vec2(d);
    const vec2 raster = window_.to_raster(start - lens);
    if (!window_.contains(raster, margin)) {
      return std::nullopt;
    }
    const vec3 world = pose_.rotation * d;
    return CameraConnection{raster, -world,
                            pose_.to_world(vec3(start, 0.0f)) + near_distance * world,
                            sqr(distance), density(d)};
  }

 private:
  vec2 sample_lens(vec2 u) const { return aperture_.pinhole() ? vec2(0.0f) : aperture_.sample(u); }
  vec3 direction(vec2 lens) const { return normalize(vec3(-lens, -focus_)); }
  // A pixel's area on a plane across the view axis, and across the ray.
  PixelDensity density(vec3 local) const {
    return {1.0f / (window_.pixel_area() * -local.z), false};
  }

  Pose pose_;
  Window window_;
  Aperture aperture_;
  float focus_, near_, length_;
};

}  // namespace

std::unique_ptr<Camera> make_orthographic(const CameraDesc& desc, int width, int height) {
  return std::make_unique<OrthographicCamera>(desc, width, height);
}

}  // namespace janus
