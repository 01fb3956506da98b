// SPDX-License-Identifier: GPL-3.0-or-later
//
// What bdpt asks before its first pass.
#pragma once

#include "janus/integrator/integrator.h"
#include "janus/integrator/vertex_cache.h"

namespace janus {

// A vertex that no camera vertex may join within the length limit is not worth its place in the
// cache. `merging`: a merge adds one edge, a connection two; and what comes up from below a surface
// may be merged with light that falls there.
inline bool worth_caching(const PathVertex& v, bool merging) {
  const auto lets_below = [](const Lobe& lobe) { return lobe.type == LobeType::Subsurface; };
  const BsdfView bsdf = v.bsdf();
  return (bsdf.connectible() || (merging && std::ranges::any_of(bsdf.lobes(), lets_below))) &&
         v.edges + (merging ? 1 : 2) <= v.max_edges && v.possible_labels(false) != 0;
}

// What a light path leaves in the cache, as a mean.
struct CachedPath {
  float vertices = 0.0f;
  double bytes = 0.0;
};

// From some thousand light paths of their own. The weights need the number of vertices before a
// pass: with the pass's own count, weight and estimate would be correlated.
CachedPath measure_cached_path(const RenderContext& context, const IntegratorSettings& settings,
                               const Mis& mis, bool merging);

}  // namespace janus
