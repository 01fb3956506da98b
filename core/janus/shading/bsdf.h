// SPDX-License-Identifier: GPL-3.0-or-later
//
// Scattering at a point, as a small array of lobes by value.
//
// Directions: `wo` points to the camera side of the path, `wi` to the light side; both unit, world
// space, away from the surface. Values have these roles from both walks; pdfs are per solid angle.
#pragma once

#include <algorithm>
#include <optional>
#include <span>

#include "janus/shading/lobe.h"

namespace janus {

// What a walk carries: Radiance on camera subpaths (wi is sampled), Importance on light subpaths
// (wo is sampled).
enum class TransportMode { Radiance, Importance };

struct Directions;

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
  bool transmitted = false;  // to the other side of Ng
  Rgb diffuse = Rgb(0.0f);   // what diffuse lobes add to `weight`; see BsdfEval::diffuse
  // The walk goes below the surface by this Subsurface lobe, in `direction`, and comes up elsewhere
  // (path/subsurface.h); -1: it does not. `weight` is then that of the end where it goes below, and
  // pdf_solid only its own density of doing so.
  int below = -1;
};

// Value and densities for a pair of directions, of the lobes that are not deltas.
struct BsdfEval {
  // sum of f_l |wi . N_l| in Cycles' meaning; in Importance mode times |wo . Ng| / |wi . Ng|, the
  // cosine that a light subpath needs with shading normals (Veach 1997, eq. 5.18).
  Rgb f = Rgb(0.0f);
  // Density with which sample() draws wi from wo in Radiance, and wo from wi in Importance mode.
  float pdf_radiance = 0.0f, pdf_importance = 0.0f;
  // What diffuse lobes add to f, translucent ones among them.
  Rgb diffuse = Rgb(0.0f);
};

// What a vertex is to the walks.
enum class VertexKind : uint8_t {
  Surface,
  // Light subpaths end there, so that their density, here and behind, is nought. Light goes through
  // a fibre in one event, at the point which the camera side sees: from the light's side that point
  // is behind the fibre, where no ray can find it. And what a surface does may depend on the path
  // from the camera that leads there (PathSoFar).
  OneWay,
  // Where a walk has come up from below: a light subpath at the entry, a camera subpath at the exit
  // (shading/subsurface.h). What is said to be the direction on the side that it comes from is
  // that in which it arrived, on the upper side.
  SubsurfaceEntry,
  SubsurfaceExit,
};

class Bsdf;
struct DeltaEvent;
struct Directions;
struct Reshading;

// The lobes of a surface that looks different from everywhere, seen from `view`; the direction for
// which those were made that its Bsdf holds; whether another direction needs others at all.
void lobes_for_view(const Reshading& reshading, vec3 view, Bsdf& lobes);
vec3 view_of(const Reshading& reshading);
bool alike(const Reshading& reshading, vec3 a, vec3 b);
bool may_transmit(const Reshading& reshading);

// A view of lobes at a point with geometric normal `ng` and shading normal `ns` (unit, front side).
// Lobes of a cache may leave out the deltas of the Bsdf that they come from.
//
// Where lobes depend on the view (`reshading`), the value is that of the lobes seen from the camera
// side; each density is that of the lobes seen from where its walk comes.
class BsdfView {
 public:
  BsdfView(std::span<const Lobe> lobes, vec3 ng, vec3 ns, const Reshading* reshading = nullptr,
           VertexKind kind = VertexKind::Surface)
      : lobes_(lobes), ng_(ng), ns_(ns), reshading_(reshading), kind_(kind) {}

  // True if some lobe scatters in more than one direction: the vertex can be joined to another one.
  bool connectible() const;

  // True if some lobe scatters to the other side of Ng.
  bool transmits() const;

  // A rough estimate of the largest value of f without the cosine, for roulette.
  float peak() const;

  BsdfEval evaluate(vec3 wo, vec3 wi, TransportMode mode) const;

  // Parts of evaluate().
  Rgb eval(vec3 wo, vec3 wi, TransportMode mode) const { return evaluate(wo, wi, mode).f; }
  Rgb eval_cos(vec3 wo, vec3 wi) const { return eval(wo, wi, TransportMode::Radiance); }
  float pdf_solid(vec3 wo, vec3 wi, TransportMode mode) const {
    const BsdfEval e = evaluate(wo, wi, mode);
    return mode == TransportMode::Radiance ? e.pdf_radiance : e.pdf_importance;
  }

  // The share, a mean over the channels, of lobes of glass whose squared GGX width is at most
  // `max_alpha2` in the value of a refraction from `wi` to `wo`. Not fast.
  float refracted_share(vec3 wo, vec3 wi, float max_alpha2) const;

  // Draws the direction on the other side of `from`; nullopt when the walk is absorbed.
  std::optional<BsdfSample> sample(vec3 from, float u_lobe, vec2 u, TransportMode mode) const;

  std::span<const Lobe> lobes() const { return lobes_; }
  vec3 ng() const { return ng_; }
  VertexKind kind() const { return kind_; }

 private:
  // Of ends of a walk below the surface, and how it begins: in subsurface_ends.cpp.
  BsdfEval evaluate_end(const Directions& d, TransportMode mode) const;
  BsdfEval evaluate_entry(const Lobe& lobe, const Directions& d, TransportMode mode) const;
  BsdfEval evaluate_exit(const Directions& d) const;
  std::optional<BsdfSample> sample_end(vec3 from, vec2 u, TransportMode mode) const;
  std::optional<BsdfSample> sample_below(const Lobe& lobe, float chosen, vec3 from, vec2 u,
                                         TransportMode mode) const;

  std::optional<BsdfSample> sample_direction(const Lobe& lobe, vec3 from, float u_event, vec2 u,
                                             TransportMode mode) const;
  std::optional<BsdfSample> sample_event(const Lobe& lobe, float chosen, vec3 from, float u,
                                         TransportMode mode) const;
  void reshade(const Directions& d, BsdfEval& sum) const;
  void reshade_event(const Lobe& lobe, vec3 from, float u, TransportMode mode, vec3 to,
                     const DeltaEvent& event, Rgb& color, float& other) const;

  Directions directions(vec3 wo, vec3 wi) const;

  std::span<const Lobe> lobes_;
  vec3 ng_, ns_;
  const Reshading* reshading_;
  VertexKind kind_;
};

inline constexpr int kMaxLobes = 12;

// Owning storage for up to kMaxLobes lobes. A copy costs what its lobes cost.
class Bsdf {
 public:
  Bsdf() = default;
  Bsdf(const Bsdf& other) { *this = other; }
  Bsdf& operator=(const Bsdf& other) {
    count_ = other.count_;
    kind_ = other.kind_;
    by_path_ = other.by_path_;
    std::copy_n(other.lobes_, count_, lobes_);
    return *this;
  }

  // Adds a lobe; false if the store is full (the compiler has said so in a diagnostic).
  bool add(const Lobe& lobe) {
    if (count_ == kMaxLobes) {
      return false;
    }
    lobes_[count_++] = lobe;
    return true;
  }
  // Adds one below the lobe at `layer`, which light has to get through first; nothing covers it
  // where that is below 0.
  bool add(const Lobe& lobe, int layer) {
    const bool added = add(lobe);
    if (added && layer >= 0) {
      lobes_[count_ - 1].above = static_cast<uint8_t>(count_ - 1 - layer);
    }
    return added;
  }
  void clear() { count_ = 0, kind_ = VertexKind::Surface, by_path_ = false; }

  VertexKind kind() const { return kind_; }
  bool one_way() const { return kind_ == VertexKind::OneWay || by_path_; }
  void set_kind(VertexKind kind) { kind_ = kind; }
  // Does the surface look different to each path? It is OneWay, then, at both ends of a walk below
  // it; nor do light subpaths know what it lets through.
  bool by_path() const { return by_path_; }
  void set_by_path() { by_path_ = true; }

  // An estimate of the share of light that is scattered.
  float albedo() const;

  // Sets the selection probabilities by the lobes' albedos.
  void finish();

  BsdfView view(vec3 ng, vec3 ns, const Reshading* reshading = nullptr) const {
    return {lobes(), ng, ns, reshading, kind_};
  }
  BsdfView view(vec3 n) const { return view(n, n); }
  std::span<const Lobe> lobes() const { return {lobes_, static_cast<size_t>(count_)}; }
  std::span<Lobe> lobes() { return {lobes_, static_cast<size_t>(count_)}; }
  int size() const { return count_; }

 private:
  int count_ = 0;
  VertexKind kind_ = VertexKind::Surface;
  bool by_path_ = false;
  Lobe lobes_[kMaxLobes];  // not initialised beyond the count
};

}  // namespace janus
