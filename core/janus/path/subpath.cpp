// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/path/subpath.h"

namespace janus {

void read_event(const PathVertex& v, const BsdfSample& sample, TransportMode mode,
                const WalkSettings& settings, const Sampler& sampler, RayType label) {
  const bool importance = mode == TransportMode::Importance;
  const UnreadVertex vertex{v.hit.instance, ScatterShares::sampled(sample)};
  ScatterShares read = vertex.shares;
  if (settings.ray_types) {  // what comes next was met by this label
    read = importance && v.edges == 1 ? read.lit(v.source) : read.labelled(label);
  }
  const PathAutomaton& automaton = *settings.expressions;
  v.trace->go_on(
      vertex, read, v.edges,
      [&](PathAutomaton::State state, int event, uint32_t instance) {
        return importance ? automaton.forward(state, event, instance)
                          : automaton.reverse(state, event, instance);
      },
      sampler);
}

}  // namespace janus
