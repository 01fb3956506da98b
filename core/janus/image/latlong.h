// SPDX-License-Identifier: GPL-3.0-or-later
//
// Equirectangular pictures of the surroundings as Blender lays them out: the middle looks along +x,
// the top along +z, and +y is to the left.
#pragma once

#include "janus/math/vec.h"

namespace janus {

// u and v in [0, 1] from the bottom left.
vec2 direction_to_latlong(vec3 direction);

// The direction of a column `u`, given its z. Double precision: directions close to the poles are
// told apart by their z.
vec3 latlong_to_direction(double u, double z);

// The other mapping of Blender's, of textures on a sphere and of point lights: v as above, u turned
// by a quarter and the other way round. The poles, and no direction at all, have a u of 0.
vec2 direction_to_sphere(vec3 direction);

// z of the directions with the given v.
double latlong_z(double v);

}  // namespace janus
