// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "janus/scene/diagnostics.h"
#include "janus/scene/node_graph.h"
#include "janus/shading/node_types.h"

namespace janus {

// Reads a node's inputs and properties; says what cannot be read, once, with material and node.
class NodeReader {
 public:
  NodeReader(const Node& node, const NodeDecl& decl, const std::string& material,
             Diagnostics& diagnostics)
      : node_(node), decl_(decl), material_(material), diagnostics_(diagnostics) {}

  const Node& node() const { return node_; }
  const NodeDecl& decl() const { return decl_; }

  // The constant of an input; where it is linked, not finite or omitted, its declared default.
  vec3 color(std::string_view identifier) const;
  float number(std::string_view identifier) const { return color(identifier).x; }
  // The constant as it is written; nullopt: a link, omitted, or no number.
  std::optional<vec4> value(std::string_view identifier) const;
  // What is linked to an input; nullptr: nothing.
  const NodeLink* link(std::string_view identifier) const;
  // Neither a link nor a value.
  bool omitted(std::string_view identifier) const;

  // Of a declared setting always one of its items.
  std::string property(std::string_view identifier, std::string_view fallback) const;
  bool flag(std::string_view identifier) const;
  float number_property(std::string_view identifier) const;           // 0: there is none
  const std::vector<float>* list(std::string_view identifier) const;  // nullptr: there is none
  void warn(const std::string& message) const;

 private:
  const NodeInput* input(std::string_view identifier) const;

  const Node& node_;
  const NodeDecl& decl_;
  const std::string& material_;
  Diagnostics& diagnostics_;
};

// Adds a warning about a node, unless the same one is there.
void warn(Diagnostics& diagnostics, const std::string& material, const Node& node,
          const std::string& message);

}  // namespace janus
