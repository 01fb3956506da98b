// SPDX-License-Identifier: GPL-3.0-or-later
//
// Multiple importance sampling over all (s,t) techniques of a path, in constant time per join.
//
// A path z_0 (light) ... z_k (camera) can be made by k+1 techniques, named by the number s of
// vertices on the light side, in four classes with expected counts per pixel (SampleCounts):
//   hit (s=0), nee (s=1), connection (2 <= s <= k-1), splat (s=k, one camera vertex).
// A fifth class merges vertices (Georgiev et al. 2012): both walks arrive at z_i, 2 <= i <= k-1, so
// that its density is that of a connection with s=i times PF_i. Direct light is left to the others.
// PF_i and PR_i are the densities per area of z_i drawn from the light and from the camera side;
// PR_{k-1} is per pixel. z_0 is measured by its direction from z_1, so PR_0 and the density pN of
// next event estimation are per solid angle, and PF_0 PF_1 =: J is joint (see light.h).
//
// Along a subpath two sums are kept (Georgiev et al. 2012, in the form of Veach 1997, 10.2):
//   A: the technique that joins here, divided by the technique that continued to here;
//   B: all techniques further back, likewise, without the reverse pdf at the last vertex.
// Both are kept per class and without counts, so the counts may change from pass to pass and a
// class with count 0 needs no other code.
// Russian roulette appears in no density: weights are functions of the path alone.
// tests/core checks every weight against the definition (path/oracle.h).
#pragma once

#include <algorithm>
#include <cmath>

namespace janus {

enum class Heuristic { Balance, Power };

// Expected number of samples per pixel and pass by class. `connection` is C / v (C connections per
// camera vertex, v cached vertices expected per light path); `splat` is the number of all light
// paths of the pass; `merge` is pi r^2 times the number of light paths whose vertices are at hand.
struct SampleCounts {
  float hit = 1.0f, nee = 1.0f, connection = 0.0f, splat = 0.0f, merge = 0.0f;
};

// Density ratios by class.
struct ClassSums {
  float hit = 0.0f, nee = 0.0f, connection = 0.0f, splat = 0.0f, merge = 0.0f;

  ClassSums operator*(float x) const {
    return {hit * x, nee * x, connection * x, splat * x, merge * x};
  }
  ClassSums operator+(const ClassSums& o) const {
    return {hit + o.hit, nee + o.nee, connection + o.connection, splat + o.splat, merge + o.merge};
  }
};
inline float dot(const ClassSums& a, const ClassSums& b) {
  return a.hit * b.hit + a.nee * b.nee + a.connection * b.connection + a.splat * b.splat +
         a.merge * b.merge;
}

struct MisState {
  ClassSums a, b;
};

// What a path weighs in the technique that made it. `densities`: of all techniques that can make
// the path, without counts and relative to this one, which is among them as a 1. With them the
// weight for any other counts is a dot product away.
struct MisWeight {
  float value = 1.0f;
  ClassSums densities;
};

class Mis {
 public:
  Mis(Heuristic heuristic, const SampleCounts& counts)
      : power_(heuristic == Heuristic::Power),
        counts_{raise(counts.hit), raise(counts.nee), raise(counts.connection), raise(counts.splat),
                raise(counts.merge)} {}

  // At z_1, first vertex of a light subpath. `joint`: J; `pdf_nee`: pN; `hittable`: can a camera
  // path reach the light?
  MisState begin_light(float joint, float pdf_nee, bool hittable) const {
    MisState state;
    state.a.nee = raise(pdf_nee / joint);
    state.b.hit = hittable ? raise(1.0f / joint) : 0.0f;
    return state;
  }

  // At z_{k-1}, first vertex of a camera subpath, with PR_{k-1}. Merging at the vertex, here and in
  // `advance`, is as dense as going on, until the other side's density of the vertex comes in.
  MisState begin_camera(float pdf_area) const {
    MisState state;
    state.a.splat = raise(1.0f / pdf_area);
    state.a.merge = 1.0f;
    return state;
  }

  // What lies behind a vertex from which the walk went on: `delta` says how the event was
  // sampled, `pdf_reverse` is the density of the opposite walk leaving the vertex backwards.
  ClassSums behind(const MisState& state, bool delta, float pdf_reverse) const {
    const ClassSums b = state.b * raise(pdf_reverse);
    return delta ? b : state.a + b;
  }

  // At the next vertex of either subpath. `geometry_previous`: |cos| at the previous vertex over
  // the squared distance; `pdf_area`: density of the new vertex.
  MisState advance(const ClassSums& behind_previous, bool delta, float geometry_previous,
                   float pdf_area) const {
    MisState state;
    state.a.connection = delta ? 0.0f : raise(1.0f / pdf_area);
    state.a.merge = 1.0f;
    state.b = behind_previous * raise(geometry_previous / pdf_area);
    return state;
  }

  // At the other end of a vertex where a walk has gone below the surface (path/subsurface.h). A
  // camera walk comes up at the exit, a light walk at the entry. `pdf_reverse`: of the opposite
  // walk leaving the first end backwards; `ratio`: of the opposite walk's density between the ends
  // to this one's, whole but for what the opposite walk does at this end. Merging takes place at
  // the exit.
  MisState exit(MisState entry, float pdf_reverse, float ratio) const {
    entry.a.merge = 0.0f;
    MisState state;
    state.b = (entry.a + entry.b * raise(pdf_reverse)) * raise(ratio);
    state.a.merge = 1.0f;
    return state;
  }
  MisState entry(const MisState& exit, float pdf_reverse, float ratio) const {
    MisState state;
    state.b = (exit.a + exit.b * raise(pdf_reverse)) * raise(ratio);
    return state;
  }

  // s=0, k>=2: light found by the camera walk with density `pdf_solid` from z_1, where `behind`
  // lies behind z_1 and `delta` says how z_1 scattered.
  MisWeight weight_hit(float pdf_solid, bool delta, float pdf_nee, float joint,
                       const ClassSums& behind) const {
    ClassSums d = without_merge_at_z_1(behind, delta) * raise(joint / pdf_solid);
    d.nee += delta ? 0.0f : raise(pdf_nee / pdf_solid);
    d.hit += 1.0f;
    return weight(counts_.hit, d);
  }

  // s=1: next event estimation at z_1 with state `camera`. `pdf_hit`: density of the camera walk
  // going to the light (0 if it cannot be hit); `pdf_forward`: of a light walk leaving z_1 towards
  // the camera.
  MisWeight weight_nee(float pdf_nee, float pdf_hit, float joint, const MisState& camera,
                       float pdf_forward) const {
    ClassSums d = without_merge_at_z_1(sum(camera, pdf_forward), false) * raise(joint / pdf_nee);
    d.hit += raise(pdf_hit / pdf_nee);
    d.nee += 1.0f;
    return weight(counts_.nee, d);
  }

  // s>=2, t>=2. For each end: its state, the density per area with which the other end's walk
  // would have drawn it, and the density with which that walk would go on.
  MisWeight weight_connection(const MisState& light, float pdf_area_light, float pdf_on_light,
                              const MisState& camera, float pdf_area_camera,
                              float pdf_on_camera) const {
    ClassSums d = sum(light, pdf_on_light) * raise(pdf_area_light) +
                  sum(camera, pdf_on_camera) * raise(pdf_area_camera);
    d.connection += 1.0f;
    return weight(counts_.connection, d);
  }

  // Both subpaths end at z_i; for each end the density of the other walk leaving it in reverse.
  MisWeight weight_merge(const MisState& light, float pdf_on_light, const MisState& camera,
                         float pdf_on_camera) const {
    ClassSums d = sum(light, pdf_on_light) + sum(camera, pdf_on_camera);
    d.merge -= 1.0f;  // both have it
    return weight(counts_.merge, d);
  }

  // t=1: light subpath joined to the camera, which would have drawn the vertex with
  // `pdf_area_light` per pixel and gone on with `pdf_on_light`.
  MisWeight weight_splat(const MisState& light, float pdf_area_light, float pdf_on_light) const {
    ClassSums d = sum(light, pdf_on_light) * raise(pdf_area_light);
    d.splat += 1.0f;
    return weight(counts_.splat, d);
  }

 private:
  float raise(float x) const { return power_ ? x * x : x; }
  ClassSums sum(const MisState& state, float pdf_on) const {
    return state.a + state.b * raise(pdf_on);
  }
  // A camera walk does not know which vertex will be z_1. What is left of the 1 by rounding is
  // nothing beside the density of next event estimation.
  ClassSums without_merge_at_z_1(ClassSums behind, bool delta) const {
    behind.merge = std::max(behind.merge - (delta ? 0.0f : 1.0f), 0.0f);
    return behind;
  }
  MisWeight weight(float count, const ClassSums& densities) const {
    const float w = count / dot(counts_, densities);
    return {std::isfinite(w) ? w : 0.0f, densities};  // 0 * inf on absurdly long specular chains
  }

  bool power_;
  ClassSums counts_;
};

}  // namespace janus
