// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/shading/compiler.h"

#include <algorithm>

#include "janus/shading/closures.h"

namespace janus {

namespace {

// Walks the closure tree from the output and collects closures with their shares.
class Compiler {
 public:
  Compiler(const NodeGraph& graph, const std::string& material, Diagnostics& diagnostics)
      : graph_(graph), material_(material), diagnostics_(diagnostics) {}

  Program compile() {
    if (graph_.surface) {
      closure(*graph_.surface, 1.0f);
    }
    finish(program_);
    return std::move(program_);
  }

  static void finish(Program& program) {
    Bsdf bsdf;
    for (const Lobe& lobe : program.lobes) {
      bsdf.add(lobe);
    }
    bsdf.finish();
    program.lobes.assign(bsdf.lobes().begin(), bsdf.lobes().end());
  }

 private:
  // Shared branches are walked once for each way to them; this bounds what a hostile tree costs.
  static constexpr int kMaxVisits = 4096;

  void closure(const NodeLink& link, float share) {
    const Node* node = graph_.find(link.node);
    if (!node || share == 0.0f) {
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

  void add_node(const Node& node, float share) {
    const NodeDecl* decl = find_node_type(node.type);
    if (!decl) {
      warn(diagnostics_, material_, node,
           "the node type " + node.type + " is not supported yet; it is rendered black");
      return;
    }
    const NodeReader reader(node, *decl, material_, diagnostics_);
    switch (decl->op) {
      case NodeOp::MixShader: {
        const float factor = reader.fraction("Fac");
        child(reader, "Shader", share * (1.0f - factor));
        child(reader, "Shader_001", share * factor);
        break;
      }
      case NodeOp::AddShader:
        child(reader, "Shader", share);
        child(reader, "Shader_001", share);
        break;
      default:
        add(reader, make_closures(reader, decl->op, share));
    }
  }

  void child(const NodeReader& reader, std::string_view identifier, float share) {
    if (const NodeLink* link = reader.closure(identifier)) {
      closure(*link, share);
    }
  }

  void add(const NodeReader& reader, const Closures& closures) {
    program_.emission += closures.emission;
    program_.transparency += closures.transparency;
    for (const Lobe& lobe : closures.lobes) {
      if (is_black(lobe.weight)) {
        continue;
      }
      if (program_.lobes.size() == kMaxLobes) {
        reader.warn("more than " + std::to_string(kMaxLobes) + " closures; this one is left out");
        return;
      }
      program_.lobes.push_back(lobe);
    }
  }

  const NodeGraph& graph_;
  const std::string& material_;
  Diagnostics& diagnostics_;
  Program program_;
  std::vector<const Node*> path_;  // from the output to the node at hand
  int visits_ = 0;
};

}  // namespace

Program compile(const NodeGraph& graph, const std::string& material, Diagnostics& diagnostics) {
  return Compiler(graph, material, diagnostics).compile();
}

Program default_surface() {
  Program program;
  program.lobes.push_back(diffuse_lobe(Rgb(0.8f)));
  return program;
}

}  // namespace janus
