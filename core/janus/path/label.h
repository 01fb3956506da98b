// SPDX-License-Identifier: GPL-3.0-or-later
//
// Labels of vertices: diffuse, glossy or transmission, as Cycles names the bounces of a path.
// Transmission is whatever goes to the other side, a reflection is diffuse or glossy by its lobe, a
// mirror counts as glossy. Where several lobes reflect smoothly into the same direction, the vertex
// has each of their labels by its share of f (a mean over the channels). The shares are a property
// of the path: walks draw a label, joins sum over them, and densities and weights do not know.
#pragma once

#include "janus/sampling/sampler.h"
#include "janus/scene/ray_type.h"
#include "janus/shading/bsdf.h"

namespace janus {

// The shares of a vertex's labels; their sum is 1.
struct LabelShares {
  float of[3] = {};  // by RayType

  float operator[](RayType label) const { return of[static_cast<int>(label)]; }

  static LabelShares only(RayType label) {
    LabelShares shares;
    shares.of[static_cast<int>(label)] = 1.0f;
    return shares;
  }
  static LabelShares reflection(float diffuse) { return {{diffuse, 1.0f - diffuse, 0.0f}}; }

  // Of a vertex with value `e` for two directions on the same or on different sides of Ng.
  static LabelShares joined(const BsdfEval& e, bool transmitted) {
    if (transmitted) {
      return only(RayType::Transmission);
    }
    return reflection(e.diffuse > 0.0f ? std::min(e.diffuse / average(e.f), 1.0f) : 0.0f);
  }
  static LabelShares sampled(const BsdfSample& sample) {
    return sample.transmitted ? only(RayType::Transmission)
                              : reflection(std::min(sample.share_diffuse, 1.0f));
  }

  // One label by chance. Takes a number only where there is a choice.
  RayType draw(Sampler& sampler) const {
    if (of[2] > 0.0f) {
      return RayType::Transmission;
    }
    if (of[0] == 0.0f || of[1] == 0.0f) {
      return of[0] > 0.0f ? RayType::Diffuse : RayType::Glossy;
    }
    return sampler.next_1d() < of[0] ? RayType::Diffuse : RayType::Glossy;
  }
};

// Bounces of a part of a path by label.
struct BounceCounts {
  uint16_t of[3] = {};

  BounceCounts with(RayType label) const {
    BounceCounts more = *this;
    ++more.of[static_cast<int>(label)];
    return more;
  }
  BounceCounts operator+(const BounceCounts& o) const {
    BounceCounts sum;
    for (int i = 0; i < 3; ++i) {
      sum.of[i] = static_cast<uint16_t>(of[i] + o.of[i]);
    }
    return sum;
  }
};

}  // namespace janus
