// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a picture is taken of. Where something moves, each wave of a pass sees it at one time of
// the shutter, light paths and camera paths alike: subpaths of different times cannot be joined.
// All that is drawn from a wave has the same time, and the mean over times is the picture.
#pragma once

#include <memory>

#include "janus/camera/camera.h"
#include "janus/render/scene.h"

namespace janus {

class Exposure {
 public:
  // Of a frame of `width` times `height` pixels, of which `pixels` are rendered. `blurs`: with the
  // shutter's motion blur; otherwise everything is as it is in the scene.
  Exposure(std::shared_ptr<const Scene> scene, int width, int height, size_t pixels, bool blurs,
           uint32_t seed);
  // Of the shadow catchers alone in what `whole` sees, at the same times: always opened after it.
  explicit Exposure(const Exposure& whole);

  // At how many times a pass sees the scene: 1 where nothing moves.
  size_t times() const { return times_; }
  // The time of a wave, in [0, 1]. Those of all waves are spread evenly over what the shutter lets
  // through; so are those of all waves of one number, and those of one pass.
  float time(int pass, size_t wave) const;
  // From now on all stands as it does then. Throws Cancelled.
  void open(int pass, size_t wave, const CancelToken& cancel);

  // The frame, pixels.
  int width() const { return width_; }
  int height() const { return height_; }
  // The scene of which all times are.
  const std::shared_ptr<const Scene>& timeless() const { return timeless_; }

  const Scene& scene() const { return *scene_; }
  const Camera& camera() const { return *camera_; }

 private:
  float through_shutter(float u) const;

  const Exposure* whole_ = nullptr;
  std::shared_ptr<const Scene> timeless_, scene_;
  std::unique_ptr<Camera> camera_;
  int width_, height_;
  size_t times_ = 1;
  float shift_ = 0.0f;              // of all times, by the seed
  std::vector<float> let_through_;  // by even times: the share of the light until then
};

}  // namespace janus
