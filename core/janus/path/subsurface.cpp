// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/path/subsurface.h"

#include <algorithm>

#include "janus/render/subsurface_walk.h"

namespace janus {

namespace {

// Can light subpaths go below there, or come up? What looks different from everywhere has another
// medium for every view.
bool light_passes(const PathVertex& v) {
  return !v.reshading.program && !v.shading.bsdf.one_way() &&
         light_passage(v.shading.bsdf.lobes()) != nullptr;
}

// Beyond it one walk is all that counts, and squares of larger numbers are no numbers.
float usable(double ratio) { return static_cast<float>(std::min(ratio, 1e15)); }

// d omega at the exit, drawn by the cosine, to an area at the entry: of light walks, relative to
// camera walks, whose direction has a density at the entry.
double entry_over_exit(float cos_entry) { return cos_entry * kInvPi; }

}  // namespace

bool come_up(const Scene& scene, const Mis& mis, const BsdfSample& sample, TransportMode mode,
             bool roulette, const Sampler& sampler, uint64_t& rays, PathVertex& v) {
  const bool camera = mode == TransportMode::Radiance;
  const Lobe lobe = v.shading.bsdf.lobes()[static_cast<size_t>(sample.below)];
  SubsurfaceWalk walk;
  const auto end = walk.trace(scene, v.hit, sample.direction, lobe, roulette,
                              subsurface_sampler(sampler, v.edges), rays);
  if (!end) {
    return false;
  }
  const float cos_start = std::abs(dot(v.hit.ng, sample.direction));
  const vec3 arrival = walk.arrival();
  v.hit = *end;
  scene.shade(v.hit, arrival, v.shading, v.reshading);
  Bsdf& bsdf = v.shading.bsdf;
  const bool passes = light_passes(v);
  const Lobe* other = passes ? light_passage(bsdf.lobes()) : nullptr;
  const float cos_end = std::abs(dot(v.hit.ng, arrival));
  if (camera) {
    double ratio = 0.0;
    if (other && sample.pdf_reverse > 0.0f) {
      ratio = walk.reverse(*other, upper_normal(v.hit, arrival)).pdf_ratio *
              entry_over_exit(cos_start) / sample.pdf_solid;
    }
    v.beta *= sample.weight * walk.weight();
    v.mis = mis.exit(v.mis, sample.pdf_reverse, usable(ratio));
    v.passage = {sample.direction, ratio * sample.pdf_solid};
    if (!passes) {
      for (Lobe& l : bsdf.lobes()) {
        l.pmf_normal = l.pmf_grazing = 0.0f;  // of light walks that go below
      }
    }
    if (bsdf.by_path()) {
      v.mis.a.merge = 0.0f;
    }
    bsdf.set_kind(VertexKind::SubsurfaceExit);
  } else {
    if (!other) {
      return false;
    }
    const auto reverse = walk.reverse(*other, upper_normal(v.hit, arrival));
    const double ratio = reverse.pdf_ratio / entry_over_exit(cos_end) / sample.pdf_solid;
    v.beta *= sample.weight * reverse.weight;
    v.mis = mis.entry(v.mis, sample.pdf_reverse, usable(ratio));
    v.passage = {-arrival, 1.0 / (ratio * sample.pdf_solid)};
    for (Lobe& l : bsdf.lobes()) {
      if (l.type == LobeType::Subsurface) {
        l.edge = -arrival;
      }
    }
    bsdf.set_kind(VertexKind::SubsurfaceEntry);
  }
  v.reshading.program = nullptr;
  v.back = arrival;  // on the upper side
  return is_finite(v.beta) && !is_black(v.beta);
}

}  // namespace janus
