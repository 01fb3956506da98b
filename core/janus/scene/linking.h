// SPDX-License-Identifier: GPL-3.0-or-later
//
// Light linking: lights that shine on some objects only, and that only some stand in the way of.
// Lights with the same receivers are a set, by number; an object knows the sets that do not light
// it. Likewise for shadows, where the set gives the light's shadow rays a type of their own.
#pragma once

#include <cstdint>

#include "janus/scene/ray_type.h"

namespace janus {

// Sets of lights, as bits.
using LinkMask = uint64_t;
inline constexpr int kMostLinkSets = 63;  // the last bit is that of lights that shine on all
inline constexpr LinkMask kLightsAll = ~LinkMask{0};

// Of an object or a light object that shines; -1: on everything, or stopped by everything.
struct EmitterLinks {
  int receivers = -1, blockers = -1;
};

// Of any object.
struct ReceiverLinks {
  LinkMask unlit_by = 0;   // sets of receivers that it is not in
  LinkMask lets_pass = 0;  // sets of blockers that it is not in
};

constexpr LinkMask link_bit(int set) { return set < 0 ? kLightsAll : LinkMask{1} << set; }

// Does something with these links shine on what is not lit by `unlit_by`?
constexpr bool shines_on(LinkMask links, LinkMask unlit_by) { return (links & ~unlit_by) != 0; }

}  // namespace janus
