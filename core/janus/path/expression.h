// SPDX-License-Identifier: GPL-3.0-or-later
//
// Light path expressions: classes of light paths in Heckbert's notation (Heckbert 1990), as text.
//
//   L  a light        D  a diffuse event      R  a reflection       .  any event
//   E  the eye        G  a glossy event       T  a transmission
//                     S  a specular event
//   k+ one or more    k* none or more         k? none or one        (k|h)  one of both
//
//   <SR'Mirror'>      one event that is all of that: specular, a reflection, at the object Mirror
//   D'Wall'  'Wall'   a diffuse event, or any, at the object
//   L'Lamp'  L{Key}   the light (or the object that shines, or the world) of that name; those of a
//                     light group
//   B  O              the background; all other lights
//   'Bob\'s'          a backslash before a character that would end the name
//
// An expression is read from the light to the eye. `^` before an operator and spaces mean nothing,
// so that LS^+DE can be typed as it is printed.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "janus/path/label.h"

namespace janus {

// What one symbol of an expression asks of a vertex.
struct VertexPattern {
  enum class Kind : uint8_t { Light, Event, Eye };
  Kind kind = Kind::Event;
  ScatterMask events = kAllScattering;     // Event: what it may be
  bool background = true, objects = true;  // Light: may it be the world; anything else
  std::string name;                        // of the light or the object; empty: any
  std::string group;                       // Light: of the light group; empty: any
};

// Glushkov's automaton of an expression: reading its symbol i takes it to state i. No step is
// empty, so that it can be run in both directions.
struct Expression {
  std::vector<VertexPattern> symbols;
  std::vector<int> first;                // the symbols that a path may begin with, all lights
  std::vector<std::vector<int>> follow;  // by symbol: what may come next
};

// Throws Error, whose message tells the user what is wrong and where.
Expression parse_expression(std::string_view text);

}  // namespace janus
