// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "janus/shading/node_types.h"
#include "janus/shading/program.h"

namespace janus {

// A closure of a program: what it is, and the registers of its parameters.
struct Closure {
  const ClosureDecl* decl;
  uint16_t share;     // its part of Mix and Add
  uint32_t operands;  // one for each input of the node's declaration
  uint16_t normal;    // its own normal, on the viewer's side; kNoNormal: that of the surface
  uint8_t variant;    // of the node's first setting: the place of its value among the items

  static constexpr uint16_t kNoNormal = UINT16_MAX;

  bool operator==(const Closure&) const = default;
};

// The parameters of a closure at a point.
class ClosureArguments {
 public:
  // `normal`: the shading normal where the closure has none of its own; front side. `bumped`: it
  // has one.
  ClosureArguments(const Closure& closure, const float* registers, const uint16_t* operands,
                   vec3 normal, bool bumped = false)
      : closure_(closure),
        registers_(registers),
        operands_(operands),
        normal_(normal),
        bumped_(bumped) {}

  float share() const { return registers_[closure_.share]; }
  int variant() const { return closure_.variant; }
  bool multiscatter() const { return variant() == 0; }  // of a distribution
  vec3 normal() const { return normal_; }
  bool bumped() const { return bumped_; }
  // By the position of the input in the declaration. What is not finite counts as 0.
  float number(int input) const {
    const float x = registers_[operands_[input]];
    return std::isfinite(x) ? x : 0.0f;
  }
  vec3 vector(int input) const {
    const float* r = registers_ + operands_[input];
    const vec3 x(r[0], r[1], r[2]);
    return is_finite(x) ? x : vec3(0.0f);
  }
  Rgb positive_color(int input) const { return glm::max(vector(input), Rgb(0.0f)); }
  float fraction(int input) const { return glm::clamp(number(input), 0.0f, 1.0f); }

 private:
  const Closure& closure_;
  const float* registers_;
  const uint16_t* operands_;
  vec3 normal_;
  bool bumped_;
};

extern const ClosureDecl kDiffuseClosure, kGlossyClosure, kGlassClosure, kRefractionClosure,
    kTranslucentClosure, kTransparentClosure, kHoldoutClosure, kEmissionClosure, kPrincipledClosure,
    kHairClosure, kPrincipledHairClosure;

// The inputs of the closures, in the order in which their functions read them.
extern const std::span<const SocketDecl> kDiffuseInputs, kGlossyInputs, kGlassInputs,
    kRefractionInputs, kTranslucentInputs, kTransparentInputs, kEmissionInputs, kPrincipledInputs,
    kHairInputs, kPrincipledHairInputs;

}  // namespace janus
