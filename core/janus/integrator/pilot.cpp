// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/integrator/pilot.h"

#include <array>

#include "janus/integrator/vertex_grid.h"

namespace janus {

namespace {

constexpr size_t kPaths = 4096, kBlocks = 16;

}  // namespace

CachedPath measure_cached_path(const RenderContext& context, const IntegratorSettings& settings,
                               const Mis& mis, bool merging) {
  std::array<CacheBlock, kBlocks> caches;
  context.pool.parallel_for(kBlocks, [&](size_t block) {
    context.cancel.throw_if_cancelled();
    Counters ignored;
    for (size_t i = 0; i < kPaths / kBlocks; ++i) {
      Sampler sampler(settings.seed, Stream::Pilot, 0, block * (kPaths / kBlocks) + i);
      trace_light_subpath(context.scene(), mis, settings.walk, sampler, ignored,
                          [&](const PathVertex& v, Sampler&) {
                            if (worth_caching(v, merging)) {
                              caches[block].add(v);
                            }
                          });
    }
  });
  size_t vertices = 0, bytes = 0;
  for (const CacheBlock& c : caches) {
    vertices += c.vertices.size();
    bytes += c.bytes();
  }
  if (merging) {
    bytes += vertices * VertexGrid::kBytesPerVertex;
  }
  return {static_cast<float>(vertices) / kPaths, static_cast<double>(bytes) / kPaths};
}

}  // namespace janus
