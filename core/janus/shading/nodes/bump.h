// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "janus/shading/operation.h"

namespace janus {

// What Bump does: of strength, distance, width in pixels, the height at the point and at the two
// beside it, and a normal. `data`: 1, the height is a depth.
extern const Operation kBump;

}  // namespace janus
