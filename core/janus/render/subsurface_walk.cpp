// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/render/subsurface_walk.h"

namespace janus {

std::optional<SurfaceInteraction> SubsurfaceWalk::trace(const Scene& scene,
                                                        const SurfaceInteraction& start,
                                                        vec3 direction, const Lobe& lobe,
                                                        bool roulette, Sampler sampler,
                                                        uint64_t& rays) {
  // Walks are ended by chance below it; short ones are cheap.
  constexpr float kFaint = 0.1f;
  const SubsurfaceMedium medium(lobe);
  SubsurfaceWalker walker(medium, upper_normal(start, -direction));
  const Accel::InstanceRays surfaces(*scene.accel, start.instance);
  SurfaceInteraction hit;
  vec3 p = start.p;
  survival_ = 1.0f;
  for (count_ = 0; count_ < kMostSegments; ++count_) {
    SubsurfaceWalker::Segment& segment = segments_[count_];
    const float u_channel = sampler.next_1d(), u_length = sampler.next_1d();
    const float u_guide = count_ > 0 ? sampler.next_1d() : 0.0f;
    const vec2 u = count_ > 0 ? sampler.next_2d() : vec2(0.0f);
    segment = walker.sample(direction, u_channel, u_length, u_guide, u);
    direction = segment.direction;
    Ray ray{p, direction, segment.length};
    ++rays;
    bool arrived = surfaces.intersect(ray, hit);
    if (arrived && count_ == 0 && hit.primitive == start.primitive) {
      // The surface that it comes from: by rounding, as it is flat.
      ray.origin = offset_origin(p, start.ng, start.offset, direction);
      arrived = surfaces.intersect(ray, hit) && hit.primitive != start.primitive;
    }
    segment.length = arrived ? glm::length(hit.p - p) : segment.length;
    const SubsurfaceWalker::Step step = walker.advance(segment, arrived);
    pdfs_[count_] = step.pdf;
    weight_ = medium.scale() * walker.throughput() / survival_;
    if (!(step.pdf > 0.0f) || !is_finite(weight_) || is_black(weight_)) {
      return std::nullopt;
    }
    if (arrived) {
      ++count_;
      return hit;
    }
    const float bright = max_component(walker.throughput()) / survival_;
    if (roulette && bright < kFaint) {
      if (sampler.next_1d() >= bright) {
        return std::nullopt;
      }
      survival_ *= bright;
    }
    p += segment.length * direction;
  }
  return std::nullopt;
}

SubsurfaceWalk::Reverse SubsurfaceWalk::reverse(const Lobe& lobe, vec3 upper) const {
  const SubsurfaceMedium medium(lobe);
  SubsurfaceWalker walker(medium, upper);
  Reverse out{medium.scale() / survival_, 1.0};
  for (int i = count_ - 1; i >= 0; --i) {
    const auto step =
        walker.advance({-segments_[i].direction, segments_[i].length}, /*arrived=*/i == 0);
    out.weight *= step.value / pdfs_[i];
    out.pdf_ratio *= static_cast<double>(step.pdf) / pdfs_[i];
  }
  return out;
}

}  // namespace janus
