// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the emit function of a node sees of the compiler.
//
// Attributes are asked for by key. Of a mesh: "uv:NAME" (a UV map; without a name, the active one),
// "attribute:NAME", "color:" (the active colours), "generated", "normal" (of the vertices),
// "tangent:NAME" (of a UV map; its handedness is the fourth channel), "tangent_sign:NAME" (that
// alone), "pointiness", "random_per_island", "curve_intercept", "curve_length", "curve_radius" (of
// curves), "point_radius" (of points). Of an instance: "object:NAME", "instancer:NAME"
// (properties), "dupli_generated", "dupli_uv" (of what it was made from), and of what a particle
// shows "particle:times" (its index and age), "particle:lifetime", "particle:size",
// "particle:location", "particle:velocity", "particle:angular_velocity".
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "janus/shading/node_reader.h"
#include "janus/shading/operation.h"
#include "janus/shading/seen_tree.h"

namespace janus {

// A result of the program; a number of the compiler's.
struct Value {
  uint32_t index;
  SocketType type;
};

class GraphCompiler;

class NodeEmitter {
 public:
  NodeEmitter(GraphCompiler& compiler, const NodeReader& reader, uint16_t at)
      : compiler_(compiler), reader_(reader), at_(at) {}

  // The value of an input, of its declared type. `at`: for a shifted input, which point.
  Value input(std::string_view identifier, int at = 0);
  Value generated();
  // Of a node with shifted inputs: how far its points are, in pixels, and the number of the first
  // of the two; nullopt: too many nodes ask for others.
  float filter_width();
  std::optional<uint16_t> shifted_points();
  // Is the node itself looked at from a shifted point?
  bool shifted() const { return at_ != 0 && at_ != kUnbumped; }
  // Does it displace the surface?
  bool displaces() const { return at_ >= kUnbumped; }
  // For what Cycles does not look for at shifted points: emits at the point itself.
  NodeEmitter unshifted() const {
    return {compiler_, reader_, displaces() ? kUnbumped : uint16_t{0}};
  }
  bool linked(std::string_view identifier) const { return reader_.link(identifier) != nullptr; }
  // Of what the tree is, and who looks.
  SeenTree seen() const;
  // The value of an input that is a constant after folding.
  bool is_constant(Value value, float* x) const;
  // Is it this one?
  bool is_constant(Value value, vec3 x) const;

  std::string property(std::string_view name, std::string_view fallback = "") const {
    return reader_.property(name, fallback);
  }
  bool flag(std::string_view name) const { return reader_.flag(name); }
  float number(std::string_view name) const { return reader_.number_property(name); }
  const std::vector<float>* list(std::string_view name) const { return reader_.list(name); }

  Value constant(float x);
  Value constant(vec3 x);
  // Operands are converted to what the operation takes, as sockets convert.
  Value emit(const Operation& operation, std::initializer_list<Value> operands, uint32_t data = 0);
  Value convert(Value value, SocketType type);

  uint32_t attribute(const std::string& key);
  // Some operation reads the sides of the triangle, or the width of a pixel.
  void use_edges();
  uint32_t table(std::vector<float> values);
  uint32_t texture(Texture texture);
  // What the node shows a sun in, looked up in `direction`: a world looks for light there.
  void sun(Value direction, SunDisc disc);
  const ImageDesc* image(const std::string& key) const;  // nullptr: there is none

  void output(std::string_view identifier, Value value);
  // Does some input take this output?
  bool output_linked(std::string_view identifier) const;
  void warn(const std::string& message) const { reader_.warn(message); }

 private:
  GraphCompiler& compiler_;
  const NodeReader& reader_;
  uint16_t at_;
};

}  // namespace janus
