// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/session/passes.h"

#include <algorithm>
#include <span>

#include "janus/util/error.h"

namespace janus {

namespace {

// A pass of light; `color`: where its kind's colour is among those of surfaces.
struct LightPass {
  const char* name;
  const char* expression;  // null: the colour itself
  std::optional<size_t> color;
};
constexpr LightPass kLightPasses[] = {
    {"DiffDir", "LDE", 0},
    {"DiffInd", "L.+DE", 0},
    {"DiffCol", nullptr, 0},
    {"GlossDir", "L(<GR>|<SR>)E", 1},
    {"GlossInd", "L.+(<GR>|<SR>)E", 1},
    {"GlossCol", nullptr, 1},
    {"TransDir", "L(<GT>|<ST>)E", 2},
    {"TransInd", "L.+(<GT>|<ST>)E", 2},
    {"TransCol", nullptr, 2},
    {"Emit", "OE", std::nullopt},
    {"Env", "BE", std::nullopt},
};

const LightPass* find_light_pass(const std::string& name) {
  const auto* found = std::ranges::find(kLightPasses, name, &LightPass::name);
  return found == std::end(kLightPasses) ? nullptr : found;
}

}  // namespace

bool is_light_pass(const std::string& name) { return find_light_pass(name) != nullptr; }

RenderPasses::RenderPasses(const RenderSettings& settings, const Scene& scene) {
  std::vector<Expression> expressions;
  for (const ExpressionPass& pass : settings.expressions) {
    try {
      expressions.push_back(parse_expression(pass.expression));
    } catch (const Error& error) {
      throw SceneError("pass '" + pass.name + "'", pass.expression, error.what());
    }
    passes_.push_back({pass.name, passes_.size()});
  }
  for (const std::string& name : settings.light_passes) {
    layers_.expressions += find_light_pass(name)->expression ? 1 : 0;
    layers_.colors = layers_.colors || find_light_pass(name)->color;
  }
  layers_.expressions += expressions.size();
  if (layers_.expressions > PathAutomaton::kMostExpressions) {
    throw SceneError("settings", "expressions", "more than 64 passes of light");
  }
  for (const std::string& name : settings.light_passes) {
    add_light_pass(name, expressions);
  }
  if (!expressions.empty()) {
    try {
      automaton_.emplace(expressions, scene);
    } catch (const Error& error) {
      throw SceneError("settings", "expressions", error.what());
    }
    for (const std::string& name : automaton_->unknown_names()) {
      // A light group may well be empty.
      const bool group = std::ranges::any_of(expressions, [&](const Expression& e) {
        return std::ranges::find(e.symbols, name, &VertexPattern::group) != e.symbols.end();
      });
      diagnostics_.push_back({group ? Severity::Info : Severity::Warning, "", "", "",
                              "a light path expression names '" + name +
                                  "', but no object, light or light group is called that"});
    }
  }
  layers_.caught = layers_.matte = scene.catchers_alone != nullptr;
  layers_.longest = settings.strategy_images;
  if (layers_.longest > 0) {
    add_strategies();
  }
}

void RenderPasses::add_light_pass(const std::string& name, std::vector<Expression>& expressions) {
  const LightPass& pass = *find_light_pass(name);
  const auto color = pass.color ? std::optional(layers_.first_color() + *pass.color) : std::nullopt;
  if (pass.expression) {
    passes_.push_back({name, expressions.size(), color});
    expressions.push_back(parse_expression(pass.expression));
  } else {
    passes_.push_back({name, *color});
  }
}

void RenderPasses::add_strategies() {
  for (int edges = 1; edges <= layers_.longest; ++edges) {
    for (int s = 0; s <= (edges > 1 ? edges : 0); ++s) {
      const Technique technique{s, edges + 1 - s};
      std::string name = "s";
      name += std::to_string(technique.s) + " t" + std::to_string(technique.t);
      passes_.push_back({name + " weighted", layers_.strategy(technique)});
      passes_.push_back({name + " alone", layers_.strategy(technique) + 1});
    }
  }
  passes_.push_back({"longer weighted", layers_.longer()});
}

}  // namespace janus
