// SPDX-License-Identifier: GPL-3.0-or-later
//
// More walks for what only chance finds: light that reaches the camera over deltas alone (E S+ L),
// a lamp that glints in glass. No other technique makes these paths, and bdpt has fewer camera
// walks in a second than a path tracer. So pixels that see smooth glass or a mirror get walks of
// their own, which follow deltas and do nothing at their vertices, and the paths' value is the mean
// over all walks (splitting, Veach 1997, 4.5). Their number is a matter of whole passes, never of
// the walks themselves, and of counted rays, never of a clock.
#pragma once

#include <cstdint>
#include <vector>

#include "janus/film/film.h"
#include "janus/path/counters.h"

namespace janus {

class SpecularWalks {
 public:
  explicit SpecularWalks(const FilmRect& rect)
      : rect_(rect), seen_(static_cast<size_t>(rect.width()) * rect.height()) {}

  // Tells what the pass before this one did, in all.
  void begin_pass(int pass, const Counters& work);

  // The camera walk of this pixel met a delta at its first vertex. Different pixels may at once.
  void saw(size_t index) { seen_[index] |= kFound; }

  // Additional walks of a pixel in this pass, and the first one's place in the pixel's sequence.
  int count(size_t index) const { return count_ > 0 && (seen_[index] & kNear) != 0 ? count_ : 0; }
  uint64_t first() const { return first_; }

  // The part of one walk in the mean over all walks of the pixel.
  float share(size_t index) const { return 1.0f / static_cast<float>(1 + count(index)); }

 private:
  static constexpr uint8_t kFound = 1, kNear = 2;

  void plan(int pass, const Counters& work);
  void mark();

  FilmRect rect_;
  std::vector<uint8_t> seen_;  // by pixel
  size_t pixels_ = 0;          // that get walks
  double per_pass_ = 0.0, due_ = 0.0;
  int count_ = 0;  // in this pass
  uint64_t first_ = 0;
};

}  // namespace janus
