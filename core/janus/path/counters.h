// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace janus {

// What a render did. Workers fill their own and add them up, in any order.
struct Counters {
  uint64_t camera_paths = 0, light_paths = 0;
  uint64_t camera_rays = 0, light_rays = 0;                    // walks
  uint64_t nee_rays = 0, connection_rays = 0, splat_rays = 0;  // shadow rays
  // Connections: picked from the cache; with both ends facing; not ended by roulette on the bound;
  // with a value. What is left after roulette on the value is connection_rays.
  uint64_t connections = 0, connections_facing = 0, connections_evaluated = 0;
  uint64_t nee_samples = 0, splats = 0;  // with a value, before roulette
  uint64_t light_vertices = 0;           // cached
  uint64_t dropped = 0;                  // contributions not finite

  Counters& operator+=(const Counters& o) {
    camera_paths += o.camera_paths;
    light_paths += o.light_paths;
    camera_rays += o.camera_rays;
    light_rays += o.light_rays;
    nee_rays += o.nee_rays;
    connection_rays += o.connection_rays;
    splat_rays += o.splat_rays;
    light_vertices += o.light_vertices;
    connections += o.connections;
    connections_facing += o.connections_facing;
    connections_evaluated += o.connections_evaluated;
    nee_samples += o.nee_samples;
    splats += o.splats;
    dropped += o.dropped;
    return *this;
  }
};

}  // namespace janus
