// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/camera/camera.h"

#include "janus/camera/types.h"

namespace janus {

std::unique_ptr<Camera> make_camera(const CameraDesc& desc, int width, int height) {
  switch (desc.type) {
    case CameraType::Orthographic:
      return make_orthographic(desc, width, height);
    case CameraType::Perspective:
      return make_perspective(desc, width, height);
    default:
      return make_panoramic(desc, width, height);
  }
}

}  // namespace janus
