// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/sampling/sampler.h"

#include "janus/math/hash.h"

namespace janus {

namespace {

uint32_t reverse_bits(uint32_t x) {
  x = ((x >> 1) & 0x55555555U) | ((x & 0x55555555U) << 1);
  x = ((x >> 2) & 0x33333333U) | ((x & 0x33333333U) << 2);
  x = ((x >> 4) & 0x0f0f0f0fU) | ((x & 0x0f0f0f0fU) << 4);
  return __builtin_bswap32(x);
}

// Owen scrambling of a bit-reversed number: each bit is flipped depending on the lower ones only
// (Laine & Karras 2011, with the constants found by Vegdahl).
uint32_t scramble_reversed(uint32_t x, uint32_t seed) {
  x ^= x * 0x3d20adeaU;
  x += seed;
  x *= (seed >> 16) | 1U;
  x ^= x * 0x05526c56U;
  x ^= x * 0x53a22864U;
  return x;
}

// Second dimension of the Sobol sequence, with its result bit-reversed. The generator matrix is
// Pascal's triangle mod 2; a product with it is five shift-and-xor steps.
uint32_t sobol_second_reversed(uint32_t i) {
  i ^= (i & 0xaaaaaaaaU) >> 1;
  i ^= (i & 0xccccccccU) >> 2;
  i ^= (i & 0xf0f0f0f0U) >> 4;
  i ^= (i & 0xff00ff00U) >> 8;
  i ^= (i & 0xffff0000U) >> 16;
  return i;
}

float to_unit(uint32_t x) { return static_cast<float>(x >> 8) * 0x1p-24f; }

}  // namespace

Sampler::Sampler(uint32_t seed, Stream stream, uint64_t sequence, uint64_t index)
    : base_(hash_combine64(hash_combine(hash32(seed + 0x68bc21ebU), static_cast<uint32_t>(stream)),
                           sequence)),
      index_(static_cast<uint32_t>(index)) {
  // A 32-bit sequence; the high half of a longer index picks another scrambling.
  if (index >> 32) {
    base_ = hash_combine(base_, static_cast<uint32_t>(index >> 32));
  }
}

vec2 Sampler::next_2d() {
  const uint32_t hash = hash_combine(base_, dimension_);
  dimension_ += 2;
  // Shuffling the order with an Owen scramble keeps every power-of-two prefix stratified.
  const uint32_t shuffled =
      reverse_bits(scramble_reversed(reverse_bits(index_), hash32(hash ^ 0x2545f491U)));
  // The van der Corput sequence is the bit-reversed index, so its scramble works on the index.
  const uint32_t x = reverse_bits(scramble_reversed(shuffled, hash32(hash ^ 0x9e3779b9U)));
  const uint32_t y =
      reverse_bits(scramble_reversed(sobol_second_reversed(shuffled), hash32(hash ^ 0xc2b2ae3dU)));
  return vec2(to_unit(x), to_unit(y));
}

float Sampler::next_1d() { return next_2d().x; }

}  // namespace janus
