// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/camera/camera.h"

namespace janus {

namespace {

class PerspectiveCamera final : public Camera {
 public:
  PerspectiveCamera(const CameraDesc& desc, int width, int height)
      : rotation_(glm::normalize(vec3(desc.transform[0])), glm::normalize(vec3(desc.transform[1])),
                  glm::normalize(vec3(desc.transform[2]))),
        center_(desc.transform[3]),
        origin_(desc.left, desc.bottom),
        pixel_((desc.right - desc.left) / width, (desc.top - desc.bottom) / height),
        size_(width, height),
        near_(desc.clip_start),
        far_(desc.clip_end) {}

  CameraRay sample_ray(vec2 raster, vec2 /*u_lens*/) const override {
    const vec3 local(origin_ + raster * pixel_, -1.0f);
    const float length = glm::length(local);
    const vec3 direction = rotation_ * (local / length);
    // Clipping planes are perpendicular to the view axis, as in Blender.
    return {Ray{center_ + near_ * length * direction, direction, (far_ - near_) * length},
            center_,
            {pdf_solid(1.0f / length), true}};
  }

  std::optional<CameraConnection> connect(vec3 p, vec2 /*u_lens*/, float margin) const override {
    const vec3 to_camera = center_ - p;
    const vec3 local = -(glm::transpose(rotation_) * to_camera);
    const float depth = -local.z;
    if (!(depth > near_ && depth < far_)) {
      return std::nullopt;
    }
    const vec2 raster = (vec2(local) / depth - origin_) / pixel_;
    if (!(raster.x >= -margin && raster.y >= -margin && raster.x <= size_.x + margin &&
          raster.y <= size_.y + margin)) {
      return std::nullopt;
    }
    const float d2 = length2(to_camera);
    const float distance = std::sqrt(d2);
    const vec3 wo = to_camera / distance;
    const float cos_axis = depth / distance;
    return CameraConnection{
        raster, wo, center_ - (near_ / cos_axis) * wo, d2, {pdf_solid(cos_axis), true}};
  }

 private:
  // One film position per pixel: the pixel's area at distance 1 seen under cos^3.
  float pdf_solid(float cos_axis) const {
    return 1.0f / (std::abs(pixel_.x * pixel_.y) * cos_axis * cos_axis * cos_axis);
  }

  mat3 rotation_;
  vec3 center_;
  vec2 origin_, pixel_, size_;
  float near_, far_;
};

}  // namespace

std::unique_ptr<Camera> make_camera(const CameraDesc& desc, int width, int height) {
  return std::make_unique<PerspectiveCamera>(desc, width, height);
}

}  // namespace janus
