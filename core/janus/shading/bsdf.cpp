// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/shading/bsdf.h"

#include "janus/shading/diffuse_lobes.h"
#include "janus/shading/fresnel.h"
#include "janus/shading/layers.h"
#include "janus/shading/scatter.h"

namespace janus {

namespace {

// d omega_o / d omega_i of a delta event: 1 for a reflection; for a refraction
// (eta_light / eta_camera)^2 |wi . N| / |wo . N|, because n^2 cos(theta) d omega is invariant.
float refraction_jacobian(vec3 wo, vec3 wi, vec3 n, float eta2_light_over_camera) {
  const float cos_o = std::abs(dot(wo, n));
  return cos_o > 0.0f ? eta2_light_over_camera * std::abs(dot(wi, n)) / cos_o : 0.0f;
}

// Inlined by hand: one of the hottest loops, in one place too many for the compiler.
[[gnu::always_inline]] inline void add_lobes(std::span<const Lobe> lobes, vec3 ng,
                                             const Directions& d, BsdfEval& sum) {
  const float grazing_o = grazing(d.wo_ng), grazing_i = grazing(d.wi_ng);
  for (const Lobe& lobe : lobes) {
    if (is_delta(lobe)) {
      continue;
    }
    LobeEval e = evaluate_lobe(lobe, ng, d);
    if (lobe.above && !is_black(e.f)) {
      e.f *= covers_transmittance(lobe, ng, d.wo);
    }
    sum.f += e.f;
    if (is_diffuse(lobe.type)) {
      sum.diffuse += e.f;
    }
    sum.pdf_radiance += pmf(lobe, grazing_o) * e.pdf_radiance;
    sum.pdf_importance += pmf(lobe, grazing_i) * e.pdf_importance;
  }
}

}  // namespace

void Bsdf::finish() {
  // No lobe is forgotten, whatever its albedo is thought to be.
  constexpr float kFloor = 0.01f;
  if (count_ == 1) {
    lobes_[0].pmf_normal = lobes_[0].pmf_grazing = 1.0f;
    return;
  }
  for (Lobe& lobe : lobes()) {
    const EstimatedAlbedo albedo = estimated_albedo(lobe);
    lobe.pmf_normal = albedo.normal;
    lobe.pmf_grazing = albedo.grazing;
  }
  for (float Lobe::* pmf : {&Lobe::pmf_normal, &Lobe::pmf_grazing}) {
    float sum = 0.0f, total = 0.0f;
    for (const Lobe& lobe : lobes()) {
      sum += lobe.*pmf;
    }
    for (Lobe& lobe : lobes()) {
      total += lobe.*pmf = std::max(lobe.*pmf, kFloor * sum);
    }
    const float scale = total > 0.0f ? 1.0f / total : 0.0f;
    for (Lobe& lobe : lobes()) {
      lobe.*pmf *= scale;
    }
  }
}

float Bsdf::albedo() const {
  float sum = 0.0f;
  for (const Lobe& lobe : lobes()) {
    sum += average(lobe.weight);
  }
  return sum;
}

float BsdfView::peak() const {
  constexpr float kUnknown = 1e15f;
  if (reshading_ || kind_ == VertexKind::SubsurfaceEntry) {
    return kUnknown;  // and roulette must not end what another view shows
  }
  float sum = 0.0f;
  for (const Lobe& lobe : lobes_) {
    if (is_fiber(lobe.type)) {
      return kUnknown;
    }
    if (!is_delta(lobe)) {
      float peak = kInvPi;
      if (has_facets(lobe.type)) {
        peak += 0.25f * kInvPi / (lobe.alpha * lobe.alpha_y);  // D / 4
      } else if (is_toon(lobe.type)) {
        peak = toon_density(lobe);
      }
      sum += max_component(lobe.weight) * peak;
    }
  }
  return sum;
}

bool BsdfView::connectible() const {
  if (reshading_) {
    return true;  // from somewhere
  }
  for (const Lobe& lobe : lobes_) {
    if (is_connectible(lobe)) {
      return true;
    }
  }
  return kind_ == VertexKind::SubsurfaceEntry || kind_ == VertexKind::SubsurfaceExit;
}

bool BsdfView::transmits() const {
  if (reshading_) {
    return may_transmit(*reshading_);
  }
  for (const Lobe& lobe : lobes_) {
    if (janus::transmits(lobe)) {
      return true;
    }
  }
  return false;
}

void BsdfView::reshade(const Directions& d, BsdfEval& sum) const {
  // The lobes at hand are those of the camera side or of the light side: get the others.
  const vec3 view = view_of(*reshading_);
  const bool camera = dot(view, d.wo) >= dot(view, d.wi);
  Bsdf other;
  lobes_for_view(*reshading_, camera ? d.wi : d.wo, other);
  BsdfEval seen;
  add_lobes(other.lobes(), ng_, d, seen);
  if (camera) {
    sum.pdf_importance = seen.pdf_importance;
  } else {
    seen.pdf_importance = sum.pdf_importance;
    sum = seen;
  }
}

Directions BsdfView::directions(vec3 wo, vec3 wi) const {
  return {wo, wi, dot(wo, ng_), dot(wi, ng_), ns_};
}

BsdfEval BsdfView::evaluate(vec3 wo, vec3 wi, TransportMode mode) const {
  const Directions d = directions(wo, wi);
  BsdfEval sum;
  if (d.wo_ng == 0.0f || d.wi_ng == 0.0f) {
    return sum;
  }
  if (kind_ > VertexKind::OneWay) [[unlikely]] {
    return evaluate_end(d, mode);
  }
  add_lobes(lobes_, ng_, d, sum);
  if (reshading_ && !alike(*reshading_, wo, wi)) {
    reshade(d, sum);
  }
  if (kind_ == VertexKind::OneWay) {
    sum.pdf_importance = 0.0f;
  }
  if (mode == TransportMode::Importance) {
    const float adjoint = std::abs(d.wo_ng / d.wi_ng);
    sum.f *= adjoint;
    sum.diffuse *= adjoint;
  }
  return sum;
}

float BsdfView::refracted_share(vec3 wo, vec3 wi, float max_alpha2) const {
  std::span<const Lobe> lobes = lobes_;
  Bsdf seen;
  if (reshading_ && !alike(*reshading_, wo, wi)) {
    lobes_for_view(*reshading_, wo, seen);
    lobes = seen.lobes();
  }
  const Directions d = directions(wo, wi);
  float all = 0.0f, clear = 0.0f;
  for (const Lobe& lobe : lobes) {
    if (!is_delta(lobe) && janus::transmits(lobe)) {
      const float f = average(evaluate_lobe(lobe, ng_, d).f * covers_transmittance(lobe, ng_, wo));
      all += f;
      clear += has_facets(lobe.type) && sqr(lobe.alpha) <= max_alpha2 ? f : 0.0f;
    }
  }
  return clear > 0.0f ? clear / all : 0.0f;
}

std::optional<BsdfSample> BsdfView::sample(vec3 from, float u_lobe, vec2 u,
                                           TransportMode mode) const {
  const float from_ng = dot(from, ng_);
  if (from_ng == 0.0f) {
    return std::nullopt;
  }
  if (kind_ > VertexKind::OneWay) [[unlikely]] {
    return sample_end(from, u, mode);
  }
  const float grazing_from = grazing(from_ng);
  const Lobe* lobe = nullptr;
  float chosen = 1.0f, u_event = 0.0f;
  for (const Lobe& candidate : lobes_) {
    const float p = pmf(candidate, grazing_from);
    if (p <= 0.0f) {
      continue;
    }
    lobe = &candidate;  // the last one also serves when rounding leaves u_lobe above every sum
    chosen = p;
    u_event = std::min(u_lobe / p, 1.0f - 0x1p-24f);
    if (u_lobe < p) {
      break;
    }
    u_lobe -= p;
  }
  if (!lobe) {
    return std::nullopt;
  }
  if (lobe->type == LobeType::Subsurface) {
    return sample_below(*lobe, chosen, from, u, mode);
  }
  return is_delta(*lobe) ? sample_event(*lobe, chosen, from, u.x, mode)
                         : sample_direction(*lobe, from, u_event, u, mode);
}

std::optional<BsdfSample> BsdfView::sample_direction(const Lobe& lobe, vec3 from, float u_event,
                                                     vec2 u, TransportMode mode) const {
  std::optional<BsdfSample> sample;
  if (kind_ == VertexKind::OneWay && mode == TransportMode::Importance) {
    return sample;
  }
  const auto to = sample_lobe(lobe, ng_, from, u_event, u, mode);
  if (!to) {
    return sample;
  }
  const bool radiance = mode == TransportMode::Radiance;
  const BsdfEval e = evaluate(radiance ? from : *to, radiance ? *to : from, mode);
  const float pdf = radiance ? e.pdf_radiance : e.pdf_importance;
  if (!(pdf > 0.0f)) {
    return sample;  // on the wrong side of the surface, or of the shading normal
  }
  sample.emplace();
  sample->direction = *to;
  sample->weight = e.f / pdf;
  sample->pdf_solid = pdf;
  sample->pdf_reverse = radiance ? e.pdf_importance : e.pdf_radiance;
  sample->delta = false;
  sample->transmitted = dot(from, ng_) * dot(*to, ng_) < 0.0f;
  sample->diffuse = e.diffuse / pdf;
  return sample;
}

std::optional<BsdfSample> BsdfView::sample_event(const Lobe& lobe, float chosen, vec3 from, float u,
                                                 TransportMode mode) const {
  const float from_ng = dot(from, ng_);
  const auto event = sample_delta(lobe, ng_, from, u, mode);
  if (!event) {
    return std::nullopt;
  }
  const vec3 to = event->direction;
  const float to_ng = dot(to, ng_);
  const bool radiance = mode == TransportMode::Radiance;
  // (index on the light side / index on the camera side)^2
  const float eta2 = radiance ? sqr(event->eta) : 1.0f / sqr(event->eta);
  const vec3 wo = radiance ? from : to, wi = radiance ? to : from;
  const float jacobian =
      event->transmitted ? refraction_jacobian(wo, wi, event->normal, eta2) : 1.0f;
  // The two walks measure their discrete event against different solid angles: beside the choice of
  // the lobe, the ratio of the densities is the jacobian.
  const float own = chosen * event->probability;
  float other = event->one_way || kind_ == VertexKind::OneWay
                    ? 0.0f
                    : pmf(lobe, grazing(to_ng)) * event->reverse;
  Rgb color = event->color * covers_transmittance(lobe, ng_, wo);
  if (reshading_ && !alike(*reshading_, from, to)) {
    reshade_event(lobe, from, u, mode, to, *event, color, other);
  }
  // A light walk gains the jacobian of the delta and the cosines of the adjoint (Veach 1997, 5.3).
  Rgb weight = color / chosen;
  if (!radiance) {
    weight *= jacobian * std::abs(to_ng / from_ng);
  }
  const float pdf_radiance = (radiance ? own : other) * jacobian;
  const float pdf_importance = radiance ? other : own;
  return BsdfSample{to,
                    weight,
                    radiance ? pdf_radiance : pdf_importance,
                    radiance ? pdf_importance : pdf_radiance,
                    true,
                    radiance ? 1.0f : eta2,
                    event->transmitted};
}

// What the lobes seen from `to` make of an event that `lobe`, seen from `from`, has made: the
// density of the opposite event (`other`), and on light walks, whose value is seen from there, the
// `color`.
void BsdfView::reshade_event(const Lobe& lobe, vec3 from, float u, TransportMode mode, vec3 to,
                             const DeltaEvent& event, Rgb& color, float& other) const {
  // The lobe's counterpart: the same kind of surface, in the same place among those of its kind.
  const auto same = [&](const Lobe& l) {
    return is_delta(l) && l.type == lobe.type && std::abs(l.ior - lobe.ior) < 1e-6f &&
           dot(l.normal, lobe.normal) > 0.99999f;
  };
  auto place = std::count_if(lobes_.data(), &lobe, same);
  Bsdf seen;
  lobes_for_view(*reshading_, to, seen);
  const Lobe* found = nullptr;
  for (const Lobe& candidate : seen.lobes()) {
    if (same(candidate) && place-- == 0) {
      found = &candidate;
    }
  }
  if (!found) {
    other = 0.0f;
    color = mode == TransportMode::Importance ? Rgb(0.0f) : color;
    return;
  }
  if (other > 0.0f) {
    other = pmf(*found, grazing(dot(to, ng_))) * event.reverse;
  }
  if (mode == TransportMode::Importance) {
    const auto same_event = sample_delta(*found, ng_, from, u, mode);
    color = same_event && dot(same_event->direction, to) > 0.9999f
                ? same_event->color * covers_transmittance(*found, ng_, to) *
                      (same_event->probability / event.probability)
                : Rgb(0.0f);
  }
}

}  // namespace janus
