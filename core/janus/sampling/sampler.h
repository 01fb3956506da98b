// SPDX-License-Identifier: GPL-3.0-or-later
//
// Owen-scrambled Sobol points, padded (each pair of dimensions is a (0,2)-sequence of its own with
// a shuffled order), counter-based: a number depends only on what names it, never on which thread
// asked or what was asked before. After Burley 2020, "Practical Hash-based Owen Scrambling".
#pragma once

#include <cstdint>

#include "janus/math/vec.h"

namespace janus {

// Streams never share a dimension: light and camera subpaths of a path must be independent.
enum class Stream : uint32_t { Camera = 0x43414d45, Light = 0x4c494748, Pilot = 0x50494c4f };

class Sampler {
 public:
  // Point `index` of sequence `sequence` (a pixel; 0 for the light paths of a whole pass).
  Sampler(uint32_t seed, Stream stream, uint64_t sequence, uint64_t index);

  // Jumps to the dimensions of block `block` (0: the subpath's start, i: its i-th vertex), so
  // that a vertex uses the same dimensions whatever was drawn before it.
  void start_block(uint32_t block) { dimension_ = block * kDimensionsPerBlock; }

  float next_1d();  // in [0, 1)
  vec2 next_2d();   // in [0, 1)^2

  static constexpr uint32_t kDimensionsPerBlock = 256;

 private:
  uint32_t base_, index_, dimension_ = 0;
};

}  // namespace janus
