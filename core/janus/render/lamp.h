// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "janus/light/lamps.h"
#include "janus/scene/description.h"
#include "janus/scene/diagnostics.h"
#include "janus/shading/compiler.h"

namespace janus {

// What lamps have to know of a scene.
struct LampSurroundings {
  CameraView camera;
  SceneBox scene;                                       // around all surfaces
  std::function<bool(const LightDesc&)> surfaces_near;  // within the lamp's radius?
};

// The lights that a light object is: one for each answer where its tree asks by what rays it is
// seen (Light Path), each visible to those alone; else one, or none if it is black or cannot shine.
// What cannot be rendered as asked becomes a Diagnostic.
std::vector<std::unique_ptr<Light>> make_lamp(LightDesc lamp, const ImageMap& images,
                                              const LampSurroundings& around,
                                              Diagnostics& diagnostics);

}  // namespace janus
