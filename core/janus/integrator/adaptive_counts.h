// SPDX-License-Identifier: GPL-3.0-or-later
//
// Efficiency-aware sample counts (Grittmann et al. 2022). A pass with known counts n tells what any
// other counts m would do: under the balance heuristic a sample contributes c = f / S_n, where S_n
// is the sum of n_t p_t over all techniques t, so the second moment with m is the sum of
// c^2 S_n / S_m over the samples of n, and S_m is a dot product (MisWeight::densities). The counts
// with the least variance times cost win. Cost comes from counted rays, never from a clock.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "janus/math/vec.h"
#include "janus/path/counters.h"
#include "janus/path/mis.h"

namespace janus {

// How much a pass does: light paths per pixel, connections per camera vertex.
struct Effort {
  float light_paths = 1.0f, connections = 1.0f;
  bool operator==(const Effort&) const = default;
};

class AdaptiveCounts {
 public:
  // The least that a pass keeps doing. What camera walks find once in a million, and then blinding
  // (the sun in a window, seen by a wall), a single pass cannot show; a few light paths find it far
  // more often, and their weights take it from the camera walks. Their rays are few (3 % of the
  // camera's in a garden); what costs a tenth is that camera walks keep densities for them.
  static constexpr float kInsurance = 1.0f / 32.0f;

  // Efforts relative to the measured pass, whose own is 1, 1; the first is nearly path tracing.
  static constexpr std::array<Effort, 13> kCandidates{{{kInsurance, 0.0f},
                                                       {0.25f, 0.0f},
                                                       {0.25f, 1.0f},
                                                       {0.25f, 4.0f},
                                                       {0.5f, 0.0f},
                                                       {0.5f, 1.0f},
                                                       {1.0f, 0.0f},
                                                       {1.0f, 1.0f},
                                                       {1.0f, 2.0f},
                                                       {1.0f, 4.0f},
                                                       {2.0f, 1.0f},
                                                       {2.0f, 2.0f},
                                                       {2.0f, 4.0f}}};
  static constexpr size_t kSize = kCandidates.size();
  using PerCandidate = std::array<double, kSize>;

  // Sums over samples, of values relative to the picture. Each writer has its own; they are added
  // in a fixed order.
  struct Moments {
    PerCandidate second{};  // second moments
    PerCandidate steady{};  // squares of the means that are no noise
    Moments& operator+=(const Moments& other);
  };

  // Takes the contributions of one sample to `moments`; without a meter it takes nothing. `value`:
  // what the block of the picture is worth (RouletteMap::value).
  class Gauge {
   public:
    Gauge() = default;
    Gauge(const AdaptiveCounts* meter, Moments& moments, float value)
        : meter_(value > 0.0f ? meter : nullptr), moments_(&moments), scale_(1.0f / value) {}

    // One contribution among many.
    void add(Rgb value, const MisWeight& weight) {
      if (meter_) {
        meter_->add(scale_ * average(value), weight.densities, *moments_);
      }
    }
    // The only one of its technique: `edges` of the path, found by next event estimation or a hit.
    void add_single(Rgb value, const MisWeight& weight, int edges, bool nee);

    // What recurs in neighbouring samples is no noise: the product of independent samples
    // estimates the squared mean.
    void pair(const Gauge& neighbour) const;

   private:
    // Hits and next event estimation, 2 and 3 edges; longer paths are hardly ever steady.
    static constexpr int kGroups = 4;
    const AdaptiveCounts* meter_ = nullptr;
    Moments* moments_ = nullptr;
    float scale_ = 0.0f;
    std::array<std::array<float, kSize>, kGroups> means_{};
  };

  // What the pass did, in camera rays with their vertices and next event estimation.
  static double cost(const Counters& work);

  // `pilot`: the counts of the measured pass.
  explicit AdaptiveCounts(const SampleCounts& pilot);

  // Adds a contribution, relative to its block of the picture, to the second moments.
  void add(float value, const ClassSums& densities, Moments& moments) const;

  // The candidate of least variance times cost, given what the pass did. `needs_light_paths`: there
  // are paths that only light walks and connections can make.
  static Effort choose(const Moments& moments, const Counters& work, bool needs_light_paths);

 private:
  // S_n / S_m of all candidates; false if a density has overflown.
  bool ratios(const ClassSums& densities, std::array<float, kSize>& out) const;

  ClassSums pilot_;
  std::array<ClassSums, kSize> counts_;
};

}  // namespace janus
