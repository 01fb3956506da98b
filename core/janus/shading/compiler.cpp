// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/shading/compiler.h"

#include <algorithm>

#include "janus/shading/graph_compiler.h"

namespace janus {

namespace {

constexpr Operation kShareOfSecond =
    pure<[](float share, float factor) { return share * glm::clamp(factor, 0.0f, 1.0f); }>;
constexpr Operation kShareOfFirst =
    pure<[](float share, float factor) { return share * (1.0f - glm::clamp(factor, 0.0f, 1.0f)); }>;

// Walks the tree of closures from the output: each closure gets its share of Mix and Add.
class ClosureTree {
 public:
  ClosureTree(const NodeGraph& graph, const std::string& material, const ImageMap& images,
              Diagnostics& diagnostics, SeenTree seen)
      : graph_(graph),
        material_(material),
        diagnostics_(diagnostics),
        compiler_(graph, material, images, diagnostics, seen) {}

  Program compile() {
    if (graph_.surface) {
      compiler_.bump_surface();
      closure(*graph_.surface, compiler_.constant(vec3(1.0f), SocketType::Float));
    }
    return compiler_.finish();
  }

 private:
  // Shared branches are walked once for each way to them; this bounds what a hostile tree costs.
  static constexpr int kMaxVisits = 4096;

  bool is_zero(Value share) const {
    const vec3* x = compiler_.as_constant(share);
    return x && x->x == 0.0f;
  }

  void closure(const NodeLink& link, Value share) {
    const Node* node = graph_.find(link.node);
    if (!node || is_zero(share)) {
      return;
    }
    // Blender refuses cycles; a description written by hand may hold one.
    if (std::find(path_.begin(), path_.end(), node) != path_.end()) {
      warn(diagnostics_, material_, *node, "the shader tree has a cycle here; it is cut");
      return;
    }
    if (visits_++ >= kMaxVisits) {
      if (visits_ == kMaxVisits + 1) {
        warn(diagnostics_, material_, *node,
             "the shader mixes too many closures; the rest is left out");
      }
      return;
    }
    path_.push_back(node);
    add_node(*node, share);
    path_.pop_back();
  }

  void add_node(const Node& node, Value share) {
    const NodeDecl* decl = find_node_type(node.type);
    if (!decl || (!decl->closure && decl->mix == MixOp::None)) {
      warn(diagnostics_, material_, node,
           "the node type " + node.type + " is not supported yet; it is rendered black");
      return;
    }
    const NodeReader reader(node, *decl, material_, diagnostics_);
    switch (decl->mix) {
      case MixOp::Mix: {
        compiler_.require(node, 0);
        const Value factor = compiler_.input(reader, "Fac", 0);
        child(reader, "Shader", compiler_.emit(kShareOfFirst, {share, factor}, 0, 0));
        child(reader, "Shader_001", compiler_.emit(kShareOfSecond, {share, factor}, 0, 0));
        break;
      }
      case MixOp::Add:
        child(reader, "Shader", share);
        child(reader, "Shader_001", share);
        break;
      case MixOp::None:
        compiler_.closure(reader, share);
    }
  }

  void child(const NodeReader& reader, std::string_view identifier, Value share) {
    if (const NodeLink* link = reader.link(identifier)) {
      closure(*link, share);
    }
  }

  const NodeGraph& graph_;
  const std::string& material_;
  Diagnostics& diagnostics_;
  GraphCompiler compiler_;
  std::vector<const Node*> path_;  // from the output to the node at hand
  int visits_ = 0;
};

}  // namespace

Program compile(const NodeGraph& graph, const std::string& material, const ImageMap& images,
                Diagnostics& diagnostics, SeenTree seen) {
  return ClosureTree(graph, material, images, diagnostics, seen).compile();
}

Program compile_aovs(const NodeGraph& graph, const std::string& material, const ImageMap& images,
                     std::vector<std::string>& names, Diagnostics& diagnostics, SeenTree seen) {
  GraphCompiler compiler(graph, material, images, diagnostics, seen);
  const NodeDecl& decl = *find_node_type("OUTPUT_AOV");
  compiler.bump_surface();
  for (const Node& node : graph.nodes) {
    if (node.type != decl.type) {
      continue;
    }
    const NodeReader reader(node, decl, material, diagnostics);
    const auto name = std::ranges::find(names, reader.property("aov_name", ""));
    const auto number = static_cast<uint32_t>(name - names.begin());
    if (name == names.end()) {
      names.push_back(reader.property("aov_name", ""));
    }
    compiler.aov(reader, number);
  }
  return compiler.finish();
}

std::vector<std::string> required_attributes(const NodeGraph& graph) {
  Diagnostics ignored;
  return compile(graph, "", {}, ignored).attributes;
}

std::vector<std::string> attributes_of_aovs(const NodeGraph& graph) {
  Diagnostics ignored;
  std::vector<std::string> names;
  return compile_aovs(graph, "", {}, names, ignored, kAnySurface).attributes;
}

Program default_surface() {
  Program program;
  program.lobes.push_back(diffuse_lobe(Rgb(0.8f)));
  return program;
}

}  // namespace janus
