// SPDX-License-Identifier: GPL-3.0-or-later
//
// A scene that one projector lights, for the light transport matrix.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "janus/light/projector.h"
#include "janus/render/scene.h"

namespace janus {

// The lamp called `name` as a projector of so many pixels. Throws SceneError: see projector_of(),
// and (name, "projector", ...) if there is not exactly one such lamp.
ProjectorDesc find_projector(const Scene& scene, const std::string& name, int width, int height);

// The scene, with which the result shares nearly all, lit by nothing but the projector. Surfaces do
// not shine, the world is black, and shadow catchers are ordinary objects.
std::shared_ptr<const Scene> under_projector(const std::shared_ptr<const Scene>& scene,
                                             const ProjectorDesc& projector);

// Watts that the lamp emits into each pixel of the projector, row by row from the bottom: as it is
// in the scene, with its node tree, and without that. Throws SceneError(name, "node_tree", ...) for
// light that depends on the distance.
struct LampWatts {
  std::vector<Rgb> own, plain;
};
LampWatts lamp_watts(const Scene& scene, const ProjectorDesc& projector);

}  // namespace janus
