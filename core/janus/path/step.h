// SPDX-License-Identifier: GPL-3.0-or-later
//
// From a vertex of a subpath to the segment after it.
#pragma once

#include "janus/path/catching.h"
#include "janus/path/clear_view.h"
#include "janus/path/subsurface.h"

namespace janus {

struct WalkSettings : PathRules {
  bool roulette = true;
  bool specular = false;  // a camera walk ends where it does not scatter by a delta
};

// State of a walk between two vertices.
struct WalkStep {
  Ray ray;
  Departure left;
  ClassSums behind;
  Rgb beta;
  float cos_previous;
  RayType label = RayType::Diffuse;  // if PathRules::labels()
  // Of the vertex, for the light that comes next; if PathRules::ray_types.
  Rgb value = Rgb(1.0f), diffuse = Rgb(0.0f);
  bool transmitted = false;
  bool clear = false;  // the vertex kept a clear view, or would hide what is hidden

  Rgb lit_share(RayMask visibility) const {
    return janus::lit_share(value, diffuse, transmitted, visibility);
  }
};

// Takes the expressions past `v`, whose event has got `label`.
void read_event(const PathVertex& v, const BsdfSample& sample, TransportMode mode,
                const WalkSettings& settings, const Sampler& sampler, RayType label);

// What a walk does next.
enum class Turn { Ends, GoesOn, ComesUp };

// Scatters at `v`, applies roulette and writes `step`. `start`: throughput 1 of this walk;
// `eta_scale`: product of the refractions so far. Where the walk has gone below the surface and
// comes up, `v` is its other end.
inline Turn scatter(const Scene& scene, PathVertex& v, const Mis& mis, Sampler& sampler,
                    TransportMode mode, const WalkSettings& settings, float start, float& eta_scale,
                    uint64_t& rays, WalkStep& step) {
  const float u_lobe = sampler.next_1d();
  const vec2 u = sampler.next_2d();
  const auto sample = v.bsdf().sample(v.back, u_lobe, u, mode);
  if (!sample) {
    return Turn::Ends;
  }
  if (sample->below >= 0) [[unlikely]] {
    return come_up(scene, mis, *sample, mode, settings.roulette, sampler, rays, v) ? Turn::ComesUp
                                                                                   : Turn::Ends;
  }
  Rgb beta = v.beta * sample->weight;
  if (settings.labels()) {
    LabelShares shares = LabelShares::sampled(*sample);
    if (settings.ray_types) {
      step.value = sample->weight;
      step.diffuse = sample->diffuse;
      step.transmitted = sample->transmitted;
      if (mode == TransportMode::Importance) {
        shares = shares.within(v.possible_labels(sample->delta));
        beta *= shares.sum() * (v.edges == 1 ? step.lit_share(v.source) : Rgb(1.0f));
      }
    }
    if (shares.sum() == 0.0f) {
      return Turn::Ends;
    }
    step.label = shares.draw(sampler);
  }
  step.clear = settings.clear_glass >= 0.0f &&
               (mode == TransportMode::Radiance ? v.clear : v.hidden) &&
               leaves_clear(settings, v, *sample, mode, sampler);
  if (v.trace) {
    read_event(v, *sample, mode, settings, sampler, step.label);
  }
  eta_scale *= sample->eta_scale;
  const float q = settings.roulette ? survival(beta / start, eta_scale, v.edges) : 1.0f;
  if (is_black(beta) || !is_finite(beta) || (q < 1.0f && sampler.next_1d() >= q)) {
    return Turn::Ends;
  }
  const vec3 d = sample->direction;
  step.ray.origin = offset_origin(v.hit.p, v.hit.ng, v.hit.offset, d);
  step.ray.direction = d;
  step.ray.t_max = kInfinity;
  step.left = {sample->delta, sample->pdf_solid, sample->pdf_reverse};
  step.behind = mis.behind(v.mis, sample->delta, sample->pdf_reverse);
  step.beta = beta / q;
  step.cos_previous = std::abs(dot(d, v.hit.ng));
  return Turn::GoesOn;
}

}  // namespace janus
