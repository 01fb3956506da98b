// SPDX-License-Identifier: GPL-3.0-or-later
//
// A lamp as a projector: a film of pixels that shines through a pinhole (a spot light) or straight
// ahead (an area light without spread). It is a camera turned round, with the same measures: each
// pixel emits its light evenly over its part of the film, as a camera's pixel gathers it. So the
// transpose of the light transport matrix needs no factor (Sen et al. 2005, section 3).
#pragma once

#include <memory>
#include <string>

#include "janus/light/light.h"

namespace janus {

struct ProjectorDesc {
  LightDesc lamp;         // its name, and what it shines on
  bool parallel = false;  // straight ahead along -z; otherwise from `center`
  vec3 center = vec3(0.0f);
  mat3 rotation = mat3(1.0f);  // its unit axes, to world; the picture is upright along +y
  // The film: on the plane at distance 1 in front of the pinhole, or in metres. What a lamp's UV
  // coordinates are 0 and 1 at.
  vec2 low = vec2(-1.0f), high = vec2(1.0f);
  int width = 0, height = 0;  // pixels, the first at the bottom left

  float pixel_area() const { return (high.x - low.x) * (high.y - low.y) / (1.0f * width * height); }
};

// The frame of a lamp with so many pixels. Throws SceneError(name of the lamp, setting, message)
// for lamps that are none: suns, points, with a radius or a spread, or sheared.
ProjectorDesc projector_of(const LightDesc& lamp, int width, int height);

// All pixels shine with one watt each, in every channel. A perspective one has the radiant
// intensity 1 / (a cos^3) W/sr in a pixel whose area on the film is `a`; a parallel one the
// irradiance 1 / a.
std::unique_ptr<Light> make_projector(const ProjectorDesc& desc);

// Does its node tree make more or less of `light`, made of that lamp, the farther it goes? Then no
// pixel has watts of its own. Looks at some of its places.
bool depends_on_distance(const ProjectorDesc& desc, const Light& light);

// What `light`, made of that lamp, emits into each pixel: watts by channel, row by row from the
// bottom; by samples in each pixel.
std::vector<Rgb> watts_by_pixel(const ProjectorDesc& desc, const Light& light);

}  // namespace janus
