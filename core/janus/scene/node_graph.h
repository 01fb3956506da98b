// SPDX-License-Identifier: GPL-3.0-or-later
//
// A flattened shader node tree as plain data: no groups, reroutes or muted nodes. Node types and
// sockets carry Blender's own identifiers.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "janus/math/vec.h"

namespace janus {

// An output socket of the node named `node`.
struct NodeLink {
  std::string node, output;
};

// What feeds an input: nothing (an implicit value such as the shading normal), a constant, or a
// link. Colours are vec4 (RGBA).
using NodeInput = std::variant<std::monostate, float, vec3, vec4, std::string, NodeLink>;
// Lists hold what ramps and curves were sampled to.
using NodeProperty = std::variant<bool, float, std::string, std::vector<float>>;

struct Node {
  std::string name;
  std::string type;  // Blender's node.type, e.g. "BSDF_GLASS"
  std::map<std::string, NodeInput> inputs;
  std::map<std::string, NodeProperty> properties;
};

struct NodeGraph {
  std::vector<Node> nodes;
  // What is linked to the output node's Surface, and to its Displacement.
  std::optional<NodeLink> surface, displacement;

  const Node* find(const std::string& name) const {
    for (const Node& node : nodes) {
      if (node.name == name) {
        return &node;
      }
    }
    return nullptr;
  }
};

}  // namespace janus
