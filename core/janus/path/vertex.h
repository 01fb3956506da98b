// SPDX-License-Identifier: GPL-3.0-or-later
//
// The vertices of subpaths, and what every walk does at one.
#pragma once

#include <algorithm>

#include "janus/camera/camera.h"
#include "janus/path/match.h"
#include "janus/path/mis.h"
#include "janus/path/rules.h"
#include "janus/render/scene.h"

namespace janus {

// The light's end of a path: J and pN of path/mis.h.
struct LightEnd {
  float joint = 0.0f, pdf_nee = 0.0f;
  bool hittable = false;
  vec3 wi = vec3(0.0f);  // unit, from z_1 to z_0
};

// The camera's end of a path.
struct CameraEnd {
  vec3 lens = vec3(0.0f);  // z_k
  PixelDensity density;
};

// How a walk left a vertex (see BsdfSample).
struct Departure {
  bool delta = false;
  float pdf_solid = 0.0f, pdf_reverse = 0.0f;
};

// The way below the surface between the ends of a vertex (path/subsurface.h): its direction at the
// entry, and the densities of light walks over those of camera walks, apart from how these go
// below.
struct Passage {
  vec3 below = vec3(0.0f);
  double light_over_camera = 0.0;
};

// A scattering vertex of a subpath.
struct PathVertex {
  SurfaceInteraction hit;
  ShadingResult shading;  // as seen from where the walk comes
  Reshading reshading;
  vec3 back;  // unit direction to the previous vertex: wi on light, wo on camera subpaths
  Rgb beta;   // light: flux that arrives; camera: throughput
  MisState mis;
  int edges;                   // from the start of the subpath
  int crossings;               // of transparent surfaces since the start of the subpath
  BounceCounts bounces;        // at the vertices before this one, if PathRules::counts() or by_path
  PathTrace* trace = nullptr;  // of all before it; null without PathRules::expressions
  Departure previous;          // how the walk left the vertex before (edges > 1)
  RayMask visibility = kAllRays;  // of its object, if PathRules::ray_types
  // Light subpaths, if PathRules::ray_types: what sees the light, and the types that were drawn for
  // the segment that led here. The vertex has to turn out to be of one of them.
  RayMask source = kAllRays, segment = kAllRays;
  // Of clear views. Camera subpaths: the view to this vertex is clear. Light subpaths: a clear view
  // to this vertex and beyond does not show what lies beyond; it does not show the vertex.
  bool clear = true, hidden = false, held = false;
  // If PathRules::catchers (path/catching.h). Camera subpaths: the path belongs to a shadow
  // catcher. Light subpaths: it does if the camera sees this vertex.
  bool caught = false;
  // Camera subpaths: what lets the segment through that leads here depends on the path, so that no
  // light subpath comes over it (path/flight.h).
  bool by_path = false;
  int max_edges;       // light subpaths: of the whole path, with this vertex no delta if it is z_1
  LightEnd light_end;  // light subpaths: their start
  uint32_t pixel = 0;  // light subpaths: Light::pixel() of their start
  CameraEnd camera_end;  // camera subpaths: theirs
  Passage passage;       // of a SubsurfaceEntry or SubsurfaceExit

  BsdfView bsdf() const {
    return shading.bsdf.view(hit.ng, shading.ns, reshading.program ? &reshading : nullptr);
  }

  // Camera subpaths: the path as it comes to this vertex over `length`, and as it comes to what
  // lies behind it if this vertex gets `label`.
  PathSoFar path(float length) const {
    PathSoFar path;
    path.ray_length = length;
    path.depth = static_cast<uint16_t>(edges - 1);
    path.bounces = bounces;
    path.crossings = static_cast<uint16_t>(crossings);
    return path;
  }
  PathSoFar path_beyond(RayType label) const {
    PathSoFar beyond = path(0.0f);
    ++beyond.depth;
    beyond.bounces = bounces.with(label);
    return beyond;
  }

  // The labels that a vertex of a light subpath may have; `delta`: it scatters by a delta.
  RayMask possible_labels(bool delta) const {
    if (edges > 1 || delta) {
      return segment & kLabels;
    }
    return (segment & kShadowRays) != 0 ? kLabels : 0;
  }
};

// Survival probability of a walk. It divides the throughput and appears in no density.
inline float survival(Rgb throughput, float eta_scale, int bounces) {
  constexpr int kStart = 3;
  if (bounces < kStart) {
    return 1.0f;
  }
  return std::clamp(max_component(throughput) / eta_scale, 0.05f, 1.0f);
}

}  // namespace janus
