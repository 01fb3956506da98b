// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/path/subpath.h"

namespace janus {

void read_event(const PathVertex& v, const BsdfSample& sample, TransportMode mode,
                const WalkSettings& settings, Sampler sampler, RayType label) {
  constexpr uint32_t kBlock = 1 << 20;  // far beyond those of vertices
  sampler.start_block(kBlock + static_cast<uint32_t>(v.edges));
  const bool importance = mode == TransportMode::Importance;
  PathTrace& trace = *v.trace;
  trace.vertex = {v.hit.instance, ScatterShares::sampled(sample)};
  trace.before = trace.states;
  UnreadVertex vertex = trace.vertex;
  if (settings.ray_types) {  // what comes next was met by this label
    vertex.shares =
        importance && v.edges == 1 ? vertex.shares.lit(v.source) : vertex.shares.labelled(label);
  }
  const PathAutomaton& automaton = *settings.expressions;
  trace.states = trace.before.after(
      vertex,
      [&](PathAutomaton::State state, int event, uint32_t instance) {
        return importance ? automaton.forward(state, event, instance)
                          : automaton.reverse(state, event, instance);
      },
      sampler);
}

}  // namespace janus
