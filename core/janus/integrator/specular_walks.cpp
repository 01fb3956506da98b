// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/integrator/specular_walks.h"

#include <algorithm>

#include "janus/integrator/adaptive_counts.h"

namespace janus {

namespace {

constexpr int kFirstPass = 2;   // with walks of their own: those before it look for deltas
constexpr double kMost = 64.0;  // walks of a pixel, in a pass

// Of a pass's work, what its specular walks may cost. Where that is less than a walk for each
// pixel, as with a mirror all over the picture, they would not help enough.
constexpr double kShare = 0.25;

// A ray of such a walk, beside a camera ray with its vertex and next event estimation.
constexpr double kRay = 0.8;

constexpr double kRaysOfWalk = 5.0;  // before any was traced: in and out of a thing of glass

}  // namespace

void SpecularWalks::begin_pass(int pass, const Counters& work) {
  first_ += count_;
  plan(pass, work);
  const double due = due_ + per_pass_;
  count_ = static_cast<int>(due);
  due_ = due - count_;
}

void SpecularWalks::plan(int pass, const Counters& work) {
  if (pass < kFirstPass || (pass & (pass - 1)) != 0) {
    return;
  }
  if (pass == kFirstPass) {
    mark();
  }
  if (pixels_ == 0) {
    return;
  }
  const double rays = work.specular_walks > 0 ? static_cast<double>(work.specular_rays) /
                                                    static_cast<double>(work.specular_walks)
                                              : kRaysOfWalk;
  const double walks = kShare * AdaptiveCounts::cost(work) / (kRay * rays);
  const double each = walks / static_cast<double>(pixels_);
  per_pass_ = each < 1.0 ? 0.0 : std::min(each, kMost);
}

// Pixels where a delta was seen, and those around them: an edge crosses a pixel seldom at first.
void SpecularWalks::mark() {
  const int w = rect_.width(), h = rect_.height();
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      bool near = false;
      for (int j = std::max(y - 1, 0); j <= std::min(y + 1, h - 1); ++j) {
        for (int i = std::max(x - 1, 0); i <= std::min(x + 1, w - 1); ++i) {
          near = near || (seen_[static_cast<size_t>(j) * w + i] & kFound) != 0;
        }
      }
      if (near) {
        seen_[static_cast<size_t>(y) * w + x] |= kNear;
        ++pixels_;
      }
    }
  }
}

}  // namespace janus
