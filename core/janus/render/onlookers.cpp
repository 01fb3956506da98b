// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/render/onlookers.h"

#include <optional>
#include <set>
#include <string>

#include "janus/shading/closures.h"
#include "janus/shading/compiler.h"

namespace janus {

namespace {

// The outputs of Light Path that the tree uses.
std::set<std::string> questions(const NodeGraph& graph) {
  std::set<std::string> outputs;
  for (const Node& node : graph.nodes) {
    for (const auto& [name, input] : node.inputs) {
      const auto* link = std::get_if<NodeLink>(&input);
      const Node* source = link ? graph.find(link->node) : nullptr;
      if (source && source->type == "LIGHT_PATH") {
        outputs.insert(link->output);
      }
    }
  }
  return outputs;
}

}  // namespace

void add_seen(std::vector<SeenProgram>& programs, RayType ray, Program program) {
  const auto same = std::ranges::find_if(
      programs, [&](const SeenProgram& seen) { return seen.program.emits_like(program); });
  if (same != programs.end()) {
    same->seen_by |= ray_bit(ray);
  } else {
    programs.push_back({ray_bit(ray), std::move(program)});
  }
}

std::array<size_t, std::size(kRays)> first_with_answers(const NodeGraph& graph) {
  const std::set<std::string> asked = questions(graph);
  const auto alike = [&](RayType a, RayType b) {
    return std::ranges::all_of(asked, [&](const std::string& output) {
      return light_path_answer(a, output) == light_path_answer(b, output);
    });
  };
  std::array<size_t, std::size(kRays)> first;
  for (size_t i = 0; i < first.size(); ++i) {
    first[i] = 0;
    while (!alike(kRays[first[i]], kRays[i])) {
      ++first[i];
    }
  }
  return first;
}

void add_new(Diagnostics& said, const Diagnostics& more) {
  for (const Diagnostic& d : more) {
    if (std::ranges::find(said, d) == said.end()) {
      said.push_back(d);
    }
  }
}

bool scatters(const Program& program) {
  const auto scatters = [](const Closure& c) { return c.decl->traits.lobes > 0; };
  return !program.lobes.empty() || std::ranges::any_of(program.closures, scatters);
}

}  // namespace janus
