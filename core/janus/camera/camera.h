// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cameras measure per pixel: a film position is drawn with density 1 per pixel, so resolution and
// crop appear in no weight. Raster coordinates are in pixels from the bottom-left corner of the
// full frame.
//
// A lens point is drawn by `u_lens`, in sample_ray() as in connect(). Given u_lens, a film position
// fixes the ray; the density of u_lens is in every technique and cancels.
#pragma once

#include <memory>
#include <optional>

#include "janus/math/vec.h"
#include "janus/scene/description.h"

namespace janus {

// Density of the first vertex z_{k-1} seen by a pixel, given u_lens. `from_point`: `value` is per
// solid angle at the lens point; otherwise (parallel rays) it is per area perpendicular to the ray.
struct PixelDensity {
  float value = 0.0f;
  bool from_point = true;
  // Where the rays of neighbouring film positions meet, as two distances from the lens point. They
  // meet in the lens point itself, but for a panorama with a lens: its lens point turns with the
  // ray.
  vec2 foci = vec2(0.0f);
};

// Density per area of z_{k-1}, given |cos| there and the squared distance from the lens point. The
// one place where the camera's end changes measure.
inline float camera_density(const PixelDensity& density, float cos_1, float distance2) {
  if (!density.from_point) {
    return density.value * cos_1;
  }
  if (density.foci == vec2(0.0f)) {
    return density.value * cos_1 / distance2;
  }
  const vec2 d = std::sqrt(distance2) - density.foci;
  return density.value * cos_1 / std::abs(d.x * d.y);
}

struct CameraRay {
  Ray ray;    // starts at the near clipping distance, t_max is the far one
  vec3 lens;  // point on the lens: distances for densities count from here
  PixelDensity density;

  // Where a fisheye sees nothing, the picture is black, and opaque as in Cycles.
  static CameraRay nothing(vec3 center) {
    return {Ray{center, vec3(0.0f, 0.0f, 1.0f), -1.0f}, center, {}};
  }
  bool blind() const { return ray.t_max < 0.0f; }
};

// A connection of a scene point to the camera (t = 1).
struct CameraConnection {
  vec2 raster;
  vec3 wo;          // from the point to the camera, unit
  vec3 target;      // end of the shadow ray: where the camera ray would start
  float distance2;  // to the lens point
  PixelDensity density;
  // A panorama may see the point at several film positions (over its seam, say). One was
  // chosen with this probability; a contribution is divided by it, a weight is not.
  float pmf = 1.0f;

  // W_e G without the scene point's cosine, per pixel.
  float importance() const { return camera_density(density, 1.0f, distance2); }
};

// Where light that flies about by itself comes through the lens (t = 0).
struct LensHit {
  vec2 raster;
  float importance;  // W_e: a pixel's response to the flux that comes in here
  vec3 position;     // on the lens
};

class Camera {
 public:
  virtual ~Camera() = default;
  // `u_lens` in [0, 1)^2 picks the point on the lens. `raster` may lie outside the frame: the pixel
  // filter reaches over its border. A ray may be blind().
  virtual CameraRay sample_ray(vec2 raster, vec2 u_lens) const = 0;
  // The inverse: sample_ray(raster, u_lens) passes through `p`. nullopt outside the frame grown by
  // `margin` pixels (infinite: everywhere), or outside the clipping range.
  virtual std::optional<CameraConnection> connect(vec3 p, vec2 u_lens, float margin) const = 0;

  // Has it a lens that can be hit? Pinholes have not, nor have cameras that are more than one lens.
  virtual bool hittable() const { return false; }
  // Where `ray` meets the lens between two distances. The lens is not in the ray's way.
  virtual std::optional<LensHit> hit_lens(const Ray& ray, float t_begin, float t_end,
                                          float margin) const {
    (void)ray, (void)t_begin, (void)t_end, (void)margin;
    return std::nullopt;
  }
};

std::unique_ptr<Camera> make_camera(const CameraDesc& desc, int width, int height);

}  // namespace janus
