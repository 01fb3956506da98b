// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

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

  // The constant value of an input; where it is linked, not finite or omitted, its declared
  // default.
  Rgb color(std::string_view identifier) const;
  float number(std::string_view identifier) const { return color(identifier).x; }
  // The value clamped from below, or to [0, 1].
  Rgb positive_color(std::string_view identifier) const {
    return glm::max(color(identifier), Rgb(0.0f));
  }
  float fraction(std::string_view identifier) const {
    return glm::clamp(number(identifier), 0.0f, 1.0f);
  }
  // What is linked to a closure input; nullptr: nothing.
  const NodeLink* closure(std::string_view identifier) const;
  std::string property(std::string_view identifier, std::string_view fallback) const;

  // Says that an input without a constant, such as Normal, is linked.
  void unlinked(std::string_view identifier) const;
  void warn(const std::string& message) const;

 private:
  const NodeInput* input(std::string_view identifier) const;
  float declared_default(std::string_view identifier) const;

  const Node& node_;
  const NodeDecl& decl_;
  const std::string& material_;
  Diagnostics& diagnostics_;
};

// Adds a warning about a node, unless the same one is there.
void warn(Diagnostics& diagnostics, const std::string& material, const Node& node,
          const std::string& message);

}  // namespace janus
