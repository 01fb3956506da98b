// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "janus/scene/ray_type.h"

namespace janus {

// The tree of a world or a lamp, as rays of one type see it: the camera, or a label.
struct EmitterTree {
  RayType ray;
  bool lamp;
};

}  // namespace janus
