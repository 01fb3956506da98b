// SPDX-License-Identifier: GPL-3.0-or-later
//
// The one table of shader node types. The compiler, the Python bindings and the documentation read
// it; a node that is not in it is named as unsupported.
#pragma once

#include <span>
#include <string_view>

namespace janus {

enum class SocketType { Float, Vector, Color, Closure };

enum class NodeOp {
  Diffuse,
  Glossy,
  Glass,
  Refraction,
  Translucent,
  Transparent,
  Emission,
  Principled,
  MixShader,
  AddShader,
};

struct SocketDecl {
  std::string_view identifier;
  SocketType type;
  float default_value;  // of every component, when the graph omits the input
};

struct NodeDecl {
  std::string_view type;  // Blender's node.type
  NodeOp op;
  std::span<const SocketDecl> inputs;
  std::string_view output;
};

std::span<const NodeDecl> node_types();
const NodeDecl* find_node_type(std::string_view type);  // nullptr: unsupported

}  // namespace janus
