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
  ClosureSettings settings;

  static constexpr uint16_t kNoNormal = UINT16_MAX;

  bool operator==(const Closure&) const = default;
};

// The parameters of a closure at a point.
class ClosureArguments {
 public:
  // `point`: null for a closure that is the same everywhere; its normal is then set where it is.
  ClosureArguments(const Closure& closure, const float* registers, const uint16_t* operands,
                   const ShadingPoint* point)
      : closure_(closure), registers_(registers), operands_(operands), point_(point) {
    if (closure.normal != Closure::kNoNormal) {
      normal_ = to_front(registers + closure.normal, surface_normal());
    } else {
      normal_ = surface_normal();
    }
  }

  float share() const { return registers_[closure_.share]; }
  int setting(int i = 0) const { return closure_.settings[static_cast<size_t>(i)]; }
  bool multiscatter() const { return setting() == 0; }  // of a distribution
  bool beckmann() const { return setting() == 2; }
  // The closure's normal, and the one of the surface: on the front side.
  vec3 normal() const { return normal_; }
  vec3 surface_normal() const { return point_ ? point_->ns : vec3(0.0f, 0.0f, 1.0f); }
  // By the position of the input in the declaration: a normal, which is the closure's where the
  // input gives none.
  vec3 normal(int input) const { return to_front(registers_ + operands_[input], normal_); }
  // Is the surface seen from behind?
  bool from_behind() const { return point_ && point_->backfacing(); }
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
  float positive(int input) const { return std::max(number(input), 0.0f); }
  // The cosine of the view to the closure's normal, as its facets see both; 1 without a point.
  float seen_cosine() const;
  // The share of light from `layer` of the result, and below, that reaches the viewer.
  Rgb seen_through(const ShadingResult& result, int layer) const;

 private:
  // From the viewer's side; `fallback` where there is no direction.
  vec3 to_front(const float* r, vec3 fallback) const {
    const vec3 facing(r[0], r[1], r[2]);
    const float length = glm::length(facing);
    if (!point_ || !(length > 0.0f && std::isfinite(length))) {
      return fallback;
    }
    return point_->facing(facing / length);
  }

  const Closure& closure_;
  const float* registers_;
  const uint16_t* operands_;
  const ShadingPoint* point_;
  vec3 normal_;
};

extern const ClosureDecl kDiffuseClosure, kGlossyClosure, kGlassClosure, kRefractionClosure,
    kTranslucentClosure, kTransparentClosure, kHoldoutClosure, kEmissionClosure, kPrincipledClosure,
    kMetallicClosure, kSheenClosure, kToonClosure, kSubsurfaceClosure, kHairClosure,
    kPrincipledHairClosure;

// The inputs of the closures, in the order in which their functions read them.
extern const std::span<const SocketDecl> kDiffuseInputs, kGlossyInputs, kGlassInputs,
    kRefractionInputs, kTranslucentInputs, kTransparentInputs, kEmissionInputs, kPrincipledInputs,
    kMetallicInputs, kSheenInputs, kToonInputs, kSubsurfaceInputs, kHairInputs,
    kPrincipledHairInputs;

}  // namespace janus
