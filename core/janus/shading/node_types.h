// SPDX-License-Identifier: GPL-3.0-or-later
//
// The one table of shader node types. The compiler, the Python bindings and the documentation read
// it; a node that is not in it is named as unsupported.
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "janus/math/vec.h"

namespace janus {

class ClosureArguments;
class NodeEmitter;
class NodeReader;
struct ShadingResult;

enum class SocketType { Float, Vector, Color, Closure };

// Does a value of the type take three numbers?
constexpr bool is_vector(SocketType type) { return type != SocketType::Float; }

// What an input without a link and without a value gets.
enum class Implicit {
  Value,   // the default of the declaration
  Normal,  // the shading normal, on the viewer's side
  Uv,      // the active UV map
  Position,
  Generated,  // texture space: of a world the direction, of a lamp the place in its space
  Along,      // on curves, their direction; elsewhere the first edge of the triangle
  Beside,     // the same, but elsewhere the second edge
  OnCurve,    // 1 on curves, else 0
  Tangent,    // around the object's Z axis, where the closure has facets of two widths
  Beam,       // in the space of the object, the direction to who looks: of lamps, their light's
  Strand,     // a number of the curve's own, in [0, 1]; elsewhere the default
};

struct SocketDecl {
  std::string_view identifier;
  SocketType type;
  vec3 value = vec3(0.0f);  // when the graph omits the input
  Implicit implicit = Implicit::Value;
  // Bump compares its height here with that at two points beside.
  bool shifted = false;

  constexpr SocketDecl(std::string_view id, SocketType t, float x = 0.0f)
      : identifier(id), type(t), value(x) {}
  constexpr SocketDecl(std::string_view id, SocketType t, vec3 v)
      : identifier(id), type(t), value(v) {}
  constexpr SocketDecl(std::string_view id, SocketType t, Implicit i)
      : identifier(id), type(t), implicit(i) {}
  constexpr SocketDecl(std::string_view id, SocketType t, float x, bool at_shifted_points)
      : identifier(id), type(t), value(x), shifted(at_shifted_points) {}
};

// A setting that is one of a list. What is in neither list is named, and the first item is used.
struct EnumDecl {
  std::string_view property;
  std::span<const std::string_view> items;
  std::span<const std::string_view> named = {};  // those that the node names where they matter
};

// A row of a table of modes, which have names; the first one for a name that is not there.
template <class Mode, size_t N>
const Mode& find_mode(const Mode (&modes)[N], std::string_view name) {
  for (const Mode& mode : modes) {
    if (mode.name == name) {
      return mode;
    }
  }
  return modes[0];
}
template <class Mode, size_t N>
std::vector<std::string_view> names_of(const Mode (&modes)[N]) {
  std::vector<std::string_view> names;
  for (const Mode& mode : modes) {
    names.push_back(mode.name);
  }
  return names;
}

// Of a closure's node, the places of its settings' values among their items.
using ClosureSettings = std::array<uint8_t, 2>;

// What a closure can add to a surface, besides lobes.
struct ClosureTraits {
  // An input, by its position, and the value at which what it stands for is not there.
  struct Input {
    int index = -1;
    float neutral = 0.0f;
  };
  bool emits = false, transparent = false, transmits = false, holds_out = false, fibers = false;
  int lobes = 0;  // at most
  // Which may make it dark, opaque or reflecting after all, or its facets as wide along as across.
  Input emission{}, alpha{}, transmission{}, anisotropy{};
  // Which may make it a thin wall: what it transmits then depends on the direction of view, some of
  // it goes straight through, and it has a lobe more.
  Input thin_wall{};
  Input parts[4]{};   // each with a lobe
  Input covers[2]{};  // the same, and they dim what glows below them
};

// A closure node: adds to a result what its parameters say; `check` names what cannot be rendered
// as asked, where that can be seen from the graph.
struct ClosureDecl {
  void (*add)(const ClosureArguments&, ShadingResult&);
  ClosureTraits traits;
  void (*check)(const NodeReader&) = nullptr;
};

enum class MixOp { None, Mix, Add };  // of closures

struct NodeDecl {
  std::string_view type;  // Blender's node.type
  std::span<const SocketDecl> inputs;
  std::span<const std::string_view> outputs;
  // One of the three:
  void (*emit)(NodeEmitter&) = nullptr;  // a node of values
  const ClosureDecl* closure = nullptr;
  MixOp mix = MixOp::None;
  std::span<const EnumDecl> settings = {};
};

std::span<const NodeDecl> node_types();
const NodeDecl* find_node_type(std::string_view type);  // nullptr: unsupported

}  // namespace janus
