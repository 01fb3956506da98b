// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/render/camera_checks.h"

#include <algorithm>

#include "janus/geometry/reach.h"
#include "janus/render/scene.h"
#include "janus/scene/panorama.h"
#include "janus/util/error.h"

namespace janus {

bool is_placement(const mat4& m) {
  const float determinant = glm::determinant(mat3(m));
  return is_finite(m) && std::isfinite(determinant) && determinant != 0.0f &&
         enlargement(m) <= kMostLarger;
}

void check_camera(const CameraDesc& camera) {
  const float window = (camera.right - camera.left) * (camera.top - camera.bottom);
  const float volume = glm::determinant(mat3(camera.transform));
  const auto usable = [](float x) { return std::isfinite(x) && x != 0.0f; };
  if (!is_finite(camera.transform) || !usable(volume) || !usable(window)) {
    throw SceneError(camera.name, "camera", "its transform or its window is degenerate");
  }
  if (!(camera.clip_end > camera.clip_start) || !(camera.clip_start >= 0.0f)) {
    throw SceneError(camera.name, "camera", "its clipping range is empty");
  }
  for (const CameraDesc::Key& key : camera.motion) {
    const float size = (key.right - key.left) * (key.top - key.bottom);
    if (!is_placement(key.transform) || !usable(size)) {
      throw SceneError(camera.name, "camera",
                       "its transform or its window is degenerate while the shutter is open");
    }
  }
  if (camera.motion.size() == 1) {
    throw SceneError(camera.name, "motion", "one time is no motion");
  }
  if (std::ranges::any_of(camera.shutter, [](float x) { return !(x >= 0.0f) || std::isinf(x); }) ||
      (!camera.shutter.empty() && std::ranges::max(camera.shutter) <= 0.0f)) {
    throw SceneError(camera.name, "shutter", "the shutter never opens");
  }
  const CameraView view = view_of(camera);
  if (camera.type == CameraType::Equirectangular &&
      !(std::max(std::abs(view.bottom), std::abs(view.top)) <= 1.0001f * 0.5f * kPi)) {
    throw SceneError(camera.name, "camera", "its latitudes go beyond the poles");
  }
  if (is_panorama(camera.type) && !usable_fisheye(camera.fisheye)) {
    throw SceneError(camera.name, "camera", "its fisheye sees nothing, or without end");
  }
  if (!(camera.aperture_radius >= 0.0f) || !std::isfinite(camera.aperture_radius) ||
      !(camera.focus_distance >= 0.0f) || !std::isfinite(camera.focus_distance) ||
      !(camera.aperture_ratio > 0.0f) || !std::isfinite(camera.aperture_rotation)) {
    throw SceneError(camera.name, "camera", "its lens is not a lens");
  }
}

}  // namespace janus
