// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/shading/program.h"

#include <algorithm>

#include "janus/shading/closures.h"

namespace janus {

Program::Program() = default;
Program::~Program() = default;
Program::Program(Program&&) noexcept = default;
Program& Program::operator=(Program&&) noexcept = default;

void Program::execute(RunState state) const {
  for (const Instruction& i : instructions) {
    i.kernel(state, i);
  }
}

void Program::fill(const ShadingPoint& point, float* r) const {
  std::copy(constants.begin(), constants.end(), r);
  if (!filter_widths.empty()) {
    ShadingPoint points[1 + 2 * kMaxFilterWidths];
    ShadingPoint* next = points;
    *next++ = point;
    for (const float width : filter_widths) {
      *next++ = point.shifted(0, width);
      *next++ = point.shifted(1, width);
    }
    execute({r, points, *this});
  } else {
    execute({r, &point, *this});
  }
}

void Program::run(const ShadingPoint& point, ShadingResult& result) const {
  place(point.ns, result);
  if (constant()) {
    return;
  }
  float r[kMaxRegisters];
  fill(point, r);
  const int placed = result.bsdf.size();
  for (const Closure& closure : closures) {
    if (!(r[closure.share] > 0.0f)) {  // or not a number
      continue;
    }
    const uint16_t* in = operands.data() + closure.operands;
    closure.decl->add({closure, r, in, &point}, result);
  }
  if (result.bsdf.size() > placed) {
    result.bsdf.finish();
  }
  result.emission = glm::max(result.emission, Rgb(0.0f));
}

bool Program::emits_like(const Program& other) const {
  const auto same = [](const auto& a, const auto& b) { return *a == *b; };
  return emission == other.emission && constants == other.constants && operands == other.operands &&
         instructions == other.instructions && closures == other.closures &&
         tables == other.tables && attributes == other.attributes &&
         filter_widths == other.filter_widths && std::ranges::equal(textures, other.textures, same);
}

void lobes_for_view(const Reshading& reshading, vec3 view, Bsdf& lobes) {
  ShadingPoint point = reshading.point;
  point.view = view;
  ShadingResult result;
  reshading.program->run(point, result);
  lobes = result.bsdf;
}

vec3 view_of(const Reshading& reshading) { return reshading.point.view; }

bool alike(const Reshading& reshading, vec3 a, vec3 b) {
  const vec3 ng = reshading.point.ng;
  return reshading.program->dependence == Dependence::Side && dot(a, ng) * dot(b, ng) > 0.0f;
}

bool may_transmit(const Reshading& reshading) { return reshading.program->transmits; }

}  // namespace janus
