// SPDX-License-Identifier: GPL-3.0-or-later
//
// Owen-scrambled Sobol points, padded (each pair of dimensions is a (0,2)-sequence of its own with
// a shuffled order), counter-based: a number depends only on what names it, never on which thread
// asked or what was asked before. After Burley 2020, "Practical Hash-based Owen Scrambling".
#pragma once

#include <cstdint>

#include "janus/math/hash.h"
#include "janus/math/vec.h"

namespace janus {

namespace detail {

inline uint32_t reverse_bits(uint32_t x) {
  x = ((x >> 1) & 0x55555555U) | ((x & 0x55555555U) << 1);
  x = ((x >> 2) & 0x33333333U) | ((x & 0x33333333U) << 2);
  x = ((x >> 4) & 0x0f0f0f0fU) | ((x & 0x0f0f0f0fU) << 4);
  return __builtin_bswap32(x);
}

// Owen scrambling of a bit-reversed number: each bit is flipped depending on the lower ones only
// (Laine & Karras 2011, with the constants found by Vegdahl).
inline uint32_t scramble_reversed(uint32_t x, uint32_t seed) {
  x ^= x * 0x3d20adeaU;
  x += seed;
  x *= (seed >> 16) | 1U;
  x ^= x * 0x05526c56U;
  x ^= x * 0x53a22864U;
  return x;
}

// Second dimension of the Sobol sequence, with its result bit-reversed. The generator matrix is
// Pascal's triangle mod 2; a product with it is five shift-and-xor steps.
inline uint32_t sobol_second_reversed(uint32_t i) {
  i ^= (i & 0xaaaaaaaaU) >> 1;
  i ^= (i & 0xccccccccU) >> 2;
  i ^= (i & 0xf0f0f0f0U) >> 4;
  i ^= (i & 0xff00ff00U) >> 8;
  i ^= (i & 0xffff0000U) >> 16;
  return i;
}

inline float to_unit(uint32_t x) { return static_cast<float>(x >> 8) * 0x1p-24f; }

}  // namespace detail

// Streams never share a dimension: light and camera subpaths of a path must be independent.
enum class Stream : uint32_t {
  Camera = 0x43414d45,
  Light = 0x4c494748,
  Pilot = 0x50494c4f,
  Specular = 0x53504543
};

class Sampler {
 public:
  // Point `index` of sequence `sequence` (a pixel; 0 for the light paths of a whole pass).
  Sampler(uint32_t seed, Stream stream, uint64_t sequence, uint64_t index)
      : base_(hash_combine64(
            hash_combine(hash32(seed + 0x68bc21ebU), static_cast<uint32_t>(stream)), sequence)),
        reversed_index_(detail::reverse_bits(static_cast<uint32_t>(index))) {
    // A 32-bit sequence; the high half of a longer index picks another scrambling.
    if (index >> 32) {
      base_ = hash_combine(base_, static_cast<uint32_t>(index >> 32));
    }
  }

  // Jumps to the dimensions of block `block` (0: the subpath's start, i: its i-th vertex), so
  // that a vertex uses the same dimensions whatever was drawn before it.
  void start_block(uint32_t block) { dimension_ = block * kDimensionsPerBlock; }

  // In [0, 1)^2. Always in line, as the next one: walks are large functions in which the compiler
  // soon stops, and calls of these cost them 2 to 3 %.
  [[gnu::always_inline]] vec2 next_2d() {
    using namespace detail;
    const Seeds seeds = next_seeds();
    const uint32_t i = shuffled(seeds);
    // The van der Corput sequence is the bit-reversed index, so its scramble works on the index.
    return vec2(to_unit(reverse_bits(scramble_reversed(i, seeds.first))),
                to_unit(reverse_bits(scramble_reversed(sobol_second_reversed(i), seeds.second))));
  }

  // In [0, 1).
  [[gnu::always_inline]] float next_1d() {
    const Seeds seeds = next_seeds();
    return detail::to_unit(
        detail::reverse_bits(detail::scramble_reversed(shuffled(seeds), seeds.first)));
  }

  static constexpr uint32_t kDimensionsPerBlock = 1024;

 private:
  struct Seeds {
    uint32_t order, first, second;
  };

  Seeds next_seeds() {
    const uint64_t h = mix64((static_cast<uint64_t>(base_) << 32) | dimension_);
    dimension_ += 2;
    return {static_cast<uint32_t>(h), static_cast<uint32_t>(h >> 32),
            static_cast<uint32_t>((h * 0x9e3779b97f4a7c15U) >> 32)};
  }

  // Shuffling the order with an Owen scramble keeps every power-of-two prefix stratified.
  uint32_t shuffled(const Seeds& seeds) const {
    return detail::reverse_bits(detail::scramble_reversed(reversed_index_, seeds.order));
  }

  uint32_t base_, reversed_index_, dimension_ = 0;
};

}  // namespace janus
