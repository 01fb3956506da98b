// SPDX-License-Identifier: GPL-3.0-or-later
//
// The surroundings as the program of a world's node tree says them, and their importance sampling.
#pragma once

#include "janus/light/environment_map.h"
#include "janus/shading/program.h"
#include "janus/util/cancel.h"

namespace janus {

// What the program of a world knows of objects: there is none.
ObjectData no_object(const CameraView& camera);
// The point where Cycles runs it: `direction`, of a sphere that looks inwards.
ShadingPoint sky_point(vec3 direction, const ObjectData& surroundings);

class ProgramSky {
 public:
  // `sampled`: light is looked for in it, so that its brightness is measured first, which may take
  // a while; else it shines to the camera alone. Throws Cancelled.
  ProgramSky(Program program, const CameraView& camera, bool sampled, const CancelToken& cancel);

  // Runs the program.
  Rgb radiance(vec3 direction) const;

  // A direction, drawn with pdf_solid(). That is constant in each cell of a grid, near the cell's
  // mean luminance, and positive everywhere: what the program hides from the grid is found, too.
  vec3 sample(vec2 u) const { return map_.sample(u); }
  float pdf_solid(vec3 direction) const { return map_.pdf_solid(direction); }

  // The integral of the luminance over all directions (an estimate by cells).
  float total() const { return map_.total(); }

 private:
  EnvironmentMap measure(bool sampled, const CancelToken& cancel) const;

  Program program_;
  ObjectData surroundings_;
  EnvironmentMap map_;
};

}  // namespace janus
