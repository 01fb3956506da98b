// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the kinds of cameras share, and their makers.
#pragma once

#include "janus/camera/aperture.h"
#include "janus/camera/camera.h"

namespace janus {

// The frame in the units of CameraDesc::left and its like.
class Window {
 public:
  Window(const CameraDesc& desc, int width, int height)
      : origin_(desc.left, desc.bottom),
        pixel_((desc.right - desc.left) / width, (desc.top - desc.bottom) / height),
        size_(width, height) {}

  vec2 from_raster(vec2 raster) const { return origin_ + raster * pixel_; }
  vec2 to_raster(vec2 position) const { return (position - origin_) / pixel_; }
  vec2 pixel() const { return pixel_; }
  float pixel_area() const { return std::abs(pixel_.x * pixel_.y); }
  vec2 size() const { return size_; }
  bool contains(vec2 raster, float margin) const {
    return raster.x >= -margin && raster.y >= -margin && raster.x <= size_.x + margin &&
           raster.y <= size_.y + margin;
  }

 private:
  vec2 origin_, pixel_, size_;
};

// Where the camera stands, its axes made unit.
struct Pose {
  explicit Pose(const CameraDesc& desc)
      : rotation(glm::normalize(vec3(desc.transform[0])), glm::normalize(vec3(desc.transform[1])),
                 glm::normalize(vec3(desc.transform[2]))),
        center(desc.transform[3]) {}

  vec3 to_world(vec3 local) const { return center + rotation * local; }
  vec3 to_local(vec3 p) const { return glm::transpose(rotation) * (p - center); }

  mat3 rotation;
  vec3 center;
};

// Cycles' lower bound of the focus distance.
inline constexpr float kMinFocus = 1e-5f;

std::unique_ptr<Camera> make_perspective(const CameraDesc& desc, int width, int height);
std::unique_ptr<Camera> make_orthographic(const CameraDesc& desc, int width, int height);
std::unique_ptr<Camera> make_panoramic(const CameraDesc& desc, int width, int height);

}  // namespace janus
