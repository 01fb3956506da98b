// SPDX-License-Identifier: GPL-3.0-or-later
//
// From a graph of nodes to instructions. Values are numbered as they are asked for, from the
// closures and AOVs backwards (nothing else is compiled); operations on constants are carried out
// at once; equal ones are shared. In the end, instructions that nobody reads are dropped and
// registers handed out.
#pragma once

#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "janus/shading/compiler.h"
#include "janus/shading/node_emitter.h"

namespace janus {

class GraphCompiler {
 public:
  GraphCompiler(const NodeGraph& graph, const std::string& material, const ImageMap& images,
                Diagnostics& diagnostics, SeenTree seen);

  // Values.
  Value constant(vec3 x, SocketType type);
  Value emit(const Operation& operation, const std::vector<Value>& operands, uint32_t data,
             uint16_t at);
  Value convert(Value value, SocketType type);
  const vec3* as_constant(Value value) const;
  // The value of a node's input at a point (0: the point itself), of its declared type.
  Value input(const NodeReader& reader, std::string_view identifier, uint16_t at);
  // Coordinates of the texture space, which procedural textures take where nothing is linked.
  Value generated(uint16_t at);
  void output(const Node& node, uint16_t at, std::string_view identifier, Value value);
  bool linked(const Node& node, std::string_view output) const;
  // The number of the first of the two points that lie `width` pixels to the side of the point;
  // nullopt: there are too many already.
  std::optional<uint16_t> shifted_points(float width);
  SeenTree seen() const { return seen_; }

  // What instructions refer to by `data`.
  void use_edges();
  uint32_t attribute(const std::string& key);
  uint32_t table(std::vector<float> values);
  uint32_t texture(Texture texture);
  void sun(const SunDisc& disc) { program_.suns.push_back(disc); }
  const ImageDesc* image(const std::string& key) const;

  // Compiles a node and all that it needs, deepest first.
  void require(const Node& node, uint16_t at);

  // Bumps the surface by what is linked to the output's Displacement. To be called first: all other
  // values see the new normal.
  void bump_surface();

  // A closure of the program.
  void closure(const NodeReader& reader, Value share);

  // What an AOV Output node writes.
  void aov(const NodeReader& reader, uint32_t number);

  Program finish();

 private:
  struct Definition {
    bool is_constant = false;
    vec3 x = vec3(0.0f);  // if it is
    SocketType type = SocketType::Float;
    uint32_t instruction = 0;  // if it is not
  };
  struct Step {
    Operation operation;
    std::vector<Value> operands;
    uint32_t data;
    uint16_t at;
    Value result;
  };
  struct ClosureStep {
    const ClosureDecl* decl;
    Value share;
    std::vector<Value> operands;
    ClosureSettings settings;
    bool has_normal;
    Value normal;
  };
  struct AovStep {
    uint32_t aov;
    Value color, value;
  };
  using NodeAt = std::pair<const Node*, uint16_t>;

  Value define(const Definition& definition);
  vec3 fold(const Operation& operation, const std::vector<Value>& operands, uint32_t data) const;
  Value implicit(const SocketDecl& socket, uint16_t at);
  void compile_node(const Node& node, uint16_t at);
  std::vector<NodeAt> needs(const Node& node, uint16_t at);

  void read_inputs(const NodeReader& reader, ClosureStep& step);
  bool neutral(const ClosureStep& step, const ClosureTraits::Input& input) const;
  void add_constant(const NodeReader& reader, const ClosureStep& step);
  void say_if_full(const NodeReader& reader) const;
  // Calls read(value) for each that closures and AOVs read.
  template <class Read>
  void for_each_result(Read&& read) const;
  void mark_used(std::vector<bool>& used) const;
  void move_view_back(const std::vector<bool>& used);
  std::vector<uint32_t> kept_values(const std::vector<bool>& used) const;
  void assign_registers(const std::vector<bool>& used);

  const NodeGraph& graph_;
  const std::string& material_;
  const ImageMap& images_;
  Diagnostics& diagnostics_;
  SeenTree seen_;
  std::map<std::string_view, const Node*> nodes_;

  std::vector<Definition> values_;
  std::vector<Step> steps_;
  std::vector<ClosureStep> closures_;
  std::vector<AovStep> aovs_;
  std::optional<Value> bumped_normal_;
  size_t bump_steps_ = 0;  // the first ones, which make it
  size_t side_steps_ = 0;  // the first ones, which do not depend on the direction of view
  bool depends_on_view_ = false;
  int lobes_ = 0;  // at most
  std::map<std::tuple<uint32_t, uint32_t, uint32_t, SocketType>, Value> constants_;
  std::map<std::tuple<Kernel, std::vector<uint32_t>, uint32_t, uint16_t>, Value> equal_;
  std::map<NodeAt, std::map<std::string, Value, std::less<>>> outputs_;
  Program program_;
};

}  // namespace janus
