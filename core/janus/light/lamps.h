// SPDX-License-Identifier: GPL-3.0-or-later
//
// Blender's light objects and the world. Lamps do not block light and are not surfaces.
#pragma once

#include <memory>

#include "janus/light/environment_map.h"
#include "janus/light/light.h"
#include "janus/light/program_sky.h"
#include "janus/light/scene_box.h"
#include "janus/scene/description.h"

namespace janus {

// `strength` multiplies the light's colour (its node tree; white without one).
// Point and spot lights. `inside`: surfaces lie within its radius.
std::unique_ptr<Light> make_point_light(const LightDesc& desc, Rgb strength, bool inside = false);
std::unique_ptr<Light> make_area_light(const LightDesc& desc, Rgb strength);

std::unique_ptr<Light> make_sun_light(const LightDesc& desc, Rgb strength, const SceneBox& scene);

// A world of constant radiance, of a picture, or of a program, and a sun of the last.
std::unique_ptr<Light> make_environment_light(Rgb radiance, const SceneBox& scene);
std::unique_ptr<Light> make_environment_light(EnvironmentMap map, const SceneBox& scene);
std::unique_ptr<Light> make_environment_light(ProgramSky sky, const SceneBox& scene);
std::unique_ptr<Light> make_environment_light(SkySun sun, const SceneBox& scene);

// Colour times power of a lamp, in watts.
inline Rgb lamp_power(const LightDesc& desc, Rgb strength) {
  return desc.color * strength * (desc.energy * std::exp2(desc.exposure));
}

}  // namespace janus
