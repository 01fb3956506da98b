// SPDX-License-Identifier: GPL-3.0-or-later
//
// Bsdfs for the tests, made of lobes with normals.
#pragma once

#include <vector>

#include "janus/shading/bsdf.h"
#include "support/statistics.h"

namespace janus::test {

inline const vec3 kNg(0, 0, 1);
inline const vec3 kTilted = normalize(vec3(0.5f, -0.3f, 1));

inline Lobe placed(Lobe lobe, vec3 normal) {
  lobe.normal = normal;
  return lobe;
}

// Covered by the lobe that stands `above` places before it.
inline Lobe below(Lobe lobe, int above = 1) {
  lobe.above = static_cast<uint8_t>(above);
  return lobe;
}

inline Bsdf make(const std::vector<Lobe>& lobes) {
  Bsdf bsdf;
  for (const Lobe& lobe : lobes) {
    EXPECT_TRUE(bsdf.add(lobe));
  }
  bsdf.finish();
  return bsdf;
}

inline vec3 at_cosine(float z, float phi = 0.0f) {
  const float r = std::sqrt(1 - z * z);
  return vec3(r * std::cos(phi), r * std::sin(phi), z);
}

// What a camera walk gets back from white surroundings at direction `from`; the direction's
// density divided out by sampling, deltas included.
inline Mean albedo(const BsdfView& bsdf, vec3 from, int count, uint64_t seed = 1) {
  Random random(seed);
  Mean mean;
  for (int i = 0; i < count; ++i) {
    const auto s = bsdf.sample(from, random.next(), random.next_2d(), TransportMode::Radiance);
    mean.add(s ? average(s->weight) : 0.0f);
  }
  return mean;
}

// Integral of f |cos| over all wi at `wo`, by midpoints: deltas excluded, no sampling.
inline double integrated(const BsdfView& bsdf, vec3 wo, int grid = 24) {
  double sum = 0;
  const auto cells =
      SphereCells{16, 32}.integrate([&](vec3 wi) { return average(bsdf.eval_cos(wo, wi)); }, grid);
  for (const double c : cells) {
    sum += c;
  }
  return sum;
}

}  // namespace janus::test
