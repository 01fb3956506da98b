// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/integrator/picture_motion.h"

#include "janus/render/time_slice.h"

namespace janus {

PictureMotion::PictureMotion(const Exposure& exposure, const CancelToken& cancel)
    : now_(exposure.timeless(), exposure),
      before_(at_time(exposure.timeless(), 0.0f, cancel), exposure),
      after_(at_time(exposure.timeless(), 1.0f, cancel), exposure) {}

PictureMotion::Moment::Moment(std::shared_ptr<const Scene> at, const Exposure& exposure)
    : scene(std::move(at)) {
  CameraDesc pinhole = scene->camera;  // that sees all, near or far
  pinhole.aperture_radius = 0.0f;
  pinhole.clip_start = 0.0f;
  pinhole.clip_end = kInfinity;
  camera = make_camera(pinhole, exposure.width(), exposure.height());
}

std::optional<vec2> PictureMotion::Moment::raster(const SurfaceInteraction& hit) const {
  const vec3 p = scene->accel->position(hit.instance, hit.primitive, hit.barycentric);
  const auto seen = camera->connect(p, vec2(0.5f), kInfinity);
  return seen ? std::optional(seen->raster) : std::nullopt;
}

vec4 PictureMotion::of(const SurfaceInteraction& hit) const {
  const auto now = now_.raster(hit), before = before_.raster(hit), after = after_.raster(hit);
  return now && before && after ? vec4(*before - *now, *now - *after) : vec4(0.0f);
}

}  // namespace janus
