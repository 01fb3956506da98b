// SPDX-License-Identifier: GPL-3.0-or-later
//
// Blender's light objects and the world. Lamps do not block light and are not surfaces.
#pragma once

#include <memory>

#include "janus/light/light.h"
#include "janus/scene/description.h"

namespace janus {

// `strength` multiplies the light's colour (its node tree; white without one).
std::unique_ptr<Light> make_point_light(const LightDesc& desc, Rgb strength);
std::unique_ptr<Light> make_area_light(const LightDesc& desc, Rgb strength);

// A world of constant radiance around a scene with the given bounding sphere.
std::unique_ptr<Light> make_environment_light(Rgb radiance, vec3 center, float radius);

// Colour times power of a lamp, in watts.
inline Rgb lamp_power(const LightDesc& desc, Rgb strength) {
  return desc.color * strength * (desc.energy * std::exp2(desc.exposure));
}

}  // namespace janus
