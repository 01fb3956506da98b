// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "janus/scene/ray_type.h"

namespace janus {

// A tree as rays of one type see it.
struct SeenTree {
  enum class Of { Surface, World, Lamp };

  Of of;
  RayType ray;
};

// For trees that do not ask.
inline constexpr SeenTree kAnySurface{SeenTree::Of::Surface, RayType::Diffuse};

}  // namespace janus
