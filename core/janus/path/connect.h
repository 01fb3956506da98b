// SPDX-License-Identifier: GPL-3.0-or-later
//
// The deterministic ends of the techniques: next event estimation (s=1), vertex connections
// (s,t >= 2), the connection to the camera (t=1) and the merging of vertices. Each returns its
// contribution for one sample of count 1, with `weight` apart so that a technique can also be seen
// alone; visibility is left to the caller's ray. The rules of path/rules.h are in the value.
#pragma once

#include <optional>

#include "janus/path/roulette.h"
#include "janus/path/subpath.h"

namespace janus {

struct Connection {
  Rgb value;
  MisWeight weight;
  vec3 from, to;  // shadow ray, both ends off their surfaces
  RayType type;   // what it is on the path
  int crossings;  // of transparent surfaces that the path has so far
  // For the connections that roulette has ended: a factor beside `value`, because clamping does not
  // act on it.
  float made_up = 1.0f;
  Scene::End camera = Scene::End::A;  // which end of the ray is on the side of the camera
  PathSoFar path = {};                // as it leads to that end, if PathRules::by_path
  // What the ray lets through, where that had to be known before: the weight depends on it.
  std::optional<Rgb> through = {};
  bool by_path = false;  // and that depends on the path (PathVertex::by_path)

  // What arrives over it, if it may cross so many surfaces.
  Rgb transmittance(const Scene& scene, int max_crossings) const {
    return through ? *through : scene.transmittance(from, to, type, max_crossings, camera, &path);
  }
};

// A light vertex as the cache keeps it.
struct LightVertex {
  vec3 p, ng, ns;
  float offset;
  vec3 wi;
  Rgb beta;
  MisState mis;
  float bound;  // max |beta| times the peak of the BSDF
  uint32_t instance, first_state;
  uint32_t pixel;  // PathVertex::pixel
  uint32_t first_lobe;
  int32_t reshading;  // in the cache, if the lobes depend on the view; -1: they do not
  uint16_t edges, crossings, max_edges;
  BounceCounts bounces;
  uint8_t state_count;
  uint8_t lobe_count : 4;
  uint8_t transmits : 1;
  uint8_t hidden : 1, held : 1;  // PathVertex::hidden, held
  uint8_t entry : 1;             // VertexKind::SubsurfaceEntry
  // Labels: which the vertex may have (z_1: which see the light), and which see its object.
  uint8_t labels : 3, seen_by : 3;

  LightVertex() = default;
  // Of a subpath's vertex; lobes and states are the cache's business.
  explicit LightVertex(const PathVertex& v);
};

struct LightConnection {
  Connection connection;
  size_t light;
  LightEnd end;
};
// Here and below: `unread`, if there is one, gets the vertices where the path was joined.
std::optional<LightConnection> connect_to_light(const Scene& scene, const PathVertex& camera_vertex,
                                                const Mis& mis, const PathRules& rules,
                                                Sampler& sampler, UnreadVertices* unread = nullptr);

// `scale` is the estimator's factor for one connection; `roulette` plays on a bound of the
// contribution before the BSDFs are evaluated.
std::optional<Connection> connect_vertices(const Scene& scene, const LightVertex& light_vertex,
                                           BsdfView light_bsdf, const PathVertex& camera_vertex,
                                           const Mis& mis, const PathRules& rules, float scale,
                                           const Roulette& roulette, Sampler& sampler,
                                           Counters& counters, UnreadVertices* unread = nullptr);

// A light vertex behind z_1 and a camera vertex at about the same place taken as one (vertex
// merging, Georgiev et al. 2012). `scale`: 1 / (pi r^2) over the number of light paths, where r is
// how far apart they may be. Blurs the light that falls on the surface by as much.
struct Merge {
  Rgb value;
  MisWeight weight;
};
std::optional<Merge> merge_vertices(const LightVertex& light_vertex,
                                    const PathVertex& camera_vertex, const Mis& mis,
                                    const PathRules& rules, float scale,
                                    UnreadVertices* unread = nullptr);

struct CameraSplat {
  Connection connection;
  vec2 raster;
  CameraEnd end;
};
std::optional<CameraSplat> connect_to_camera(const PathVertex& light_vertex, const Camera& camera,
                                             vec2 u_lens, float margin, const Mis& mis,
                                             const PathRules& rules,
                                             UnreadVertices* unread = nullptr);

}  // namespace janus
