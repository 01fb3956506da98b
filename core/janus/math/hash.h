// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <bit>
#include <cstddef>
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

// Jenkins' lookup3 of one to four words: Cycles' hash. Words may be vectors of uint32_t, too.
template <class Word, size_t N>
constexpr Word jenkins_hash(const std::array<Word, N>& words) {
  static_assert(N >= 1 && N <= 4);
  const auto rotated = [](const Word& x, int bits) { return (x << bits) | (x >> (32 - bits)); };
  Word a = Word{} + (0xdeadbeefU + (static_cast<uint32_t>(N) << 2) + 13U), b = a, c = a;
  a += words[0];
  if constexpr (N > 1) {
    b += words[1];
  }
  if constexpr (N > 2) {
    c += words[2];
  }
  if constexpr (N > 3) {
    const auto stir = [&](Word& to, Word& from, const Word& next, int bits) {
      to = (to - from) ^ rotated(from, bits);
      from += next;
    };
    stir(a, c, b, 4);
    stir(b, a, c, 6);
    stir(c, b, a, 8);
    stir(a, c, b, 16);
    stir(b, a, c, 19);
    stir(c, b, a, 4);
    a += words[3];
  }
  const auto mix = [&](Word& to, const Word& from, int bits) {
    to = (to ^ from) - rotated(from, bits);
  };
  mix(c, b, 14);
  mix(a, c, 11);
  mix(b, a, 25);
  mix(c, b, 16);
  mix(a, c, 4);
  mix(b, a, 14);
  mix(c, b, 24);
  return c;
}

// The same as a number in [0, 1].
template <size_t N>
constexpr float jenkins_number(const std::array<uint32_t, N>& words) {
  return static_cast<float>(jenkins_hash(words)) * (1.0f / 4294967295.0f);
}
// Of the bits of numbers.
template <class... Floats>
constexpr float jenkins_number(float first, Floats... more) {
  return jenkins_number(
      std::array{std::bit_cast<uint32_t>(first), std::bit_cast<uint32_t>(more)...});
}

// Permuted congruential generators of two to four words (Jarzynski & Olano, Hash Functions for GPU
// Rendering), as Cycles has them: signs are shifted in, and the result has 31 bits.
template <size_t N>
constexpr std::array<uint32_t, N> pcg_hash(std::array<uint32_t, N> v) {
  static_assert(N >= 2 && N <= 4);
  for (uint32_t& x : v) {
    x = x * 1664525U + 1013904223U;
  }
  const auto stir = [&v] {
    if constexpr (N == 2) {
      v[0] += v[1] * 1664525U;
      v[1] += v[0] * 1664525U;
    } else if constexpr (N == 3) {
      v[0] += v[1] * v[2];
      v[1] += v[2] * v[0];
      v[2] += v[0] * v[1];
    } else {
      v[0] += v[1] * v[3];
      v[1] += v[2] * v[0];
      v[2] += v[0] * v[1];
      v[3] += v[1] * v[2];
    }
  };
  stir();
  for (uint32_t& x : v) {
    x ^= static_cast<uint32_t>(static_cast<int32_t>(x) >> 16);
  }
  stir();
  for (uint32_t& x : v) {
    x &= 0x7fffffffU;
  }
  return v;
}

inline uint32_t hash_combine(uint32_t seed, uint32_t value) {
  return hash32(seed ^ (value * 0x9e3779b9U + 0x7f4a7c15U + (seed << 6) + (seed >> 2)));
}

inline uint32_t hash_combine64(uint32_t seed, uint64_t value) {
  return hash_combine(hash_combine(seed, static_cast<uint32_t>(value)),
                      static_cast<uint32_t>(value >> 32));
}

}  // namespace janus
