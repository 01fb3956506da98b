// SPDX-License-Identifier: GPL-3.0-or-later
//
// Scattering at a point, as a small array of lobes by value.
//
// Directions: `wo` points to the camera side of the path, `wi` to the light side; both unit, world
// space, away from the surface. Values have these roles from both walks; pdfs are per solid angle.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "janus/shading/lobe.h"

namespace janus {

// What a walk carries: Radiance on camera subpaths (wi is sampled), Importance on light subpaths
// (wo is sampled).
enum class TransportMode { Radiance, Importance };

struct BsdfSample {
  vec3 direction;
  // f |cos| / pdf for the walk's mode, adjoint corrections included.
  Rgb weight;
  // Density of the direction, and of the opposite walk sampling the direction we came from. For a
  // delta event both are discrete probabilities.
  float pdf_solid, pdf_reverse;
  bool delta;
  // What Russian roulette must divide out of the throughput: the squared ratio of indices that a
  // refraction put into it (1 on camera subpaths, whose f carries no such factor).
  float eta_scale = 1.0f;
};

struct BsdfEval {
  Rgb f;
  float pdf_radiance = 0.0f, pdf_importance = 0.0f;
};

// A view of lobes at a point with geometric normal `ng` (unit, front side).
class BsdfView {
 public:
  BsdfView(std::span<const Lobe> lobes, vec3 ng) : lobes_(lobes), ng_(ng) {}

  // True if some lobe is not a delta: the vertex can be joined to another one.
  bool connectible() const;

  // True if some lobe scatters to the other side of Ng.
  bool transmits() const;

  // sum of f_l |wi . N_l| over the lobes that are not deltas (Cycles' meaning of a closure).
  Rgb eval_cos(vec3 wo, vec3 wi) const;

  // eval_cos in Radiance mode. In Importance mode times |wo . Ng| / |wi . Ng|: the cosine that a
  // light subpath needs with shading normals (Veach 1997, eq. 5.18).
  Rgb eval(vec3 wo, vec3 wi, TransportMode mode) const;

  BsdfEval evaluate(vec3 wo, vec3 wi, TransportMode mode) const {
    return {eval(wo, wi, mode), pdf_solid(wo, wi, TransportMode::Radiance),
            pdf_solid(wo, wi, TransportMode::Importance)};
  }

  // Density with which sample() draws wi from wo (Radiance) or wo from wi (Importance); delta
  // lobes contribute nothing.
  float pdf_solid(vec3 wo, vec3 wi, TransportMode mode) const;

  // Draws the direction on the other side of `from`; nullopt when the walk is absorbed.
  std::optional<BsdfSample> sample(vec3 from, float u_lobe, vec2 u, TransportMode mode) const;

  // A cheap estimate of the largest value of f (without the cosine), for roulette.
  float peak() const {
    float sum = 0.0f;
    for (const Lobe& lobe : lobes_) {
      sum += is_delta(lobe) ? 0.0f : max_component(lobe.weight) * kInvPi;
    }
    return sum;
  }

  std::span<const Lobe> lobes() const { return lobes_; }
  vec3 ng() const { return ng_; }

 private:
  std::span<const Lobe> lobes_;
  vec3 ng_;
};

inline constexpr int kMaxLobes = 8;

// Owning storage for up to kMaxLobes lobes.
class Bsdf {
 public:
  // Adds a lobe; false if the store is full (the compiler has said so in a diagnostic).
  bool add(const Lobe& lobe) {
    if (count_ == kMaxLobes) {
      return false;
    }
    lobes_[count_++] = lobe;
    return true;
  }
  void clear() { count_ = 0; }

  // An estimate of the share of light that the lobes scatter.
  float albedo() const { return albedo_; }

  // Sets the selection probabilities in proportion to the lobes' average weights.
  void finish();

  BsdfView view(vec3 ng) const { return {std::span(lobes_.data(), count_), ng}; }
  int size() const { return count_; }

 private:
  std::array<Lobe, kMaxLobes> lobes_;
  int count_ = 0;
  float albedo_ = 0.0f;
};

}  // namespace janus
