// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/shading/compiler.h"

#include <algorithm>
#include <cmath>

#include "janus/shading/node_types.h"

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
    return std::move(program_);
  }

 private:
  // Shared branches are walked once for each way to them; this bounds what a hostile tree costs.
  static constexpr int kMaxVisits = 4096;

  void warn(const Node& node, const std::string& message) {
    Diagnostic diagnostic{Severity::Warning, "", material_, node.name, message};
    if (std::find(diagnostics_.begin(), diagnostics_.end(), diagnostic) == diagnostics_.end()) {
      diagnostics_.push_back(std::move(diagnostic));
    }
  }

  const NodeInput* input(const Node& node, std::string_view identifier) {
    const auto it = node.inputs.find(std::string(identifier));
    return it == node.inputs.end() ? nullptr : &it->second;
  }

  static float declared_default(const NodeDecl& decl, std::string_view identifier) {
    for (const SocketDecl& socket : decl.inputs) {
      if (socket.identifier == identifier) {
        return socket.default_value;
      }
    }
    return 0.0f;
  }

  // The constant RGB of an input; a link is named as unsupported.
  Rgb color(const Node& node, const NodeDecl& decl, std::string_view identifier) {
    const Rgb fallback(declared_default(decl, identifier));
    const NodeInput* value = input(node, identifier);
    if (!value) {
      return fallback;
    }
    if (const auto* c = std::get_if<vec4>(value)) {
      return finite(node, Rgb(*c), fallback);
    }
    if (const auto* c = std::get_if<vec3>(value)) {
      return finite(node, *c, fallback);
    }
    if (const auto* f = std::get_if<float>(value)) {
      return finite(node, Rgb(*f), fallback);
    }
    linked(node, *value, identifier);
    return fallback;
  }

  float number(const Node& node, const NodeDecl& decl, std::string_view identifier) {
    return color(node, decl, identifier).x;
  }

  Rgb finite(const Node& node, Rgb value, Rgb fallback) {
    if (is_finite(value)) {
      return value;
    }
    warn(node, "an input is not a finite number; its default is used");
    return fallback;
  }

  void linked(const Node& node, const NodeInput& value, std::string_view identifier) {
    if (const auto* link = std::get_if<NodeLink>(&value)) {
      warn(node, "the input '" + std::string(identifier) + "' is linked to '" + link->node +
                     "', which is not supported yet; its default is used");
    }
  }

  void add(const Node& node, LobeType type, Rgb weight, float ior = 1.0f) {
    weight = glm::max(weight, Rgb(0.0f));
    if (is_black(weight)) {
      return;
    }
    if (program_.instructions.size() == kMaxLobes) {
      warn(node, "more than " + std::to_string(kMaxLobes) + " closures; this one is left out");
      return;
    }
    program_.instructions.push_back({type, weight, ior});
  }

  void normal(const Node& node) {
    if (const NodeInput* value = input(node, "Normal")) {
      linked(node, *value, "Normal");
    }
  }

  void closure(const NodeLink& link, float share) {
    const Node* node = graph_.find(link.node);
    if (!node || share == 0.0f) {
      return;
    }
    // Blender refuses cycles; a description written by hand may hold one.
    if (std::find(path_.begin(), path_.end(), node) != path_.end()) {
      warn(*node, "the shader tree has a cycle here; it is cut");
      return;
    }
    if (visits_++ >= kMaxVisits) {
      if (visits_ == kMaxVisits + 1) {
        warn(*node, "the shader mixes too many closures; the rest is left out");
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
      warn(node, "the node type " + node.type + " is not supported yet; it is rendered black");
      return;
    }
    switch (decl->op) {
      case NodeOp::Diffuse:
        normal(node);
        if (number(node, *decl, "Roughness") > 0.0f) {
          warn(node, "the roughness of a Diffuse BSDF is not supported yet; 0 is used");
        }
        add(node, LobeType::Diffuse, share * color(node, *decl, "Color"));
        break;
      case NodeOp::Glossy:
        normal(node);
        smooth_only(node, *decl);
        add(node, LobeType::Mirror, share * color(node, *decl, "Color"));
        break;
      case NodeOp::Glass:
        normal(node);
        smooth_only(node, *decl);
        // Cycles clamps the index in the same way: an index of 1 has no defined refraction.
        add(node, LobeType::Dielectric, share * color(node, *decl, "Color"),
            std::max(number(node, *decl, "IOR"), 1e-5f));
        break;
      case NodeOp::Emission:
        program_.emission += share * glm::max(color(node, *decl, "Color"), Rgb(0.0f)) *
                             std::max(number(node, *decl, "Strength"), 0.0f);
        break;
      case NodeOp::Principled:
        normal(node);
        warn(node,
             "Principled BSDF is not supported yet; its base color is rendered as Diffuse BSDF");
        add(node, LobeType::Diffuse, share * color(node, *decl, "Base Color"));
        program_.emission += share * glm::max(color(node, *decl, "Emission Color"), Rgb(0.0f)) *
                             std::max(number(node, *decl, "Emission Strength"), 0.0f);
        break;
      case NodeOp::MixShader: {
        const float factor = std::clamp(number(node, *decl, "Fac"), 0.0f, 1.0f);
        child(node, "Shader", share * (1.0f - factor));
        child(node, "Shader_001", share * factor);
        break;
      }
      case NodeOp::AddShader:
        child(node, "Shader", share);
        child(node, "Shader_001", share);
        break;
    }
  }

  void child(const Node& node, std::string_view identifier, float share) {
    const NodeInput* value = input(node, identifier);
    const auto* link = value ? std::get_if<NodeLink>(value) : nullptr;
    if (link) {
      closure(*link, share);
    }
  }

  void smooth_only(const Node& node, const NodeDecl& decl) {
    if (number(node, decl, "Roughness") > 0.0f) {
      warn(node, "roughness is not supported yet; the surface is rendered perfectly smooth");
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
  program.instructions.push_back({LobeType::Diffuse, Rgb(0.8f)});
  return program;
}

}  // namespace janus
