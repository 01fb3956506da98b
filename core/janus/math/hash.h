// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bit>
#include <cstdint>

namespace janus {

// A full-avalanche 32-bit hash ("lowbias32" constants by Wellons).
inline uint32_t hash32(uint32_t x) {
  x ^= x >> 16;
  x *= 0x7feb352dU;
  x ^= x >> 15;
  x *= 0x846ca68bU;
  x ^= x >> 16;
  return x;
}

// A full-avalanche 64-bit hash (the "splitmix64" finalizer; Stafford's variant 13).
inline uint64_t mix64(uint64_t x) {
  x ^= x >> 30;
  x *= 0xbf58476d1ce4e5b9U;
  x ^= x >> 27;
  x *= 0x94d049bb133111ebU;
  x ^= x >> 31;
  return x;
}

// Jenkins' lookup3 of a number, and of noughts behind it up to `words`: Cycles' hash.
inline uint32_t jenkins_hash(uint32_t x, uint32_t words = 1) {
  const auto mix = [](uint32_t& to, uint32_t from, int bits) {
    to = (to ^ from) - std::rotl(from, bits);
  };
  uint32_t a = 0xdeadbeefU + (words << 2) + 13U, b = a, c = a;
  a += x;
  mix(c, b, 14);
  mix(a, c, 11);
  mix(b, a, 25);
  mix(c, b, 16);
  mix(a, c, 4);
  mix(b, a, 14);
  mix(c, b, 24);
  return c;
}

inline uint32_t hash_combine(uint32_t seed, uint32_t value) {
  return hash32(seed ^ (value * 0x9e3779b9U + 0x7f4a7c15U + (seed << 6) + (seed >> 2)));
}

inline uint32_t hash_combine64(uint32_t seed, uint64_t value) {
  return hash_combine(hash_combine(seed, static_cast<uint32_t>(value)),
                      static_cast<uint32_t>(value >> 32));
}

}  // namespace janus
