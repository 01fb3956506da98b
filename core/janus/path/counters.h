// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <initializer_list>

namespace janus {

// What a render did. Workers fill their own and add them up, in any order.
struct Counters {
  uint64_t camera_paths = 0, light_paths = 0;
  uint64_t camera_rays = 0, light_rays = 0;                    // walks
  uint64_t specular_walks = 0, specular_rays = 0;              // more of the camera's, in no other
  uint64_t nee_rays = 0, connection_rays = 0, splat_rays = 0;  // shadow rays
  // Connections: picked from the cache; with both ends facing; not ended by roulette on the bound;
  // with a value. What is left after roulette on the value is connection_rays.
  uint64_t connections = 0, connections_facing = 0, connections_evaluated = 0;
  uint64_t nee_samples = 0, splats = 0;  // with a value, before roulette
  uint64_t merges = 0;                   // with a value
  uint64_t light_vertices = 0;           // cached
  uint64_t dropped = 0;                  // contributions not finite

  Counters& operator+=(const Counters& o) { return combine(o, 1); }
  Counters& operator-=(const Counters& o) { return combine(o, -1); }

 private:
  Counters& combine(const Counters& o, int sign);
};

inline Counters& Counters::combine(const Counters& o, int sign) {
  for (const auto field :
       {&Counters::camera_paths, &Counters::light_paths, &Counters::camera_rays,
        &Counters::light_rays, &Counters::specular_walks, &Counters::specular_rays,
        &Counters::nee_rays, &Counters::connection_rays, &Counters::splat_rays,
        &Counters::connections, &Counters::connections_facing, &Counters::connections_evaluated,
        &Counters::nee_samples, &Counters::splats, &Counters::merges, &Counters::light_vertices,
        &Counters::dropped}) {
    this->*field += static_cast<uint64_t>(sign) * o.*field;
  }
  return *this;
}

}  // namespace janus
