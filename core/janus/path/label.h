// SPDX-License-Identifier: GPL-3.0-or-later
//
// Labels of vertices: diffuse, glossy or transmission, as Cycles names the bounces of a path.
// Transmission is whatever goes to the other side, a reflection is diffuse or glossy by its lobe, a
// mirror counts as glossy. Where several lobes reflect smoothly into the same direction, the vertex
// has each of their labels by its share of f (a mean over the channels). The shares are a property
// of the path: walks draw a label, joins sum over them or draw one, and densities and weights do
// not know.
#pragma once

#include <bit>

#include "janus/sampling/sampler.h"
#include "janus/scene/ray_type.h"
#include "janus/shading/bsdf.h"
#include "janus/shading/path_so_far.h"

namespace janus {

// The shares of a vertex's labels; their sum is 1.
struct LabelShares {
  float of[3] = {};  // by RayType

  float operator[](RayType label) const { return of[static_cast<int>(label)]; }

  static LabelShares only(RayType label) {
    LabelShares shares;
    shares.of[static_cast<int>(label)] = 1.0f;
    return shares;
  }
  static LabelShares reflection(float diffuse) { return {{diffuse, 1.0f - diffuse, 0.0f}}; }

  // Of a vertex with value `e` for two directions on the same or on different sides of Ng.
  static LabelShares joined(const BsdfEval& e, bool transmitted) {
    return of_event(e.f, e.diffuse, transmitted);
  }
  static LabelShares sampled(const BsdfSample& sample) {
    return of_event(sample.weight, sample.diffuse, sample.transmitted);
  }

  // Those in `mask` alone.
  LabelShares within(RayMask mask) const {
    LabelShares rest;
    for (int i = 0; i < 3; ++i) {
      rest.of[i] = contains(mask, static_cast<RayType>(i)) ? of[i] : 0.0f;
    }
    return rest;
  }
  float sum() const { return of[0] + of[1] + of[2]; }

  // One label by chance, in proportion; some share is above 0. Takes a number only where there is a
  // choice.
  RayType draw(Sampler& sampler) const {
    if (of[2] > 0.0f) {
      return RayType::Transmission;
    }
    if (of[0] == 0.0f || of[1] == 0.0f) {
      return of[0] > 0.0f ? RayType::Diffuse : RayType::Glossy;
    }
    return sampler.next_1d() * sum() < of[0] ? RayType::Diffuse : RayType::Glossy;
  }

 private:
  static LabelShares of_event(Rgb value, Rgb diffuse, bool transmitted) {
    if (transmitted) {
      return only(RayType::Transmission);
    }
    return reflection(is_black(diffuse) ? 0.0f : std::min(average(diffuse) / average(value), 1.0f));
  }
};

// The share, by channel, of an event at z_1 that takes part where the light is visible to `mask`
// alone: `diffuse` of its `value` is due to diffuse lobes. As in Cycles, translucent lobes see a
// light as the others of these do.
inline Rgb lit_share(Rgb value, Rgb diffuse, bool transmitted, RayMask mask) {
  const bool rest = contains(mask, transmitted ? RayType::Transmission : RayType::Glossy);
  if (contains(mask, RayType::Diffuse) == rest) {
    return Rgb(rest ? 1.0f : 0.0f);
  }
  Rgb share(rest ? 1.0f : 0.0f);
  for (int c = 0; c < 3; ++c) {
    if (diffuse[c] > 0.0f) {
      const float part = std::min(diffuse[c] / value[c], 1.0f);
      share[c] = rest ? 1.0f - part : part;
    }
  }
  return share;
}

// --- What light path expressions tell apart (path/expression.h) ---

// Kinds of scattering; a specular event is that of a delta.
enum class Scattering : uint8_t { Diffuse, Glossy, Specular };

// A kind with its side, and a set of these.
using ScatterMask = uint8_t;
inline constexpr int kScatterEvents = 6;

constexpr int scatter_event(Scattering kind, bool transmitted) {
  return 2 * static_cast<int>(kind) + (transmitted ? 1 : 0);
}
// Both sides of a kind.
constexpr ScatterMask scatter_bit(Scattering kind) {
  return static_cast<ScatterMask>(0b11U << (2 * static_cast<unsigned>(kind)));
}
inline constexpr ScatterMask kAllScattering = 0b111111;
inline constexpr ScatterMask kReflections = 0b010101, kTransmissions = 0b101010;

// An event at a vertex once both directions are known: a part of it is diffuse, the rest glossy or
// specular. Members of one size, which copies of this can load as soon as they have been stored.
class ScatterShares {
 public:
  ScatterShares() {}  // not `= default`, which would set it to zero
  static ScatterShares joined(const BsdfEval& e, bool transmitted) {
    return {e.diffuse, e.f, transmitted, false};
  }
  static ScatterShares sampled(const BsdfSample& sample) {
    return {sample.diffuse, sample.weight, sample.transmitted, sample.delta};
  }

  // Calls f(event, share by channel) for its kinds.
  template <class F>
  void for_each(F&& f) const {
    if (std::has_single_bit(events_)) {
      f(std::countr_zero(events_), Rgb(1.0f));
    } else if (events_ != 0) {
      f(std::countr_zero(events_), diffuse_);
      f(std::bit_width(events_) - 1, Rgb(1.0f) - diffuse_);
    }
  }

  // The part where a light shines that is visible to `mask` alone; see lit_share().
  ScatterShares lit(RayMask mask) const {
    const bool rest = contains(mask, transmitted() ? RayType::Transmission : RayType::Glossy);
    return contains(mask, RayType::Diffuse) == rest ? *this : all(!rest);
  }
  // The part with one of these labels.
  ScatterShares within(RayMask labels) const { return transmitted() ? *this : lit(labels); }
  // That with a label which has been drawn.
  ScatterShares labelled(RayType label) const {
    return transmitted() ? *this : all(label == RayType::Diffuse);
  }

 private:
  static constexpr uint32_t kDiffuse = scatter_bit(Scattering::Diffuse);

  ScatterShares(Rgb diffuse, Rgb whole, bool transmitted, bool delta) {
    const uint32_t first = 1U << scatter_event(Scattering::Diffuse, transmitted);
    const uint32_t other =
        1U << scatter_event(delta ? Scattering::Specular : Scattering::Glossy, transmitted);
    if (is_black(diffuse)) {
      events_ = other;
    } else if (diffuse == whole) {
      events_ = first;
    } else {
      events_ = first | other;
      for (int c = 0; c < 3; ++c) {
        diffuse_[c] = diffuse[c] > 0.0f ? std::min(diffuse[c] / whole[c], 1.0f) : 0.0f;
      }
    }
  }
  bool transmitted() const { return (events_ & kTransmissions) != 0; }
  // Its diffuse kind, or its other one, as all that there is.
  ScatterShares all(bool diffuse) const {
    ScatterShares shares = *this;
    shares.events_ &= diffuse ? kDiffuse : ~kDiffuse;
    return shares;
  }

  uint32_t events_;  // bits by scatter_event(): a diffuse one, another, or both
  Rgb diffuse_;      // by channel, of both
};

}  // namespace janus
