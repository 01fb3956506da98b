// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/shading/program.h"

#include <algorithm>

#include "janus/shading/closures.h"

namespace janus {

Program::Program() = default;
Program::~Program() = default;
Program::Program(Program&&) noexcept = default;
Program& Program::operator=(Program&&) noexcept = default;

void Program::execute(RunState state, size_t first, size_t end) const {
  for (size_t i = first; i < end; ++i) {
    instructions[i].kernel(state, instructions[i]);
  }
}

void Program::place_beside(ShadingPoint* points) const {
  ShadingPoint* next = points + 1;
  for (const float width : filter_widths) {
    *next++ = points->shifted(0, width);
    *next++ = points->shifted(1, width);
  }
}

void Program::fill(const ShadingPoint& point, float* r) const {
  std::copy(constants.begin(), constants.end(), r);
  if (!filter_widths.empty()) {
    ShadingPoint points[1 + 2 * kMaxFilterWidths];
    points[0] = point;
    place_beside(points);
    execute({r, points, *this}, 0, instructions.size());
  } else {
    execute({r, &point, *this}, 0, instructions.size());
  }
}

void Program::fill_bumped(ShadingPoint& point, float* r) const {
  std::copy(constants.begin(), constants.end(), r);
  ShadingPoint points[kUnbumped + 3];
  points[0] = points[kUnbumped] = point;
  points[kUnbumped + 1] = point.shifted(0, kBumpWidth);
  points[kUnbumped + 2] = point.shifted(1, kBumpWidth);
  execute({r, points, *this}, 0, bump_instructions);
  const float* n = r + bumped_normal;
  point.ns = points[0].ns = point.facing(vec3(n[0], n[1], n[2]));
  place_beside(points);
  execute({r, points, *this}, bump_instructions, instructions.size());
}

void Program::run(const ShadingPoint& point, ShadingResult& result, float* kept) const {
  if (constant()) {
    place(point.ns, result);
    return;
  }
  float r[kMaxRegisters];
  if (bump_instructions != 0) {
    ShadingPoint bumped = point;
    fill_bumped(bumped, r);
    close(bumped, r, result);
  } else {
    fill(point, r);
    close(point, r, result);
  }
  if (kept) {  // nothing else has written there: see GraphCompiler
    std::copy_n(r + first_kept, kept_count, kept);
  }
}

void Program::run_again(ShadingPoint point, const float* kept, ShadingResult& result) const {
  float r[kMaxRegisters];
  std::copy(constants.begin(), constants.end(), r);
  std::copy_n(kept, kept_count, r + first_kept);
  if (bump_instructions != 0) {
    const float* n = r + bumped_normal;
    point.ns = point.facing(vec3(n[0], n[1], n[2]));
  }
  ShadingPoint points[1 + 2 * kMaxFilterWidths];
  points[0] = point;
  if (view_beside) {
    place_beside(points);
  }
  execute({r, points, *this}, side_instructions, instructions.size());
  close(point, r, result);
}

void Program::close(const ShadingPoint& point, const float* r, ShadingResult& result) const {
  place(point.ns, result);
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
         bump_instructions == other.bump_instructions && bumped_normal == other.bumped_normal &&
         tables == other.tables && attributes == other.attributes &&
         filter_widths == other.filter_widths && std::ranges::equal(textures, other.textures, same);
}

void lobes_for_view(const Reshading& reshading, vec3 view, Bsdf& lobes) {
  ShadingPoint point = reshading.point;
  point.view = view;
  ShadingResult result;
  const vec3 seen = view_of(reshading);
  if (reshading.program->kept_count > 0 && dot(view, point.ng) * dot(seen, point.ng) > 0.0f) {
    reshading.program->run_again(point, reshading.kept, result);
  } else {
    reshading.program->run(point, result);
  }
  lobes = result.bsdf;
}

vec3 view_of(const Reshading& reshading) { return reshading.point.view; }

bool alike(const Reshading& reshading, vec3 a, vec3 b) {
  const vec3 ng = reshading.point.ng;
  return reshading.program->dependence == Dependence::Side && dot(a, ng) * dot(b, ng) > 0.0f;
}

bool may_transmit(const Reshading& reshading) { return reshading.program->transmits; }

}  // namespace janus
