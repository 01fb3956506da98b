// SPDX-License-Identifier: GPL-3.0-or-later
//
// Random walks below the surface of an instance; see shading/subsurface.h.
#pragma once

#include "janus/render/scene.h"
#include "janus/sampling/sampler.h"
#include "janus/shading/subsurface.h"

namespace janus {

class SubsurfaceWalk {
 public:
  // Cycles' limit, so that it is a rule of the path.
  static constexpr int kMostSegments = 256;

  // Walks from `start`, in `direction`, which leads below it, through what lies below `lobe` there.
  // Returns where it comes up; nullopt: it was lost, or absorbed by roulette. Counts its `rays`.
  std::optional<SurfaceInteraction> trace(const Scene& scene, const SurfaceInteraction& start,
                                          vec3 direction, const Lobe& lobe, bool roulette,
                                          Sampler sampler, uint64_t& rays);

  // Of a walk that came up: its last direction; value over density, without the lobe's weight.
  vec3 arrival() const { return segments_[count_ - 1].direction; }
  Rgb weight() const { return weight_; }

  // The same way walked from its end, `upper` being the normal there, below `lobe`: its value, over
  // the density of the walk that was made, roulette included; and the ratio of its density to that.
  // Densities as in SubsurfaceWalker, where the first direction is given.
  struct Reverse {
    Rgb weight;
    double pdf_ratio;
  };
  Reverse reverse(const Lobe& lobe, vec3 upper) const;

 private:
  SubsurfaceWalker::Segment segments_[kMostSegments];
  float pdfs_[kMostSegments];
  int count_ = 0;
  Rgb weight_;
  float survival_ = 1.0f;
};

// The sampler of a subpath for the walk at its vertex number `edges`: beyond the dimensions of
// vertices and of PathTrace.
inline Sampler subsurface_sampler(Sampler sampler, int edges) {
  constexpr uint32_t kBlock = 3 << 20, kBlocksPerWalk = 8;
  sampler.start_block(kBlock + kBlocksPerWalk * static_cast<uint32_t>(edges));
  return sampler;
}

// The shading normal on the side of `direction`.
inline vec3 upper_normal(const SurfaceInteraction& hit, vec3 direction) {
  return dot(hit.ng, direction) < 0.0f ? -hit.ns : hit.ns;
}

}  // namespace janus
