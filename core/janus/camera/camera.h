// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cameras measure per pixel: a film position is drawn with density 1 per pixel, so resolution and
// crop appear in no weight. Raster coordinates are in pixels from the bottom-left corner of the
// full frame.
#pragma once

#include <memory>
#include <optional>

#include "janus/math/vec.h"
#include "janus/scene/description.h"

namespace janus {

struct CameraRay {
  Ray ray;          // starts on the near clipping plane, t_max is the far one
  vec3 center;      // centre of projection: distances for densities count from here
  float pdf_solid;  // of the direction, given one film position per pixel
};

// A connection of a scene point to the camera (t = 1).
struct CameraConnection {
  vec2 raster;
  vec3 wo;          // from the point to the camera, unit
  vec3 target;      // end of the shadow ray: where the camera ray would start
  float distance2;  // to the centre of projection
  float pdf_solid;  // as in CameraRay; importance per pixel = pdf_solid / distance2
};

class Camera {
 public:
  virtual ~Camera() = default;
  virtual CameraRay sample_ray(vec2 raster) const = 0;
  // nullopt outside the frame grown by `margin` pixels, or outside the clipping range.
  virtual std::optional<CameraConnection> connect(vec3 p, float margin) const = 0;
};

std::unique_ptr<Camera> make_perspective_camera(const CameraDesc& desc, int width, int height);

}  // namespace janus
