// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "janus/render/exposure.h"

namespace janus {

// How far surfaces move in the picture: what Cycles calls Vector, of a scene that holds the time of
// a frame before it and of one after it.
class PictureMotion {
 public:
  // Throws Cancelled.
  PictureMotion(const Exposure& exposure, const CancelToken& cancel);

  // Pixels from the present to the time before, and from the time after to the present. Zero where
  // the camera has the surface behind it.
  vec4 of(const SurfaceInteraction& hit) const;

 private:
  // Where points of the scene are in the picture at one time.
  struct Moment {
    std::shared_ptr<const Scene> scene;
    std::unique_ptr<Camera> camera;

    Moment(std::shared_ptr<const Scene> at, const Exposure& exposure);
    std::optional<vec2> raster(const SurfaceInteraction& hit) const;
  };
  Moment now_, before_, after_;
};

}  // namespace janus
