// SPDX-License-Identifier: GPL-3.0-or-later
//
// The ends of walks below a surface, as BsdfView has them: where one begins, and where it has come
// up.
#include "janus/math/frame.h"
#include "janus/math/warp.h"
#include "janus/shading/bsdf.h"
#include "janus/shading/diffuse_lobes.h"
#include "janus/shading/layers.h"
#include "janus/shading/sides.h"
#include "janus/shading/subsurface.h"

namespace janus {

namespace {

// Light falls in at the exit, Lambert around the normal of the Subsurface lobes, as it is seen from
// `arrival`, the last direction of a camera walk from below.
struct Exit {
  vec3 n;  // on the upper side, where `arrival` points
  bool bumped = false;

  Exit(std::span<const Lobe> lobes, vec3 ng, vec3 ns, vec3 arrival, float arrival_ng)
      : n(arrival_ng < 0.0f ? -ns : ns) {
    vec3 sum(0.0f);
    for (const Lobe& lobe : lobes) {
      if (lobe.type == LobeType::Subsurface) {
        sum += average(lobe.weight) * seen_normal(lobe, ng, arrival, arrival_ng);
        bumped |= lobe.bumped;
      }
    }
    if (const float length = glm::length(sum); bumped && length > 0.0f) {
      n = sum / length;
    }
  }
  // Cosine of light from `wi`, and what bumps leave of it.
  float cosine(vec3 wi) const { return std::max(dot(n, wi), 0.0f); }
  float lit(vec3 ns, vec3 wi) const { return bumped ? lit_bumps(n, ns, wi) : 1.0f; }
};

}  // namespace

BsdfEval BsdfView::evaluate_end(const Directions& d, TransportMode mode) const {
  if (kind_ == VertexKind::SubsurfaceExit) {
    return evaluate_exit(d);
  }
  const Lobe* lobe = light_passage(lobes_);
  return lobe ? evaluate_entry(*lobe, d, mode) : BsdfEval();
}

BsdfEval BsdfView::evaluate_entry(const Lobe& lobe, const Directions& d, TransportMode mode) const {
  BsdfEval e;
  const vec3 below = lobe.edge;
  const float below_ng = dot(below, ng_);
  if (!(d.wo_ng * below_ng < 0.0f)) {
    return e;
  }
  const float density = entry_density(lobe, seen_normal(lobe, ng_, d.wo, d.wo_ng), d.wo, below);
  const float adjoint = mode == TransportMode::Importance ? std::abs(d.wo_ng / below_ng) : 1.0f;
  e.f = lobe.weight * covers_transmittance(lobe, ng_, d.wo) * (density * adjoint);
  e.diffuse = e.f;
  e.pdf_radiance = pmf(lobe, grazing(d.wo_ng)) * density;
  e.pdf_importance = std::abs(d.wo_ng) * kInvPi;
  return e;
}

// From the camera's side alone; wo is where the walk came from, mirrored to the upper side.
BsdfEval BsdfView::evaluate_exit(const Directions& d) const {
  BsdfEval e;
  const Exit exit(lobes_, ng_, ns_, d.wo, d.wo_ng);
  const float cos = exit.cosine(d.wi);
  if (!d.same_side() || cos == 0.0f) {
    return e;
  }
  e.f = e.diffuse = Rgb(cos * kInvPi * exit.lit(ns_, d.wi));
  e.pdf_radiance = cos * kInvPi;
  const Lobe* lobe = light_passage(lobes_);
  e.pdf_importance = lobe ? pmf(*lobe, grazing(d.wi_ng)) : 0.0f;
  return e;
}

std::optional<BsdfSample> BsdfView::sample_end(vec3 from, vec2 u, TransportMode mode) const {
  const bool radiance = mode == TransportMode::Radiance;
  if (radiance != (kind_ == VertexKind::SubsurfaceExit)) {
    return std::nullopt;
  }
  const float from_ng = dot(from, ng_);
  const vec3 axis = radiance         ? Exit(lobes_, ng_, ns_, from, from_ng).n
                    : from_ng < 0.0f ? -ng_
                                     : ng_;
  const vec3 to = Frame(axis).to_world(square_to_cosine_hemisphere(u));
  const BsdfEval e = evaluate(radiance ? from : to, radiance ? to : from, mode);
  const float pdf = radiance ? e.pdf_radiance : e.pdf_importance;
  if (!(pdf > 0.0f)) {
    return std::nullopt;
  }
  BsdfSample sample{};
  sample.direction = to;
  sample.weight = sample.diffuse = e.f / pdf;
  sample.pdf_solid = pdf;
  sample.pdf_reverse = radiance ? e.pdf_importance : e.pdf_radiance;
  return sample;
}

std::optional<BsdfSample> BsdfView::sample_below(const Lobe& lobe, float chosen, vec3 from, vec2 u,
                                                 TransportMode mode) const {
  std::optional<BsdfSample> sample;
  const Lobe* passage = reshading_ || kind_ == VertexKind::OneWay ? nullptr : light_passage(lobes_);
  const float from_ng = dot(from, ng_);
  const vec3 down = from_ng < 0.0f ? ng_ : -ng_;
  if (mode == TransportMode::Importance) {
    const vec3 direction = Frame(down).to_world(square_to_cosine_hemisphere(u));
    const Exit exit(lobes_, ng_, ns_, -direction, -dot(direction, ng_));
    const float cos = exit.cosine(from);
    if (passage && cos > 0.0f) {
      sample.emplace();
      sample->direction = direction;
      sample->weight = Rgb(cos * exit.lit(ns_, from) / std::abs(from_ng) / chosen);
      sample->pdf_solid = chosen;  // that of the direction belongs to the walk
      sample->pdf_reverse = cos * kInvPi;
    }
  } else {
    const vec3 n = seen_normal(lobe, ng_, from, from_ng);
    const auto direction = sample_entry(lobe, n, from, u);
    if (direction && dot(*direction, down) > 0.0f) {
      sample.emplace();
      sample->direction = *direction;
      sample->weight = lobe.weight * covers_transmittance(lobe, ng_, from) / chosen;
      sample->pdf_solid = passage ? chosen * entry_density(lobe, n, from, *direction) : 1.0f;
      sample->pdf_reverse = passage ? std::abs(from_ng) * kInvPi : 0.0f;
    }
  }
  if (sample) {
    sample->delta = false;
    sample->below = static_cast<int>(&lobe - lobes_.data());
  }
  return sample;
}

}  // namespace janus
