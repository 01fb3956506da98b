// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/path/automaton.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <map>
#include <set>

#include "janus/util/error.h"

namespace janus {

namespace {

constexpr size_t kMostStates = 1024;  // of a direction

// What a state is made of: a set of symbols, in order. The symbols of all expressions are in a row.
using SymbolSet = std::vector<uint16_t>;

struct Symbols {
  std::vector<VertexPattern> patterns;
  std::vector<std::vector<size_t>> follow;
  std::vector<size_t> expression;  // that it is part of
  SymbolSet first, last;           // may be the first of a path; may be followed by E

  explicit Symbols(std::span<const Expression> expressions) {
    for (size_t e = 0; e < expressions.size(); ++e) {
      const size_t offset = patterns.size();
      for (size_t i = 0; i < expressions[e].symbols.size(); ++i) {
        patterns.push_back(expressions[e].symbols[i]);
        expression.push_back(e);
        auto& next = follow.emplace_back();
        for (const int symbol : expressions[e].follow[i]) {
          next.push_back(offset + static_cast<size_t>(symbol));
        }
      }
      for (const int symbol : expressions[e].first) {
        first.push_back(static_cast<uint16_t>(offset + static_cast<size_t>(symbol)));
      }
    }
    for (size_t i = 0; i < patterns.size(); ++i) {
      if (std::ranges::any_of(follow[i], [&](size_t next) {
            return patterns[next].kind == VertexPattern::Kind::Eye;
          })) {
        last.push_back(static_cast<uint16_t>(i));
      }
    }
  }
};

// Numbers the sets that a direction comes to; number 0 is the empty one.
class States {
 public:
  States() { number({}); }

  PathAutomaton::State number(SymbolSet set) {
    std::ranges::sort(set);
    set.erase(std::ranges::unique(set).begin(), set.end());
    const auto [it, fresh] = numbers_.try_emplace(set, sets_.size());
    if (fresh) {
      if (sets_.size() == kMostStates) {
        throw Error("the light path expressions are too complex together");
      }
      sets_.push_back(set);
    }
    return static_cast<PathAutomaton::State>(it->second);
  }
  size_t size() const { return sets_.size(); }
  const SymbolSet& set(size_t state) const { return sets_[state]; }

  // The states that all of these lead to, by state and by input.
  std::vector<PathAutomaton::State> close(
      size_t inputs, const std::function<SymbolSet(const SymbolSet&, size_t)>& step) {
    std::vector<PathAutomaton::State> table;
    for (size_t state = 0; state < sets_.size(); ++state) {
      for (size_t input = 0; input < inputs; ++input) {
        const SymbolSet from = sets_[state];  // numbering moves the sets
        table.push_back(number(step(from, input)));
      }
    }
    return table;
  }

 private:
  std::vector<SymbolSet> sets_;
  std::map<SymbolSet, size_t> numbers_;
};

bool shines(const Light& light, const VertexPattern& pattern) {
  return (light.background ? pattern.background : pattern.objects) &&
         (pattern.name.empty() || pattern.name == light.name) &&
         (pattern.group.empty() || pattern.group == light.light_group);
}

}  // namespace

PathAutomaton::PathAutomaton(std::span<const Expression> expressions, const Scene& scene) {
  const Symbols all(expressions);
  std::vector<SymbolSet> before(all.patterns.size());  // what each may follow
  for (size_t i = 0; i < all.patterns.size(); ++i) {
    for (const size_t next : all.follow[i]) {
      before[next].push_back(static_cast<uint16_t>(i));
    }
  }

  // Objects fall into classes by which of the names they have.
  std::vector<std::string> names;
  std::set<std::string> unknown;
  for (const VertexPattern& pattern : all.patterns) {
    for (const std::string& name : {pattern.name, pattern.group}) {
      if (!name.empty()) {
        unknown.insert(name);
      }
    }
    if (pattern.kind == VertexPattern::Kind::Event && !pattern.name.empty()) {
      names.push_back(pattern.name);
    }
  }
  std::ranges::sort(names);
  names.erase(std::ranges::unique(names).begin(), names.end());
  std::vector<std::string> class_names;  // a name for each class; empty: none of the names
  for (const Instance& instance : scene.instances) {
    const bool named = std::ranges::binary_search(names, instance.names->name);
    const std::string& name = named ? instance.names->name : std::string();
    auto known = std::ranges::find(class_names, name);
    if (known == class_names.end()) {
      known = class_names.insert(known, name);
    }
    object_class_.push_back(static_cast<uint16_t>(known - class_names.begin()));
    unknown.erase(instance.names->name);
  }
  symbols_ = class_names.size() * kScatterEvents;

  std::vector<bool> matching(all.patterns.size() * symbols_);
  for (size_t symbol = 0; symbol < all.patterns.size(); ++symbol) {
    const VertexPattern& pattern = all.patterns[symbol];
    for (size_t input = 0; input < symbols_; ++input) {
      matching[symbol * symbols_ + input] =
          pattern.kind == VertexPattern::Kind::Event &&
          (pattern.events >> (input % kScatterEvents) & 1U) != 0 &&
          (pattern.name.empty() || pattern.name == class_names[input / kScatterEvents]);
    }
  }
  const auto matches = [&](size_t symbol, size_t input) {
    return matching[symbol * symbols_ + input];
  };

  States light_side;
  for (const auto& light : scene.lights) {
    SymbolSet start;
    std::ranges::copy_if(all.first, std::back_inserter(start),
                         [&](uint16_t i) { return shines(*light, all.patterns[i]); });
    light_start_.push_back(light_side.number(start));
    unknown.erase(light->name);
    unknown.erase(light->light_group);
  }
  forward_ = light_side.close(symbols_, [&](const SymbolSet& from, size_t input) {
    SymbolSet to;
    for (const uint16_t i : from) {
      for (const size_t next : all.follow[i]) {
        if (matches(next, input)) {
          to.push_back(static_cast<uint16_t>(next));
        }
      }
    }
    return to;
  });

  States camera_side;
  camera_start_ = camera_side.number(all.last);
  reverse_ = camera_side.close(symbols_, [&](const SymbolSet& from, size_t input) {
    SymbolSet to;
    for (const uint16_t next : from) {
      if (matches(next, input)) {
        to.insert(to.end(), before[next].begin(), before[next].end());
      }
    }
    return to;
  });

  // States of the two sides meet in the symbols that both have.
  camera_states_ = camera_side.size();
  completed_.resize(light_side.size() * camera_states_);
  std::vector<std::vector<uint32_t>> having(all.patterns.size());
  for (size_t camera = 0; camera < camera_states_; ++camera) {
    for (const uint16_t symbol : camera_side.set(camera)) {
      having[symbol].push_back(static_cast<uint32_t>(camera));
    }
  }
  for (size_t light = 0; light < light_side.size(); ++light) {
    for (const uint16_t symbol : light_side.set(light)) {
      for (const uint32_t camera : having[symbol]) {
        completed_[light * camera_states_ + camera] |= ExpressionMask{1} << all.expression[symbol];
      }
    }
  }
  unknown_names_.assign(unknown.begin(), unknown.end());
}

}  // namespace janus
