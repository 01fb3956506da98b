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

// Density of the first vertex z_{k-1} seen by a pixel, given the point on the lens (whose own
// density is in every technique and cancels). `from_point`: `value` is per solid angle at that
// point; otherwise (parallel rays) it is per area perpendicular to the ray.
struct PixelDensity {
  float value = 0.0f;
  bool from_point = true;
};

// Density per area of z_{k-1}, given |cos| there and the squared distance from the lens point. The
// one place where the camera's end changes measure.
inline float camera_density(PixelDensity density, float cos_1, float distance2) {
  return density.value * cos_1 / (density.from_point ? distance2 : 1.0f);
}

struct CameraRay {
  Ray ray;    // starts at the near clipping distance, t_max is the far one
  vec3 lens;  // point on the lens: distances for densities count from here
  PixelDensity density;
};

// A connection of a scene point to the camera (t = 1).
struct CameraConnection {
  vec2 raster;
  vec3 wo;          // from the point to the camera, unit
  vec3 target;      // end of the shadow ray: where the camera ray would start
  float distance2;  // to the lens point
  PixelDensity density;

  // W_e G without the scene point's cosine, per pixel.
  float importance() const { return camera_density(density, 1.0f, distance2); }
};

class Camera {
 public:
  virtual ~Camera() = default;
  // `u_lens` in [0, 1)^2 picks the point on the lens.
  virtual CameraRay sample_ray(vec2 raster, vec2 u_lens) const = 0;
  // nullopt outside the frame grown by `margin` pixels, or outside the clipping range.
  virtual std::optional<CameraConnection> connect(vec3 p, vec2 u_lens, float margin) const = 0;
};

std::unique_ptr<Camera> make_camera(const CameraDesc& desc, int width, int height);

}  // namespace janus
