// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "janus/integrator/camera_trace.h"
#include "janus/render/shadows_ahead.h"

namespace janus {

// A walk of the path tracer between two vertices.
struct CameraWalk {
  Ray ray;               // from the last vertex
  Receiver previous;     // that vertex
  vec3 origin;           // where the present segment starts: there, or at the last crossing
  float t_begin = 0.0f;  // its distance along the ray
  float pdf_solid = 0.0f;
  bool delta = true;  // no next event estimation has looked for the light ahead
  int edges = 1, crossings = 0;
  Rgb beta = Rgb(1.0f);
  std::array<int, 3> bounces{};  // diffuse, glossy, transmission
  RayType type = RayType::Camera;
  // Of the scattering at the last vertex: the shares of diffuse lobes and of the others, and
  // whether it was to the other side.
  Rgb diffuse = Rgb(0.0f), rest = Rgb(1.0f);
  bool transmitted = false;
  // The camera has seen nothing so far but transparent surfaces and clear glass.
  bool clear = true;
  // Where it looks for lights with the rules of shadow rays: what lets them through so far.
  const ShadowsAhead* shadows = nullptr;
  bool looks = false;            // PathSoFar::looks
  CameraTrace* trace = nullptr;  // without light path expressions: none
  std::span<Rgb> layers{};       // of the pixel
  bool caught = false;           // the camera has seen a shadow catcher

  bool beyond(const BounceCaps& caps) const {
    for (int i = 0; i < 3; ++i) {
      if (bounces[i] > caps[i]) {
        return true;
      }
    }
    return false;
  }

  // As it comes to what is on its ray.
  PathSoFar path(float length = 0.0f) const {
    PathSoFar path;
    path.ray_length = length;
    path.depth = static_cast<uint16_t>(edges - 1);
    path.crossings = static_cast<uint16_t>(crossings);
    for (int i = 0; i < 3; ++i) {
      path.bounces.of[i] = static_cast<uint16_t>(bounces[i]);
    }
    if (looks) {
      --path.bounces.of[static_cast<int>(type)];
      path.looks = true;
      path.last = type;
    }
    return path;
  }
};

// What a light may add of what diffuse lobes scatter, and of the rest.
inline Rgb seen(const Light& light, Rgb diffuse, Rgb rest, bool transmitted) {
  const RayType other = transmitted ? RayType::Transmission : RayType::Glossy;
  return (contains(light.visibility, RayType::Diffuse) ? diffuse : Rgb(0.0f)) +
         (contains(light.visibility, other) ? rest : Rgb(0.0f));
}

// By channel.
inline Rgb share(Rgb part, Rgb whole) {
  Rgb result(0.0f);
  for (int c = 0; c < 3; ++c) {
    result[c] = part[c] > 0.0f ? part[c] / whole[c] : 0.0f;
  }
  return result;
}

// Lobes that reflect into one direction share it.
inline RayType label(Rgb value, Rgb diffuse_part, bool transmitted, Sampler& sampler) {
  if (transmitted) {
    return RayType::Transmission;
  }
  const float diffuse = is_black(diffuse_part) ? 0.0f : average(diffuse_part) / average(value);
  return diffuse > 0.0f && sampler.next_1d() < diffuse ? RayType::Diffuse : RayType::Glossy;
}

}  // namespace janus
