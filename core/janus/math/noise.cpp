// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/math/noise.h"

#include <algorithm>
#include <cstring>

#include "janus/math/hash.h"

namespace janus {

namespace {

// Four corners of a cell at once: vectors that GCC and Clang know on any processor.
constexpr int kLanes = 4;
typedef float Floats __attribute__((vector_size(4 * kLanes)));  // NOLINT: `using` has no attributes
typedef uint32_t Words __attribute__((vector_size(4 * kLanes)));  // NOLINT

// The sign bit of x is changed by a bit of `hash`.
inline Floats signed_by(Floats x, Words hash, int bit) {
  return std::bit_cast<Floats>(std::bit_cast<Words>(x) ^ ((hash >> bit) << 31));
}

// The product of `at` and one of the gradients: in one dimension those of slope 1 to 8; else, but
// for two, towards the middles of the edges of a cube.
template <int D>
inline Floats along_gradient(Words h, const Floats* at) {
  if constexpr (D == 1) {
    return signed_by(1.0f + __builtin_convertvector(h & 7, Floats), h, 3) * at[0];
  } else if constexpr (D == 2) {
    const auto upright = (h & 7) >= 4;
    const Floats u = upright ? at[1] : at[0], v = 2.0f * (upright ? at[0] : at[1]);
    return signed_by(u, h, 0) + signed_by(v, h, 1);
  } else if constexpr (D == 3) {
    h &= 15;
    const Floats u = h < 8 ? at[0] : at[1];
    const Floats other = (h & 13) == 12 ? at[0] : at[2], v = h < 4 ? at[1] : other;
    return signed_by(u, h, 0) + signed_by(v, h, 1);
  } else {
    h &= 31;
    const Floats u = h < 24 ? at[0] : at[1];
    const Floats v = h < 16 ? at[1] : at[2];
    const Floats w = h < 8 ? at[2] : at[3];
    return signed_by(u, h, 0) + signed_by(v, h, 1) + signed_by(w, h, 2);
  }
}

// So that the range is about [-1, 1] in each number of dimensions.
constexpr float kRange[] = {0.25f, 0.6616f, 0.982f, 0.8344f};

// Far from the origin floats are coarse; where they are all integers, they are moved off the grid.
// In three and four dimensions Cycles has another remainder than in one and two.
template <int D>
inline float repeated(float x) {
  constexpr float kPeriod = 100000.0f;
  if (!(std::abs(x) >= kPeriod)) {
    return x;
  }
  const float rest = D < 3 ? std::fmod(x, kPeriod) : std::fma(-std::trunc(x / kPeriod), kPeriod, x);
  return rest + (std::abs(x) >= 1000000.0f ? 0.5f : 0.0f);
}

}  // namespace

template <int D>
float perlin_noise(Coordinates<D> p) {
  constexpr int kCorners = std::max(1 << D, kLanes);  // in one dimension, two of them twice
  uint32_t cell[D];
  float inside[D], ease[D];
  for (int d = 0; d < D; ++d) {
    const float x = repeated<D>(p[d]), low = std::floor(x);
    cell[d] = static_cast<uint32_t>(to_integer(low));
    const float t = inside[d] = x - low;
    ease[d] = t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f);
  }
  float values[kCorners];
  for (uint32_t first = 0; first < kCorners; first += kLanes) {
    const Words number = first + Words{0, 1, 2, 3};
    std::array<Words, D> corner;
    Floats at[D];
    for (int d = 0; d < D; ++d) {
      const Words bit = (number >> d) & 1;
      corner[d] = cell[d] + bit;
      at[d] = inside[d] - __builtin_convertvector(bit, Floats);
    }
    const Floats along = along_gradient<D>(jenkins_hash(corner), at);
    std::memcpy(values + first, &along, sizeof(along));
  }
  for (int d = 0; d < D; ++d) {
    for (int c = 0; c < (1 << D) >> (d + 1); ++c) {
      values[c] = values[2 * c] + ease[d] * (values[2 * c + 1] - values[2 * c]);
    }
  }
  return kRange[D - 1] * values[0];
}

namespace {

// At a lacunarity of 2 those after them lie at infinity, where there are no numbers.
constexpr int kMostOctaves = 150;

float lerp(float a, float b, float t) { return a + t * (b - a); }

// The functions below ask for octaves, one after the other, of the next finer noise each. The last
// of all has the weight `rest`, if that is not 0.
template <int D>
struct Octaves {
  Octaves(Coordinates<D> at, const Fractal& f)
      : count(std::min(to_integer(f.detail), kMostOctaves) + 1),
        rest(f.detail - std::floor(f.detail)),
        p(at),
        lacunarity(f.lacunarity) {}

  float next() {
    const float noise = perlin_noise<D>(p);
    p *= lacunarity;
    return noise;
  }

  int count;
  float rest;
  Coordinates<D> p;
  float lacunarity;
};

template <int D>
float fbm(Coordinates<D> p, const Fractal& f) {
  const Octaves<D> octaves(p, f);
  float scale = 1.0f, weight = 1.0f, weights = 0.0f, sum = 0.0f;
  const auto result = [&](float total, float most) {
    return f.normalize ? 0.5f * total / most + 0.5f : total;
  };
  for (int i = 0; i < octaves.count; ++i) {
    sum += weight * perlin_noise<D>(scale * p);
    weights += weight;
    weight *= f.roughness;
    scale *= f.lacunarity;
  }
  if (octaves.rest == 0.0f) {
    return result(sum, weights);
  }
  const float more = sum + weight * perlin_noise<D>(scale * p);
  return lerp(result(sum, weights), result(more, weights + weight), octaves.rest);
}

template <int D>
float multifractal(Coordinates<D> p, const Fractal& f) {
  Octaves<D> octaves(p, f);
  float value = 1.0f, weight = 1.0f;
  for (int i = 0; i < octaves.count; ++i) {
    value *= weight * octaves.next() + 1.0f;
    weight *= f.roughness;
  }
  return octaves.rest == 0.0f ? value : value * (octaves.rest * weight * octaves.next() + 1.0f);
}

template <int D>
float hetero_terrain(Coordinates<D> p, const Fractal& f) {
  Octaves<D> octaves(p, f);
  float value = f.offset + octaves.next(), weight = f.roughness;
  for (int i = 1; i < octaves.count; ++i) {
    value += (octaves.next() + f.offset) * weight * value;
    weight *= f.roughness;
  }
  return octaves.rest == 0.0f ? value
                              : value + octaves.rest * (octaves.next() + f.offset) * weight * value;
}

// Octaves weigh as much as those before them were high; when there is nothing left, it ends.
template <int D>
float hybrid_multifractal(Coordinates<D> p, const Fractal& f) {
  Octaves<D> octaves(p, f);
  float value = 0.0f, weight = 1.0f, amplitude = 1.0f;
  for (int i = 0; i < octaves.count && weight > 0.001f; ++i) {
    weight = std::min(weight, 1.0f);
    const float signal = (octaves.next() + f.offset) * amplitude;
    amplitude *= f.roughness;
    value += weight * signal;
    weight *= f.gain * signal;
  }
  if (octaves.rest != 0.0f && weight > 0.001f) {
    const float signal = (octaves.next() + f.offset) * amplitude;
    value += octaves.rest * std::min(weight, 1.0f) * signal;
  }
  return value;
}

// Here a fraction of an octave is none.
template <int D>
float ridged_multifractal(Coordinates<D> p, const Fractal& f) {
  Octaves<D> octaves(p, f);
  const auto ridge = [&] { return sqr(f.offset - std::abs(octaves.next())); };
  float signal = ridge(), value = signal, amplitude = f.roughness;
  for (int i = 1; i < octaves.count; ++i) {
    const float weight = std::clamp(signal * f.gain, 0.0f, 1.0f);
    signal = ridge() * weight;
    value += signal * amplitude;
    amplitude *= f.roughness;
  }
  return value;
}

}  // namespace

template <int D>
float fractal_noise(Coordinates<D> p, const Fractal& f) {
  switch (f.type) {
    case NoiseType::Multifractal:
      return multifractal<D>(p, f);
    case NoiseType::RidgedMultifractal:
      return ridged_multifractal<D>(p, f);
    case NoiseType::HybridMultifractal:
      return hybrid_multifractal<D>(p, f);
    case NoiseType::HeteroTerrain:
      return hetero_terrain<D>(p, f);
    case NoiseType::Fbm:
      break;
  }
  return fbm<D>(p, f);
}

template float perlin_noise<1>(Coordinates<1>);
template float perlin_noise<2>(Coordinates<2>);
template float perlin_noise<3>(Coordinates<3>);
template float perlin_noise<4>(Coordinates<4>);
template float fractal_noise<1>(Coordinates<1>, const Fractal&);
template float fractal_noise<2>(Coordinates<2>, const Fractal&);
template float fractal_noise<3>(Coordinates<3>, const Fractal&);
template float fractal_noise<4>(Coordinates<4>, const Fractal&);

}  // namespace janus
