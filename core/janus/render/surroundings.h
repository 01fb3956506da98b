// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the surfaces of a scene are, at one time or another.
#pragma once

#include "janus/render/scene.h"

namespace janus {

// Around all of them. Needs Scene::accel.
Bounds surroundings(const Scene& scene);

// Can one of them lie within the lamp's radius?
bool surfaces_near(const Scene& scene, const LightDesc& lamp);

}  // namespace janus
