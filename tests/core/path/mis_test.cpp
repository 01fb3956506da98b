// SPDX-License-Identifier: GPL-3.0-or-later
//
// The recursion alone, on random numbers instead of paths: any lengths, deltas with different
// probabilities from both sides, lights that cannot be hit, any counts.
#include "janus/path/mis.h"

#include <gtest/gtest.h>

#include "support/statistics.h"

namespace janus::test {
namespace {

// Densities along z_0 ... z_k, as in path/mis.h.
struct RandomPath {
  int k;
  float joint, pdf_nee, pr_last;
  bool hittable;
  // At z_i: is it left by a delta; density of leaving towards the camera (light walk) and towards
  // the light (camera walk); cosine over squared distance to the neighbour on either side.
  bool delta[16];
  float forward[16], backward[16], to_light[16], to_camera[16];

  RandomPath(Random& random, int edges) : k(edges) {
    const auto density = [&] { return std::exp2(random.in(-3, 3)); };
    joint = density(), pdf_nee = density(), pr_last = density();
    hittable = random.next() < 0.7f;
    for (int i = 0; i < 16; ++i) {
      delta[i] = random.next() < 0.3f;
      forward[i] = density(), backward[i] = density();
      to_light[i] = density(), to_camera[i] = density();
    }
  }
  float pf(int i) const { return forward[i - 1] * to_light[i]; }
  float pr(int i) const {
    return i == k - 1 ? pr_last : i == 0 ? backward[1] : backward[i + 1] * to_camera[i];
  }
  bool allowed(int s) const {
    return s == 0   ? hittable
           : s == 1 ? !delta[1]
           : s == k ? !delta[k - 1]
                    : !delta[s - 1] && !delta[s];
  }
  double density(int s) const {
    double p = s == 0 ? pr(0) : s == 1 ? pdf_nee : joint;
    for (int i = 2; i < s; ++i) {
      p *= pf(i);
    }
    for (int i = std::max(1, s); i < k; ++i) {
      p *= pr(i);
    }
    return p;
  }
};

// Of a merge at z_i, 2 <= i < k.
double merge_density(const RandomPath& path, int i) { return path.density(i) * path.pf(i); }

float count(const SampleCounts& n, int s, int k) {
  return s == 0 ? n.hit : s == 1 ? n.nee : s == k ? n.splat : n.connection;
}

// The states of both subpaths, at z_light and at z_camera. `wrong` spoils one density.
std::pair<MisState, MisState> walked(const RandomPath& path, const Mis& mis, int to_light,
                                     int to_camera, float wrong) {
  MisState light = mis.begin_light(path.joint, path.pdf_nee, path.hittable);
  for (int i = 1; i < to_light; ++i) {
    light = mis.advance(mis.behind(light, path.delta[i], path.backward[i]), path.delta[i],
                        wrong * path.to_camera[i], path.pf(i + 1));
  }
  MisState camera = mis.begin_camera(path.pr(path.k - 1));
  for (int i = path.k - 1; i > to_camera; --i) {
    camera = mis.advance(mis.behind(camera, path.delta[i], path.forward[i]), path.delta[i],
                         path.to_light[i], path.pr(i - 1));
  }
  return {light, camera};
}

// The weight of technique s by the recursion. `wrong` spoils one density: a bug to be found.
float recursive_weight(const RandomPath& path, const Mis& mis, int s, float wrong = 1.0f) {
  const auto [light, camera] = walked(path, mis, s - 1, std::max(1, s), wrong);
  if (s == 0) {
    return mis
        .weight_hit(path.pr(0), path.delta[1], path.pdf_nee, path.joint,
                    mis.behind(camera, path.delta[1], path.forward[1]))
        .value;
  }
  if (s == 1) {
    return mis
        .weight_nee(path.pdf_nee, path.hittable ? path.pr(0) : 0.0f, path.joint, camera,
                    path.forward[1])
        .value;
  }
  if (s == path.k) {
    return mis.weight_splat(light, path.pr(s - 1), path.backward[s - 1]).value;
  }
  return mis
      .weight_connection(light, path.pr(s - 1), path.backward[s - 1], camera, path.pf(s),
                         path.forward[s])
      .value;
}

float recursive_weight_of_merge(const RandomPath& path, const Mis& mis, int i) {
  const auto [light, camera] = walked(path, mis, i, i, 1.0f);
  return mis.weight_merge(light, path.backward[i], camera, path.forward[i]).value;
}

class MisRecursion : public ::testing::TestWithParam<std::tuple<Heuristic, SampleCounts>> {};

TEST_P(MisRecursion, FollowsTheDefinition) {
  const auto& [heuristic, counts] = GetParam();
  const Mis mis(heuristic, counts);
  const double exponent = heuristic == Heuristic::Power ? 2 : 1;
  Random random(8);
  double spoilt = 0;
  for (int n = 0; n < 4000; ++n) {
    const RandomPath path(random, 2 + n % 6);
    double total = 0;
    for (int s = 0; s <= path.k; ++s) {
      total += path.allowed(s) ? std::pow(count(counts, s, path.k) * path.density(s), exponent) : 0;
    }
    for (int i = 2; i < path.k; ++i) {
      total += path.delta[i] ? 0 : std::pow(counts.merge * merge_density(path, i), exponent);
    }
    if (total == 0) {
      continue;
    }
    double sum = 0, spoilt_sum = 0;
    for (int s = 0; s <= path.k; ++s) {
      const float own = count(counts, s, path.k);
      if (path.allowed(s) && own > 0) {
        const float weight = recursive_weight(path, mis, s);
        EXPECT_NEAR(weight, std::pow(own * path.density(s), exponent) / total, 1e-5);
        sum += weight;
        spoilt_sum += recursive_weight(path, mis, s, 1.05f);
      }
    }
    for (int i = 2; i < path.k && counts.merge > 0; ++i) {
      if (!path.delta[i]) {
        const float weight = recursive_weight_of_merge(path, mis, i);
        EXPECT_NEAR(weight, std::pow(counts.merge * merge_density(path, i), exponent) / total,
                    1e-5);
        sum += weight;
        spoilt_sum += weight;
      }
    }
    EXPECT_NEAR(sum, 1, 2e-5);
    spoilt = std::max(spoilt, std::abs(spoilt_sum - 1));
  }
  // An error of 5 % in one factor is seen, wherever more than one technique is left.
  if (counts.splat > 0 && counts.hit + counts.nee > 0) {
    EXPECT_GT(spoilt, 1e-3);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Counts, MisRecursion,
    ::testing::Combine(::testing::Values(Heuristic::Balance, Heuristic::Power),
                       ::testing::Values(SampleCounts{1, 1, 1, 1}, SampleCounts{1, 1, 0.3f, 500},
                                         SampleCounts{0, 1, 1, 1}, SampleCounts{1, 0, 1, 1},
                                         SampleCounts{1, 1, 0, 20}, SampleCounts{1, 1, 1, 0},
                                         SampleCounts{1, 1, 0, 0}, SampleCounts{0, 0, 0, 3},
                                         SampleCounts{0, 0, 1, 0}, SampleCounts{1, 1, 1, 5, 2},
                                         SampleCounts{1, 1, 0.3f, 500, 0.2f},
                                         SampleCounts{0, 0, 0, 0, 1})));

}  // namespace
}  // namespace janus::test
