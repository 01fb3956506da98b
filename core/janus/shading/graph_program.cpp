// SPDX-License-Identifier: GPL-3.0-or-later
//
// The last steps of GraphCompiler: closures, and from values to registers.
#include <algorithm>
#include <set>

#include "janus/shading/closures.h"
#include "janus/shading/graph_compiler.h"
#include "janus/shading/nodes/bump.h"
#include "janus/shading/point_reads.h"

namespace janus {

// --- Displacement as bump ------------------------------------------------------------------------

namespace {

constexpr Operation kHeight = pure<[](vec3 displacement, vec3 n) { return dot(displacement, n); }>;

}  // namespace

// As Cycles does where Displacement is Bump Only: with the settings of a new Bump node, and three
// copies of the tree for the three points.
void GraphCompiler::bump_surface() {
  const auto node = graph_.displacement ? nodes_.find(graph_.displacement->node) : nodes_.end();
  if (node == nodes_.end()) {
    if (graph_.displacement) {
      diagnostics_.push_back({Severity::Warning, "", material_, graph_.displacement->node,
                              "the displacement is linked to it, and it is not there"});
    }
    return;
  }
  const Value one = constant(vec3(1.0f), SocketType::Float);
  const Value width = constant(vec3(kBumpWidth), SocketType::Float);
  const Value normal = emit(kFacingNormal, {}, 0, kUnbumped);
  std::vector<Value> operands = {one, one, width};
  for (uint16_t at = kUnbumped; at < kUnbumped + 3; ++at) {
    require(*node->second, at);
    const auto& outputs = outputs_[{node->second, at}];
    const auto displacement = outputs.find(graph_.displacement->output);
    if (displacement == outputs.end()) {
      if (find_node_type(node->second->type)) {  // or it has been named already
        warn(diagnostics_, material_, *node->second,
             "the output '" + graph_.displacement->output +
                 "' is not supported yet; the surface is not displaced");
      }
      return;
    }
    operands.push_back(emit(kHeight, {displacement->second, normal}, 0, at));
  }
  if (operands[3].index == operands[4].index && operands[3].index == operands[5].index) {
    return;  // the same everywhere
  }
  operands.push_back(normal);
  bumped_normal_ = emit(kBump, operands, 0, kUnbumped);
  bump_steps_ = steps_.size();
  program_.edges = true;
}

// --- Closures ------------------------------------------------------------------------------------

bool GraphCompiler::neutral(const ClosureStep& step, const ClosureTraits::Input& input) const {
  const vec3* x = input.index < 0 ? nullptr : as_constant(step.operands[input.index]);
  return x && x->x == input.neutral;
}

void GraphCompiler::read_inputs(const NodeReader& reader, ClosureStep& step) {
  const ClosureTraits& traits = step.decl->traits;
  for (const SocketDecl& socket : reader.decl().inputs) {
    if (socket.implicit == Implicit::Normal) {
      step.operands.push_back(constant(vec3(0.0f), SocketType::Vector));
      if (reader.link(socket.identifier)) {
        step.has_normal = true;
        step.normal = input(reader, socket.identifier, 0);
      }
    } else if (socket.implicit == Implicit::Tangent && neutral(step, traits.anisotropy)) {
      step.operands.push_back(constant(vec3(0.0f), SocketType::Vector));
    } else {
      step.operands.push_back(input(reader, socket.identifier, 0));
    }
  }
}

void GraphCompiler::closure(const NodeReader& reader, Value share) {
  require(reader.node(), 0);
  ClosureStep step{reader.decl().closure, share, {}, {}, false, share};
  for (size_t i = 0; i < reader.decl().settings.size(); ++i) {  // each says what it does not have
    const EnumDecl& setting = reader.decl().settings[i];
    const std::string name = reader.property(setting.property, setting.items.front());
    const auto chosen = std::ranges::find(setting.items, name);
    step.settings.at(i) = static_cast<uint8_t>(chosen - setting.items.begin());
  }
  read_inputs(reader, step);
  const ClosureTraits& traits = step.decl->traits;
  program_.fibers |= traits.fibers;
  program_.edges |= traits.fibers;
  const bool thin = traits.thin_wall.index >= 0 && !neutral(step, traits.thin_wall);
  const bool thin_glass = thin && !neutral(step, traits.transmission);
  program_.transmits |= traits.transmits && (thin || !neutral(step, traits.transmission));
  if (step.decl->check) {
    step.decl->check(reader);
  }
  const bool glows = traits.emits && !neutral(step, traits.emission);
  const bool turned = traits.anisotropy.index >= 0 && !neutral(step, traits.anisotropy);
  bool dimmed = false;
  for (const ClosureTraits::Input& cover : traits.covers) {
    dimmed |= glows && cover.index >= 0 && !neutral(step, cover);
  }
  const bool by_view = dimmed || thin_glass;
  if (by_view) {
    program_.dependence = Dependence::View;
  } else if (turned) {
    program_.dependence = std::max(program_.dependence, Dependence::Side);
  }
  const auto known = [&](Value v) { return as_constant(v) != nullptr; };
  if (!by_view && !turned && !step.has_normal && known(share) &&
      std::all_of(step.operands.begin(), step.operands.end(), known)) {
    add_constant(reader, step);
    return;
  }
  program_.varying_emission |= glows;
  program_.varying_transparency |=
      traits.transparent && (thin_glass || !neutral(step, traits.alpha));
  program_.varying_holdout |= traits.holds_out;
  const auto absent = [&](std::span<const ClosureTraits::Input> optional) {
    return static_cast<int>(std::ranges::count_if(
        optional, [&](const ClosureTraits::Input& part) { return neutral(step, part); }));
  };
  lobes_ += traits.lobes + (thin_glass ? 1 : 0) - absent(traits.parts) - absent(traits.covers);
  say_if_full(reader);
  closures_.push_back(std::move(step));
}

void GraphCompiler::add_constant(const NodeReader& reader, const ClosureStep& step) {
  std::vector<float> registers;
  std::vector<uint16_t> places;
  const auto add = [&](Value value) {
    const vec3 x = *as_constant(value);
    registers.insert(registers.end(), {x.x, x.y, x.z});
    return static_cast<uint16_t>(registers.size() - 3);
  };
  const Closure closure{step.decl, add(step.share), 0, Closure::kNoNormal, step.settings};
  for (const Value operand : step.operands) {
    places.push_back(add(operand));
  }
  ShadingResult result;
  step.decl->add({closure, registers.data(), places.data(), nullptr}, result);
  program_.emission += result.emission;
  program_.transparency += result.transparency;
  program_.holdout += result.holdout;
  for (const Lobe& lobe : result.bsdf.lobes()) {
    ++lobes_;
    if (program_.lobes.size() < kMaxLobes) {
      program_.lobes.push_back(lobe);
    }
  }
  say_if_full(reader);
}

void GraphCompiler::say_if_full(const NodeReader& reader) const {
  if (lobes_ > kMaxLobes) {
    reader.warn("more than " + std::to_string(kMaxLobes) + " closures; some are left out");
  }
}

// --- AOVs ----------------------------------------------------------------------------------------

void GraphCompiler::aov(const NodeReader& reader, uint32_t number) {
  require(reader.node(), 0);
  aovs_.push_back({number, input(reader, "Color", 0), input(reader, "Value", 0)});
}

// --- The end -------------------------------------------------------------------------------------

Program GraphCompiler::finish() {
  std::vector<bool> used(values_.size(), false);
  mark_used(used);
  move_view_back(used);
  assign_registers(used);
  Bsdf bsdf;
  for (const Lobe& lobe : program_.lobes) {
    bsdf.add(lobe);
  }
  bsdf.finish();
  program_.lobes.assign(bsdf.lobes().begin(), bsdf.lobes().end());
  if (!program_.varying_emission) {  // else the sum at a point decides
    program_.emission = glm::max(program_.emission, Rgb(0.0f));
  }
  return std::move(program_);
}

template <class Read>
void GraphCompiler::for_each_result(Read&& read) const {
  for (const ClosureStep& closure : closures_) {
    read(closure.share);
    std::ranges::for_each(closure.operands, read);
    if (closure.has_normal) {
      read(closure.normal);
    }
  }
  for (const AovStep& aov : aovs_) {
    read(aov.color);
    read(aov.value);
  }
  if (bumped_normal_) {
    read(*bumped_normal_);
  }
}

void GraphCompiler::mark_used(std::vector<bool>& used) const {
  for_each_result([&](Value value) { used[value.index] = true; });
  // Operands stand before the steps that read them.
  for (auto step = steps_.rbegin(); step != steps_.rend(); ++step) {
    if (used[step->result.index]) {
      for (const Value operand : step->operands) {
        used[operand.index] = true;
      }
    }
  }
}

// Sets the steps that depend on the direction of view behind all others, which then need not be run
// again for another one.
void GraphCompiler::move_view_back(const std::vector<bool>& used) {
  std::vector<bool> by_view(values_.size(), false);
  for (const Step& step : steps_) {
    by_view[step.result.index] =
        used[step.result.index] &&
        (step.operation.dependence == Dependence::View ||
         std::ranges::any_of(step.operands, [&](Value v) { return by_view[v.index]; }));
  }
  depends_on_view_ =
      program_.dependence == Dependence::View || std::ranges::find(by_view, true) != by_view.end();
  const auto fixed = [&](const Step& step) { return !by_view[step.result.index]; };
  const auto bumped = steps_.begin() + static_cast<ptrdiff_t>(bump_steps_);
  if (std::all_of(steps_.begin(), bumped, fixed)) {
    side_steps_ =
        static_cast<size_t>(std::stable_partition(bumped, steps_.end(), fixed) - steps_.begin());
  }
}

// What the first steps leave to others, in the order of the steps.
std::vector<uint32_t> GraphCompiler::kept_values(const std::vector<bool>& used) const {
  std::vector<bool> read(values_.size(), false);
  for_each_result([&](Value value) { read[value.index] = true; });
  for (size_t s = side_steps_; s < steps_.size(); ++s) {
    for (const Value operand : steps_[s].operands) {
      read[operand.index] = read[operand.index] || used[steps_[s].result.index];
    }
  }
  std::vector<uint32_t> kept;
  if (!depends_on_view_ || side_steps_ < bump_steps_) {
    return kept;
  }
  for (size_t s = 0; s < side_steps_; ++s) {
    if (const uint32_t index = steps_[s].result.index; read[index]) {
      kept.push_back(index);
    }
  }
  return kept;
}

void GraphCompiler::assign_registers(const std::vector<bool>& used) {
  std::vector<uint32_t> place(values_.size(), 0);
  for (uint32_t i = 0; i < values_.size(); ++i) {
    if (used[i] && values_[i].is_constant) {
      place[i] = static_cast<uint32_t>(program_.constants.size());
      const vec3 x = values_[i].x;
      const int size = is_vector(values_[i].type) ? 3 : 1;
      program_.constants.insert(program_.constants.end(), &x.x, &x.x + size);
    }
  }
  // A register is free again after the last step that reads it; results never are.
  constexpr size_t kAlways = SIZE_MAX;
  std::vector<size_t> last(values_.size(), 0);
  for (size_t s = 0; s < steps_.size(); ++s) {
    if (used[steps_[s].result.index]) {
      for (const Value operand : steps_[s].operands) {
        last[operand.index] = s;
      }
    }
  }
  for_each_result([&](Value value) { last[value.index] = kAlways; });
  size_t top = program_.constants.size();
  std::vector<bool> placed(values_.size(), false);
  for (const uint32_t index : kept_values(used)) {
    place[index] = static_cast<uint32_t>(top);
    top += is_vector(values_[index].type) ? 3 : 1;
    placed[index] = true;
    last[index] = kAlways;
  }
  if (const size_t kept = top - program_.constants.size(); kept <= kMaxKept) {
    program_.first_kept = static_cast<uint16_t>(program_.constants.size());
    program_.kept_count = static_cast<uint16_t>(kept);
  }
  std::vector<uint32_t> free[2];  // numbers, vectors
  std::set<uint32_t> asked;       // operands whose prefetches are there
  for (size_t s = 0; s < steps_.size(); ++s) {
    const Step& step = steps_[s];
    if (!used[step.result.index]) {
      continue;
    }
    const bool vector = is_vector(step.operation.result);
    std::vector<uint32_t>& available = free[vector];
    if (placed[step.result.index]) {
      // It has its own.
    } else if (available.empty()) {
      place[step.result.index] = static_cast<uint32_t>(top);
      top += vector ? 3 : 1;
    } else {
      place[step.result.index] = available.back();
      available.pop_back();
    }
    std::set<uint32_t> ended;
    for (const Value operand : step.operands) {
      const Definition& definition = values_[operand.index];
      if (!definition.is_constant && last[operand.index] == s &&
          ended.insert(operand.index).second) {
        free[is_vector(definition.type)].push_back(place[operand.index]);
      }
    }
    const auto first = static_cast<uint32_t>(program_.operands.size());
    for (const Value operand : step.operands) {
      program_.operands.push_back(static_cast<uint16_t>(place[operand.index]));
    }
    if (step.operation.prefetch && asked.insert(step.operands[0].index).second) {
      // Those that look at the same place then wait for memory together.
      for (size_t other = s + 1; other < steps_.size(); ++other) {
        const Step& o = steps_[other];
        if (o.operation.prefetch && used[o.result.index] &&
            o.operands[0].index == step.operands[0].index) {
          program_.instructions.push_back({o.operation.prefetch, first, o.data, 0, o.at});
        }
      }
    }
    program_.instructions.push_back({step.operation.kernel, first, step.data,
                                     static_cast<uint16_t>(place[step.result.index]), step.at});
    program_.dependence = std::max(program_.dependence, step.operation.dependence);
    program_.by_path |= step.operation.by_path;
    const auto done = static_cast<uint32_t>(program_.instructions.size());
    if (s < bump_steps_) {
      program_.bump_instructions = done;
    }
    if (s < side_steps_) {
      program_.side_instructions = done;
    } else {
      program_.view_beside |= step.at != 0;
    }
  }
  program_.bumped_normal = bumped_normal_ ? static_cast<uint16_t>(place[bumped_normal_->index]) : 0;
  if (top > kMaxRegisters) {
    diagnostics_.push_back({Severity::Warning, "", material_, "",
                            "the shader is too large; what varies over the surface is left out"});
    program_.instructions.clear();
    program_.constants.clear();
    program_.bump_instructions = program_.side_instructions = 0;
    program_.kept_count = 0;
    program_.varying_emission = program_.varying_transparency = program_.varying_holdout = false;
    return;
  }
  for (const ClosureStep& step : closures_) {
    const auto first = static_cast<uint32_t>(program_.operands.size());
    for (const Value operand : step.operands) {
      program_.operands.push_back(static_cast<uint16_t>(place[operand.index]));
    }
    const auto normal = static_cast<uint16_t>(place[step.normal.index]);
    program_.closures.push_back({step.decl, static_cast<uint16_t>(place[step.share.index]), first,
                                 step.has_normal ? normal : Closure::kNoNormal, step.settings});
  }
  for (const AovStep& step : aovs_) {
    program_.aovs.push_back({step.aov, static_cast<uint16_t>(place[step.color.index]),
                             static_cast<uint16_t>(place[step.value.index])});
  }
}

}  // namespace janus
