// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "janus/light/lamps.h"
#include "janus/scene/description.h"
#include "janus/scene/diagnostics.h"
#include "janus/shading/compiler.h"
#include "janus/util/cancel.h"

namespace janus {

// The lights that a world is: none where it is black, one for each answer where its tree asks by
// what rays it is seen (Light Path), each visible to those alone; else one. What cannot be rendered
// as asked becomes a Diagnostic.
std::vector<std::unique_ptr<Light>> make_world(const WorldDesc& world, const ImageMap& images,
                                               const CameraView& camera, const SceneBox& scene,
                                               Diagnostics& diagnostics, const CancelToken& cancel);

}  // namespace janus
