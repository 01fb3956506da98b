// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "janus/scene/description.h"

namespace janus {

// Finite, and not so flat or small that no ray meets it?
bool is_placement(const mat4& m);

// Throws SceneError for a camera that sees nothing, or cannot be.
void check_camera(const CameraDesc& camera);

}  // namespace janus
