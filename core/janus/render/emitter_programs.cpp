// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/render/emitter_programs.h"

#include "janus/shading/closures.h"

namespace janus {

void add_seen(std::vector<SeenProgram>& programs, RayType ray, Program program) {
  const auto same = std::ranges::find_if(
      programs, [&](const SeenProgram& seen) { return seen.program.emits_like(program); });
  if (same != programs.end()) {
    same->seen_by |= ray_bit(ray);
  } else {
    programs.push_back({ray_bit(ray), std::move(program)});
  }
}

bool scatters(const Program& program) {
  const auto scatters = [](const Closure& c) { return c.decl->traits.lobes > 0; };
  return !program.lobes.empty() || std::ranges::any_of(program.closures, scatters);
}

}  // namespace janus
