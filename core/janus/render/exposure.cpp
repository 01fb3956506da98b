// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/render/exposure.h"

#include <algorithm>

#include "janus/math/hash.h"
#include "janus/render/time_slice.h"

namespace janus {

namespace {

// Times of a pass. More of them make noise of what would be separate images of one thing; each
// costs what at_time() does.
constexpr size_t kMostTimes = 16, kFewestTimes = 4;
// For each unit of slice_work(): so that it takes about a tenth of a pass. In a plain scene, a
// pixel's paths take about twice as long as such a unit.
constexpr size_t kPixels = 5;

}  // namespace

Exposure::Exposure(std::shared_ptr<const Scene> scene, int width, int height, size_t pixels,
                   bool blurs, uint32_t seed)
    : timeless_(std::move(scene)),
      scene_(timeless_),
      camera_(make_camera(scene_->camera, width, height)),
      width_(width),
      height_(height) {
  if (!blurs || !moves(*timeless_)) {
    return;
  }
  times_ = std::clamp(pixels / std::max<size_t>(1, kPixels * slice_work(*timeless_)), kFewestTimes,
                      kMostTimes);
  shift_ = static_cast<float>(hash32(seed) >> 8) * 0x1p-24f;
  float sum = 0.0f;
  for (const float open : timeless_->camera.shutter) {
    let_through_.push_back(sum);
    sum += open;
  }
  let_through_.push_back(sum);
  for (float& share : let_through_) {
    share /= sum;
  }
}

Exposure::Exposure(const Exposure& whole)
    : whole_(&whole),
      timeless_(whole.timeless_->catchers_alone),
      scene_(timeless_),
      camera_(make_camera(scene_->camera, whole.width_, whole.height_)),
      width_(whole.width_),
      height_(whole.height_),
      times_(whole.times_),
      shift_(whole.shift_),
      let_through_(whole.let_through_) {}

// Van der Corput's sequence over passes, turned by the golden ratio from wave to wave.
float Exposure::time(int pass, size_t wave) const {
  double u = shift_ + 0.6180339887498949 * static_cast<double>(wave);
  double digit = 0.5;
  for (auto rest = static_cast<uint32_t>(pass); rest > 0; rest >>= 1, digit *= 0.5) {
    u += rest & 1 ? digit : 0.0;
  }
  return through_shutter(static_cast<float>(u - std::floor(u)));
}

float Exposure::through_shutter(float u) const {
  if (let_through_.size() < 2) {
    return u;
  }
  const auto after = std::upper_bound(let_through_.begin() + 1, let_through_.end() - 1, u);
  const float from = *(after - 1), to = *after;
  const float share = to > from ? std::clamp((u - from) / (to - from), 0.0f, 1.0f) : 0.5f;
  const auto step = static_cast<float>(after - 1 - let_through_.begin());
  return (step + share) / static_cast<float>(let_through_.size() - 1);
}

void Exposure::open(int pass, size_t wave, const CancelToken& cancel) {
  if (times_ == 1) {
    return;
  }
  scene_ = at_time(timeless_, time(pass, wave), cancel, whole_ ? &whole_->scene() : nullptr);
  camera_ = make_camera(scene_->camera, width_, height_);
}

}  // namespace janus
