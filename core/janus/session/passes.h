// SPDX-License-Identifier: GPL-3.0-or-later
//
// The pictures that a render makes beside the main one: which there are, and what they are made of.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "janus/path/automaton.h"
#include "janus/session/settings.h"

namespace janus {

// Is that one of Cycles' passes of light? DiffDir, DiffInd, DiffCol, the same of Gloss and Trans,
// Emit, Env. Light is divided by the colour that has scattered it, as there.
bool is_light_pass(const std::string& name);

class RenderPasses {
 public:
  // Throws SceneError, which names the pass, for expressions that mean nothing.
  RenderPasses(const RenderSettings& settings, const Scene& scene);

  // What walks carry along; null: nothing.
  const PathAutomaton* automaton() const { return automaton_ ? &*automaton_ : nullptr; }
  const Layers& layers() const { return layers_; }

  struct Pass {
    std::string name;
    size_t layer;                   // of the film
    std::optional<size_t> color{};  // that it is divided by, likewise
  };
  const std::vector<Pass>& all() const { return passes_; }

  // Names in expressions that nothing in the scene has.
  const Diagnostics& diagnostics() const { return diagnostics_; }

 private:
  void add_light_pass(const std::string& name, std::vector<Expression>& expressions);
  void add_strategies();

  Layers layers_;
  std::optional<PathAutomaton> automaton_;
  std::vector<Pass> passes_;
  Diagnostics diagnostics_;
};

}  // namespace janus
