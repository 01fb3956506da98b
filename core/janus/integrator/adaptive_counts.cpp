// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/integrator/adaptive_counts.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace janus {

namespace {

// A sample above this many times its block's value is a firefly whatever the counts: what all
// candidates share must not hide what tells them apart.
constexpr float kFirefly = 8.0f;

// Costs relative to a camera ray with its vertex and its next event estimation; measured over
// several scenes, within 15 %.
constexpr double kLightRay = 0.67, kSplatRay = 0.65, kConnection = 0.25;

double cost_of(const Effort& effort, const Counters& work) {
  const double camera = static_cast<double>(work.camera_rays);
  return camera + effort.light_paths * (kLightRay * work.light_rays + kSplatRay * work.splat_rays) +
         effort.connections * kConnection * work.connections;
}

}  // namespace

AdaptiveCounts::Moments& AdaptiveCounts::Moments::operator+=(const Moments& other) {
  for (size_t i = 0; i < kSize; ++i) {
    second[i] += other.second[i];
    steady[i] += other.steady[i];
  }
  return *this;
}

double AdaptiveCounts::cost(const Counters& work) { return cost_of({1.0f, 1.0f}, work); }

AdaptiveCounts::AdaptiveCounts(const SampleCounts& pilot)
    : pilot_{pilot.hit, pilot.nee, pilot.connection, pilot.splat} {
  for (size_t i = 0; i < kSize; ++i) {
    counts_[i] = {pilot.hit, pilot.nee, kCandidates[i].connections * pilot.connection,
                  kCandidates[i].light_paths * pilot.splat};
  }
}

bool AdaptiveCounts::ratios(const ClassSums& densities, std::array<float, kSize>& out) const {
  const float own = dot(pilot_, densities);
  for (size_t i = 0; i < kSize; ++i) {
    out[i] = own / dot(counts_[i], densities);
  }
  return std::isfinite(own);
}

void AdaptiveCounts::add(float value, const ClassSums& densities, Moments& moments) const {
  const float c = std::min(value, kFirefly);
  std::array<float, kSize> ratio;
  if (c > 0.0f && ratios(densities, ratio)) {
    for (size_t i = 0; i < kSize; ++i) {
      moments.second[i] += c * c * ratio[i];
    }
  }
}

void AdaptiveCounts::Gauge::add_single(Rgb value, const MisWeight& weight, int edges, bool nee) {
  if (!meter_) {
    return;
  }
  add(value, weight);
  const int group = 2 * (edges - 2) + nee;
  const float c = std::min(scale_ * average(value), kFirefly);
  std::array<float, kSize> ratio;
  if (group < kGroups && c > 0.0f && meter_->ratios(weight.densities, ratio)) {
    for (size_t i = 0; i < kSize; ++i) {
      means_[group][i] += c * ratio[i];
    }
  }
}

void AdaptiveCounts::Gauge::pair(const Gauge& neighbour) const {
  if (!meter_ || !neighbour.meter_) {
    return;
  }
  for (int group = 0; group < kGroups; ++group) {
    for (size_t i = 0; i < kSize; ++i) {
      moments_->steady[i] += means_[group][i] * neighbour.means_[group][i];
    }
  }
}

Effort AdaptiveCounts::choose(const Moments& moments, const Counters& work,
                              bool needs_light_paths) {
  // Noise below this share of the second moment is not measured well enough to decide anything.
  constexpr double kFloor = 1e-3;
  Effort best{1.0f, 1.0f};
  double least = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < kSize; ++i) {
    const Effort& effort = kCandidates[i];
    if (needs_light_paths && effort.connections == 0.0f) {
      continue;
    }
    const double variance =
        std::max(moments.second[i] - moments.steady[i], kFloor * moments.second[i]);
    if (const double product = variance * cost_of(effort, work); product < least) {
      least = product;
      best = effort;
    }
  }
  return best;
}

}  // namespace janus
