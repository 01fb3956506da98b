// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/shading/graph_compiler.h"

#include <algorithm>
#include <bit>
#include <set>

#include "janus/shading/point_reads.h"

namespace janus {

namespace {

constexpr Operation kBroadcast = pure<[](float x) { return vec3(x); }>;
constexpr Operation kAverage = pure<[](vec3 v) { return average(v); }>;
// Cycles' weights, in their full length.
constexpr Operation kLuminance =
    pure<[](vec3 c) { return dot(c, vec3(0.2126729f, 0.7151522f, 0.0721750f)); }>;

}  // namespace

GraphCompiler::GraphCompiler(const NodeGraph& graph, const std::string& material,
                             const ImageMap& images, Diagnostics& diagnostics, SeenTree seen)
    : graph_(graph), material_(material), images_(images), diagnostics_(diagnostics), seen_(seen) {
  for (const Node& node : graph.nodes) {
    nodes_.emplace(node.name, &node);
  }
}

// --- Values --------------------------------------------------------------------------------------

Value GraphCompiler::define(const Definition& definition) {
  values_.push_back(definition);
  return {static_cast<uint32_t>(values_.size() - 1), definition.type};
}

Value GraphCompiler::constant(vec3 x, SocketType type) {
  if (!is_vector(type)) {
    x = vec3(x.x);
  }
  const auto bits = [](float f) { return std::bit_cast<uint32_t>(f); };
  const auto key = std::tuple(bits(x.x), bits(x.y), bits(x.z), type);
  const auto found = constants_.find(key);
  if (found != constants_.end()) {
    return found->second;
  }
  return constants_[key] = define({true, x, type, 0});
}

const vec3* GraphCompiler::as_constant(Value value) const {
  const Definition& definition = values_[value.index];
  return definition.is_constant ? &definition.x : nullptr;
}

Value GraphCompiler::convert(Value value, SocketType type) {
  if (value.type == type) {
    return value;
  }
  if (is_vector(value.type) && is_vector(type)) {
    if (const vec3* x = as_constant(value)) {
      return constant(*x, type);
    }
    return {value.index, type};
  }
  const Operation& operation = is_vector(type)                   ? kBroadcast
                               : value.type == SocketType::Color ? kLuminance
                                                                 : kAverage;
  return {emit(operation, {value}, 0, 0).index, type};
}

vec3 GraphCompiler::fold(const Operation& operation, const std::vector<Value>& operands,
                         uint32_t data) const {
  float r[3 * (kMaxOperands + 1)];
  Program program;
  program.tables = program_.tables;
  program.textures = program_.textures;
  for (size_t i = 0; i < operands.size(); ++i) {
    const vec3 x = values_[operands[i].index].x;
    program.operands.push_back(static_cast<uint16_t>(3 * (i + 1)));
    std::copy_n(&x.x, 3, r + 3 * (i + 1));
  }
  const ShadingPoint nowhere{};
  RunState frame{r, &nowhere, program};
  operation.kernel(frame, {operation.kernel, 0, data, 0, 0});
  return is_vector(operation.result) ? vec3(r[0], r[1], r[2]) : vec3(r[0]);
}

Value GraphCompiler::emit(const Operation& operation, const std::vector<Value>& given,
                          uint32_t data, uint16_t at) {
  std::vector<Value> operands;
  std::vector<uint32_t> indices;
  bool constants = !operation.reads_point;
  for (int i = 0; i < operation.count; ++i) {
    // Sockets say Vector or Color; operations take three numbers.
    const Value value = is_vector(operation.operands[i]) && is_vector(given[i].type)
                            ? given[i]
                            : convert(given[i], operation.operands[i]);
    operands.push_back(value);
    indices.push_back(value.index);
    constants = constants && values_[value.index].is_constant;
  }
  if (constants) {
    return constant(fold(operation, operands, data), operation.result);
  }
  // The point before it is bumped has another normal, and is the same else.
  const bool here = at == kUnbumped && operation.dependence == Dependence::None;
  const auto key = std::tuple(operation.kernel, indices, data,
                              operation.reads_point && !here ? at : static_cast<uint16_t>(0));
  const auto found = equal_.find(key);
  if (found != equal_.end()) {
    return found->second;
  }
  const Value result =
      define({false, vec3(0.0f), operation.result, static_cast<uint32_t>(steps_.size())});
  steps_.push_back({operation, operands, data, std::get<3>(key), result});
  return equal_[key] = result;
}

// --- Nodes ---------------------------------------------------------------------------------------

Value GraphCompiler::implicit(const SocketDecl& socket, uint16_t at) {
  switch (socket.implicit) {
    case Implicit::Normal:
      return emit(kFacingNormal, {}, 0, at);
    case Implicit::Position:
      return emit(kPosition, {}, 0, at);
    case Implicit::Generated:
      return generated(at);
    case Implicit::Uv:
      return emit(kAttribute, {}, attribute("uv:"), at);
    case Implicit::Along:
      return emit(kAlong, {}, 0, at);
    case Implicit::Beside:
      return emit(kAlong, {}, 1, at);
    case Implicit::OnCurve:
      return emit(kOnCurve, {}, 0, at);
    case Implicit::Tangent:
      return emit(kRadialTangent[2], {emit(kAttribute, {}, attribute("generated"), at)}, 0, at);
    case Implicit::Beam:
      return emit(kBeam, {}, 0, at);
    case Implicit::Strand:
    case Implicit::Value:
      break;
  }
  return constant(socket.value, socket.type);
}

Value GraphCompiler::generated(uint16_t at) {
  switch (seen_.of) {
    case SeenTree::Of::World:
      return emit(kPosition, {}, 0, at);
    case SeenTree::Of::Lamp:
      return emit(kObjectPoint, {}, 0, at);
    default:
      return emit(kAttribute, {}, attribute("generated"), at);
  }
}

Value GraphCompiler::input(const NodeReader& reader, std::string_view identifier, uint16_t at) {
  const auto& inputs = reader.decl().inputs;
  const auto socket = std::find_if(inputs.begin(), inputs.end(),
                                   [&](const SocketDecl& s) { return s.identifier == identifier; });
  if (socket == inputs.end()) {
    return constant(vec3(0.0f), SocketType::Float);
  }
  if (const NodeLink* link = reader.link(identifier)) {
    const auto node = nodes_.find(link->node);
    if (node == nodes_.end()) {
      reader.warn("the input '" + std::string(identifier) + "' is linked to '" + link->node +
                  "', which is not there; its default is used");
    } else {
      const auto compiled = outputs_.find({node->second, at});
      if (compiled != outputs_.end()) {
        const auto value = compiled->second.find(link->output);
        if (value != compiled->second.end()) {
          return convert(value->second, socket->type);
        }
        if (find_node_type(node->second->type)) {  // or it has been named already
          warn(diagnostics_, material_, *node->second,
               "the output '" + link->output + "' is not supported yet; a default is used");
        }
      }
    }
    return implicit(*socket, at);
  }
  if (socket->implicit == Implicit::Strand) {
    return emit(kStrand, {constant(reader.color(identifier), socket->type)}, 0, at);
  }
  if (reader.omitted(identifier)) {
    return implicit(*socket, at);
  }
  return constant(reader.color(identifier), socket->type);
}

void GraphCompiler::output(const Node& node, uint16_t at, std::string_view identifier,
                           Value value) {
  outputs_[{&node, at}].insert_or_assign(std::string(identifier), value);
}

bool GraphCompiler::linked(const Node& node, std::string_view output) const {
  for (const Node& reader : graph_.nodes) {
    for (const auto& [identifier, input] : reader.inputs) {
      const auto* link = std::get_if<NodeLink>(&input);
      if (link && link->node == node.name && link->output == output) {
        return true;
      }
    }
  }
  return false;
}

std::optional<uint16_t> GraphCompiler::shifted_points(float width) {
  std::vector<float>& widths = program_.filter_widths;
  const auto found = std::find(widths.begin(), widths.end(), width);
  const auto index = static_cast<uint16_t>(found - widths.begin());
  if (found == widths.end()) {
    if (widths.size() == kMaxFilterWidths) {
      return std::nullopt;
    }
    widths.push_back(width);
    program_.edges = true;
  }
  return static_cast<uint16_t>(1 + 2 * index);
}

// Where the points lie depends on an input, so that a node may ask for more when that is known.
std::vector<GraphCompiler::NodeAt> GraphCompiler::needs(const Node& node, uint16_t at) {
  std::vector<NodeAt> result;
  const NodeDecl* decl = find_node_type(node.type);
  if (!decl) {
    return result;
  }
  for (const SocketDecl& socket : decl->inputs) {
    const auto input = node.inputs.find(std::string(socket.identifier));
    const NodeLink* link =
        input == node.inputs.end() ? nullptr : std::get_if<NodeLink>(&input->second);
    const auto source = link ? nodes_.find(link->node) : nodes_.end();
    if (socket.type == SocketType::Closure || source == nodes_.end()) {
      continue;
    }
    result.emplace_back(source->second, at);
  }
  const auto known = [&](const NodeAt& need) { return outputs_.contains(need); };
  if (at != 0 || !std::all_of(result.begin(), result.end(), known)) {
    return result;
  }
  for (const SocketDecl& socket : decl->inputs) {
    const NodeReader reader(node, *decl, material_, diagnostics_);
    const NodeLink* link = socket.shifted ? reader.link(socket.identifier) : nullptr;
    const auto source = link ? nodes_.find(link->node) : nodes_.end();
    if (source == nodes_.end()) {
      continue;
    }
    NodeEmitter emitter(*this, reader, at);
    if (const auto first = emitter.shifted_points()) {
      result.emplace_back(source->second, *first);
      result.emplace_back(source->second, *first + 1);
    }
  }
  return result;
}

void GraphCompiler::require(const Node& first, uint16_t at) {
  // Not by recursion: trees may be thousands of nodes deep.
  std::vector<NodeAt> stack = {{&first, at}};
  std::set<NodeAt> open;
  while (!stack.empty()) {
    const NodeAt top = stack.back();
    if (outputs_.contains(top)) {
      stack.pop_back();
      continue;
    }
    open.insert(top);
    bool waits = false;
    for (const NodeAt& need : needs(*top.first, top.second)) {
      if (outputs_.contains(need)) {
        continue;
      }
      // Blender refuses cycles; a description written by hand may hold one.
      if (open.contains(need)) {
        warn(diagnostics_, material_, *need.first, "the tree has a cycle here; it is cut");
        continue;
      }
      stack.push_back(need);
      waits = true;
    }
    if (waits) {
      continue;
    }
    compile_node(*top.first, top.second);
    open.erase(top);
    stack.pop_back();
  }
}

void GraphCompiler::compile_node(const Node& node, uint16_t at) {
  outputs_[{&node, at}];
  const NodeDecl* decl = find_node_type(node.type);
  if (!decl) {
    warn(diagnostics_, material_, node,
         "the node type " + node.type +
             " is not supported yet; the default of the input that it "
             "feeds is used");
    return;
  }
  if (decl->emit) {
    const NodeReader reader(node, *decl, material_, diagnostics_);
    NodeEmitter emitter(*this, reader, at);
    decl->emit(emitter);
  }
}

// --- Data ----------------------------------------------------------------------------------------

namespace {

template <class T, class Same>
uint32_t find_or_add(std::vector<T>& list, T item, Same same) {
  const auto found = std::find_if(list.begin(), list.end(), same);
  const auto index = static_cast<uint32_t>(found - list.begin());
  if (found == list.end()) {
    list.push_back(std::move(item));
  }
  return index;
}

}  // namespace

void GraphCompiler::use_edges() { program_.edges = true; }

uint32_t GraphCompiler::attribute(const std::string& key) {
  program_.tangents |= key.starts_with("tangent:");
  return find_or_add(program_.attributes, key, [&](const std::string& k) { return k == key; });
}

uint32_t GraphCompiler::table(std::vector<float> values) {
  const auto same = [&](const std::vector<float>& t) { return t == values; };
  return find_or_add(program_.tables, values, same);
}

uint32_t GraphCompiler::texture(Texture texture) {
  auto shared = std::make_shared<const Texture>(std::move(texture));
  const auto same = [&](const std::shared_ptr<const Texture>& t) { return *t == *shared; };
  return find_or_add(program_.textures, shared, same);
}

const ImageDesc* GraphCompiler::image(const std::string& key) const {
  const auto found = images_.find(key);
  const bool usable =
      found != images_.end() && found->second.pixels && !found->second.pixels->pixels.empty();
  return usable ? &found->second : nullptr;
}

}  // namespace janus
