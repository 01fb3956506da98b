// SPDX-License-Identifier: GPL-3.0-or-later
//
// The deterministic ends of the techniques: next event estimation (s=1), vertex connections
// (s,t >= 2) and the connection to the camera (t=1). Each returns its contribution for one sample
// of count 1, with `weight` apart so that a technique can also be seen alone; visibility is left
// to the caller's ray.
#pragma once

#include <optional>

#include "janus/path/subpath.h"

namespace janus {

struct Connection {
  Rgb value;
  float weight;
  vec3 from, to;  // shadow ray, both ends off their surfaces
};

// A light vertex as the cache keeps it.
struct LightVertex {
  vec3 p, ng;
  float offset;
  vec3 wi;
  Rgb beta;
  MisState mis;
  uint32_t first_lobe;
  uint16_t lobe_count, edges;
};

struct LightConnection {
  Connection connection;
  LightEnd end;
};
std::optional<LightConnection> connect_to_light(const Scene& scene, const PathVertex& camera_vertex,
                                                const Mis& mis, Sampler& sampler);

std::optional<Connection> connect_vertices(const LightVertex& light_vertex, BsdfView light_bsdf,
                                           const PathVertex& camera_vertex, const Mis& mis);

struct CameraSplat {
  Connection connection;
  vec2 raster;
};
std::optional<CameraSplat> connect_to_camera(const PathVertex& light_vertex, const Camera& camera,
                                             vec2 u_lens, float margin, const Mis& mis);

}  // namespace janus
