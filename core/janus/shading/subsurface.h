// SPDX-License-Identifier: GPL-3.0-or-later
//
// Subsurface scattering by a random walk below the surface (Chiang et al. 2016, "Practical and
// Controllable Subsurface Scattering for Production Path Tracing"), as Cycles has it. Seen from the
// camera, light enters the surface through rough facets, whose density of directions is the
// entry's; it scatters in a medium of the entry's until it meets the surface from below, and leaves
// there as from a Lambert surface: the exit, which is where light from the scene falls.
//
// Entry and exit are the two ends of one vertex of a path. What lies between them has a value and,
// for either walk, a density, but no other vertex can be joined to it. Densities are per solid
// angle and length; those of the two walks are compared after both have gone the same way.
#pragma once

#include <optional>

#include "janus/shading/scatter.h"

namespace janus {

enum class SubsurfaceMethod : uint32_t {
  RandomWalk,  // albedo by d'Eon's fit (Blender 5.2 and later)
  Legacy,      // by Chiang's: what was called Random Walk before
  Skin,        // the same with another radius, and entry
};

// `radius`: mean free path by channel before the method's scale, metres, none below
// kLeastSubsurfaceRadius; `alpha`: width of the facets at the entry.
inline constexpr float kLeastSubsurfaceRadius = 1e-8f;
Lobe subsurface_lobe(SubsurfaceMethod method, Rgb weight, Rgb albedo, Rgb radius, float anisotropy,
                     float ior, float alpha);

// --- The ends ------------------------------------------------------------------------------------

// The direction below the surface in which a camera subpath from `wo` goes on, `n` being the lobe's
// normal on the side of wo; nullopt: it does not.
std::optional<vec3> sample_entry(const Lobe& lobe, vec3 n, vec3 wo, vec2 u);
// Its density per solid angle.
float entry_density(const Lobe& lobe, vec3 n, vec3 wo, vec3 below);

// The Subsurface lobe through which light subpaths go below, or come up, there; null: they don't.
// There has to be one medium alone, and an entry of many directions. Where scattering is
// anisotropic and made isotropic after some steps, walks from the other end can't know which ones:
// they would find little, by chance.
const Lobe* light_passage(std::span<const Lobe> lobes);

// --- Between them --------------------------------------------------------------------------------

// What lies below a Subsurface lobe. As in Cycles, after some steps anisotropic scattering is
// replaced by an isotropic one that is similar.
class SubsurfaceMedium {
 public:
  explicit SubsurfaceMedium(const Lobe& lobe);

  // The factor of the walk's value beside the lobe's weight, which holds the albedo.
  Rgb scale() const { return scale_; }

 private:
  friend class SubsurfaceWalker;

  struct Level {
    Rgb sigma_t, sigma_s;  // per metre
    float anisotropy;
    float guided;  // share of directions drawn towards the surface
  };

  const Level& level(int step) const { return levels_[step < kAnisotropicSteps ? 0 : 1]; }
  static constexpr int kAnisotropicSteps = 10;

  Rgb albedo_;  // of single scattering
  Rgb scale_;
  Level levels_[2];
  float diffusion_length_, phase_log_;  // of Dwivedi's sampling
};

// Walks through a medium, or goes a given way again.
class SubsurfaceWalker {
 public:
  // `normal`: of the surface where the walk starts, on its upper side.
  SubsurfaceWalker(const SubsurfaceMedium& medium, vec3 normal)
      : medium_(medium), normal_(normal) {}

  // Draws the next segment, which scatters after one in the direction `previous`; the first one
  // goes on in it. Numbers in [0, 1), of which the first one only needs `u_channel` and `u_length`.
  struct Segment {
    vec3 direction;
    float length;
  };
  Segment sample(vec3 previous, float u_channel, float u_length, float u_guide, vec2 u) const;

  // Goes along a segment; `arrived`: to the surface. The value is what the medium does to light on
  // the way, with the phase function at its start.
  struct Step {
    Rgb value;
    float pdf;
  };
  Step advance(const Segment& segment, bool arrived);

  // Value over density so far.
  Rgb throughput() const { return throughput_; }

 private:
  Rgb channel_pmf() const;

  const SubsurfaceMedium& medium_;
  vec3 normal_, previous_ = vec3(0.0f);
  Rgb throughput_ = Rgb(1.0f);
  int step_ = 0;
};

}  // namespace janus
