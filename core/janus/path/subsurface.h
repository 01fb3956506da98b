// SPDX-License-Identifier: GPL-3.0-or-later
//
// Walks below a surface as a part of subpaths. Entry and exit (shading/subsurface.h) are one vertex
// z_i, which stands at the entry for what is on the camera's side and at the exit for what is on
// the light's. A walk that goes below has two turns at it: at the end where it arrives, whose other
// lobes may be joined, and at that where it comes up. What lies between is part of the density with
// which it makes z_i; PF_i and PR_i of path/mis.h are those of the whole.
#pragma once

#include "janus/path/vertex.h"
#include "janus/sampling/sampler.h"

namespace janus {

// Takes the walk that goes below the surface at `v`, as it has drawn `sample`, to the other end of
// that vertex, which is written to `v`. False: it does not come up there.
bool come_up(const Scene& scene, const Mis& mis, const BsdfSample& sample, TransportMode mode,
             bool roulette, const Sampler& sampler, uint64_t& rays, PathVertex& v);

}  // namespace janus
