// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/light/light_tree.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace janus {

namespace {

// Cosines below this count as this, and what lies less than this behind a horizon is not culled.
// Far above the rounding errors of the estimates.
constexpr float kGrazing = 0.01f;
// Where both sides of a node may shine, neither gets less than this: the estimates are rough, and
// what is chosen too seldom makes a firefly.
constexpr float kLeastShare = 1e-3f;
// Deeper nodes are split in the middle, so that a trail never needs more than 64 bits.
constexpr int kMaxUnbalanced = 36;

float sin_from_cos(float c) { return std::sqrt(std::max(0.0f, 1.0f - c * c)); }

// cos(max(0, a - b)).
float cos_minus(float cos_a, float cos_b, float sin_b) {
  return cos_a >= cos_b ? 1.0f : cos_a * cos_b + sin_from_cos(cos_a) * sin_b;
}

// Angles are taken in double precision, so that trees do not depend on the C library.
double angle(double cosine) { return std::acos(std::clamp(cosine, -1.0, 1.0)); }

// The directions of light of a set of emitters.
struct Cone {
  vec3 axis = vec3(0.0f, 0.0f, 1.0f);
  double theta_o = 0.0, theta_e = 0.0;
  bool two_sided = false;
};

// A cone around both: Conty Estevez & Kulla 2018, algorithm 1. With `two_sided` the sign of an axis
// is free.
Cone join(Cone a, Cone b) {
  if (a.theta_o < b.theta_o) {
    std::swap(a, b);
  }
  const bool two_sided = a.two_sided || b.two_sided;
  const double theta_e = std::max(a.theta_e, b.theta_e);
  if (two_sided && dot(a.axis, b.axis) < 0.0f) {
    b.axis = -b.axis;
  }
  const double theta_d = angle(dot(a.axis, b.axis));
  if (std::min(theta_d + b.theta_o, static_cast<double>(kPi)) <= a.theta_o) {
    return {a.axis, a.theta_o, theta_e, two_sided};
  }
  const double theta_o = 0.5 * (a.theta_o + theta_d + b.theta_o);
  const vec3 ortho = b.axis - dot(a.axis, b.axis) * a.axis;
  const float length = glm::length(ortho);
  if (theta_o >= kPi || length < 1e-6f) {
    return {a.axis, kPi, theta_e, two_sided};
  }
  const double turn = theta_o - a.theta_o;
  const vec3 axis = static_cast<float>(std::cos(turn)) * a.axis +
                    (static_cast<float>(std::sin(turn)) / length) * ortho;
  return {normalize(axis), theta_o, theta_e, two_sided};
}

struct Cluster {
  Bounds bounds;
  Cone cone;
  double strength = 0.0;
  bool empty = true;

  void extend(const Cluster& other) {
    if (other.empty) {
      return;
    }
    cone = empty ? other.cone : join(cone, other.cone);
    bounds.extend(other.bounds);
    strength += other.strength;
    empty = false;
  }

  // The surface area orientation heuristic (equation 1 of the paper).
  double cost() const {
    if (empty) {
      return 0.0;
    }
    const double o = cone.theta_o, w = std::min<double>(o + cone.theta_e, kPi);
    const double so = std::sin(o), co = std::cos(o);
    const double solid =
        2.0 * (1.0 - co) + 0.5 * (2.0 * w * so - std::cos(o - 2.0 * w) - 2.0 * o * so + co);
    const vec3 d = bounds.upper - bounds.lower;
    const double area = d.x * d.y + d.y * d.z + d.z * d.x;
    return strength * solid * area;
  }
};

Cluster cluster_of(const Emitter& e) {
  return {e.bounds, {e.axis, e.theta_o, e.theta_e, e.two_sided}, e.strength, false};
}

}  // namespace

float cos_receiver(const Receiver& receiver, vec3 direction, float cos_b, float sin_b) {
  float c = dot(receiver.n, direction);
  c = receiver.two_sided ? std::abs(c) : c;
  const float best = cos_minus(c, cos_b, sin_b);
  // Emitters are all over the angle: between the best and the middle.
  return best < -kGrazing ? 0.0f : std::max(0.5f * (best + std::max(c, 0.0f)), kGrazing);
}

struct LightTree::Build {
  LightTree& tree;
  const std::vector<Emitter>& emitters;
  std::vector<uint32_t> order;

  void run() {
    tree.nodes_.reserve(2 * order.size() - 1);
    node(0, order.size(), 0, 0);
  }

  void node(size_t begin, size_t end, uint64_t bits, int depth) {
    const size_t index = tree.nodes_.size();
    Cluster all;
    LinkMask links = 0;
    for (size_t i = begin; i < end; ++i) {
      all.extend(cluster_of(emitters[order[i]]));
      links |= emitters[order[i]].links;
    }
    const Cone& cone = all.cone;
    tree.nodes_.push_back(
        {all.bounds.center(), all.bounds.radius(), cone.axis, static_cast<float>(all.strength),
         static_cast<float>(std::cos(cone.theta_o)), static_cast<float>(std::sin(cone.theta_o)),
         static_cast<float>(std::cos(cone.theta_e)), links, 0, cone.two_sided});
    if (end - begin == 1) {
      tree.nodes_[index].next = kLeaf | order[begin];
      tree.trails_[order[begin]] = {bits, depth};
      return;
    }
    const size_t middle = split(begin, end, depth);
    node(begin, middle, bits, depth + 1);
    tree.nodes_[index].next = static_cast<uint32_t>(tree.nodes_.size());
    node(middle, end, bits | (uint64_t{1} << depth), depth + 1);
  }

  // Orders the range so that its two parts are [begin, result) and [result, end).
  size_t split(size_t begin, size_t end, int depth) {
    if (end - begin == 2) {
      return begin + 1;
    }
    Bounds centers;
    for (size_t i = begin; i < end; ++i) {
      centers.extend(center(order[i]));
    }
    const vec3 extent = centers.upper - centers.lower;
    const int axis = extent.x >= std::max(extent.y, extent.z) ? 0 : extent.y >= extent.z ? 1 : 2;
    const size_t middle = begin + (end - begin) / 2;
    const auto at = [&](size_t i) { return order.begin() + static_cast<std::ptrdiff_t>(i); };
    if (!(extent[axis] > 0.0f) || depth >= kMaxUnbalanced) {
      std::nth_element(at(begin), at(middle), at(end), [&](uint32_t a, uint32_t b) {
        const float ca = center(a)[axis], cb = center(b)[axis];
        return ca != cb ? ca < cb : a < b;
      });
      return middle;
    }
    constexpr int kBuckets = 12;
    const auto bucket = [&](uint32_t emitter) {
      const float x = (center(emitter)[axis] - centers.lower[axis]) / extent[axis];
      return std::clamp(static_cast<int>(x * kBuckets), 0, kBuckets - 1);
    };
    std::array<Cluster, kBuckets> parts, right;
    for (size_t i = begin; i < end; ++i) {
      parts[bucket(order[i])].extend(cluster_of(emitters[order[i]]));
    }
    for (int i = kBuckets - 1; i > 0; --i) {
      right[i - 1] = i + 1 < kBuckets ? right[i] : Cluster();
      right[i - 1].extend(parts[i]);
    }
    Cluster left;
    int best = 0;
    double best_cost = std::numeric_limits<double>::infinity();
    for (int i = 0; i + 1 < kBuckets; ++i) {
      left.extend(parts[i]);
      const double cost = left.cost() + right[i].cost();
      if (!left.empty && !right[i].empty && cost < best_cost) {
        best = i;
        best_cost = cost;
      }
    }
    // Both ends of the extent have an emitter, so both parts do.
    const auto cut =
        std::stable_partition(at(begin), at(end), [&](uint32_t e) { return bucket(e) <= best; });
    return static_cast<size_t>(cut - order.begin());
  }

  vec3 center(uint32_t emitter) const { return emitters[emitter].bounds.center(); }
};

LightTree::LightTree(const std::vector<Emitter>& emitters) : trails_(emitters.size()) {
  Build build{*this, emitters, {}};
  for (size_t i = 0; i < emitters.size(); ++i) {
    if (emitters[i].strength > 0.0f && !emitters[i].infinite) {
      build.order.push_back(static_cast<uint32_t>(i));
    }
  }
  if (!build.order.empty()) {
    build.run();
  }
}

float LightTree::importance(const Node& node, const Receiver& receiver) {
  if (!shines_on(node.links, receiver.unlit_by)) {
    return 0.0f;
  }
  const vec3 d = node.center - receiver.p;
  const float d2 = length2(d), r2 = sqr(node.radius);
  float cosines = 1.0f;
  if (d2 > r2) {  // otherwise light may come from anywhere
    const float inverse = 1.0f / std::sqrt(d2);
    const vec3 direction = inverse * d;
    const float sin_b = node.radius * inverse;
    const float cos_b = sin_from_cos(sin_b);
    cosines = cos_receiver(receiver, direction, cos_b, sin_b);
    if (cosines == 0.0f) {
      return 0.0f;
    }
    if (node.cos_o > -1.0f) {  // otherwise as bright on all sides
      const float c = -dot(node.axis, direction);
      const float outer = cos_minus(node.two_sided ? std::abs(c) : c, node.cos_o, node.sin_o);
      const float best = cos_minus(outer, cos_b, sin_b);
      if (best < node.cos_e - kGrazing) {
        return 0.0f;
      }
      cosines *= std::max(best, kGrazing);
    }
  }
  // The mean of 1 / distance^2 over the bounds grows towards their middle, but not without limit.
  return std::min(node.strength * cosines / (d2 + 0.3f * r2 + 1e-30f), 1e30f);
}

float LightTree::pmf_left(uint32_t node, const Receiver& receiver) const {
  const float left = importance(nodes_[node + 1], receiver);
  const float right = importance(nodes_[nodes_[node].next], receiver);
  if (left > 0.0f && right > 0.0f) {
    return std::clamp(left / (left + right), kLeastShare, 1.0f - kLeastShare);
  }
  // Nothing to choose: any choice will do, but it must be a choice.
  return left > 0.0f ? 1.0f : right > 0.0f ? 0.0f : 0.5f;
}

LightTree::Choice LightTree::sample(const Receiver& receiver, double u) const {
  uint32_t node = 0;
  float pmf = 1.0f;
  while (!(nodes_[node].next & kLeaf)) {
    const float left = pmf_left(node, receiver);
    if (u < left) {
      u /= left;
      pmf *= left;
      ++node;
    } else {
      // Not 1 - left < 1 exactly: rounding must not lead into a branch of probability zero.
      u = std::min((u - left) / (1.0 - left), 1.0 - 0x1p-53);
      pmf *= 1.0f - left;
      node = nodes_[node].next;
    }
  }
  return {nodes_[node].next & ~kLeaf, pmf};
}

float LightTree::pmf(const Receiver& receiver, uint32_t emitter) const {
  const Trail& trail = trails_[emitter];
  if (trail.depth < 0) {
    return 0.0f;
  }
  uint32_t node = 0;
  float pmf = 1.0f;
  for (int i = 0; i < trail.depth && pmf > 0.0f; ++i) {
    const float left = pmf_left(node, receiver);
    if (trail.bits >> i & 1) {
      pmf *= 1.0f - left;
      node = nodes_[node].next;
    } else {
      pmf *= left;
      ++node;
    }
  }
  return pmf;
}

}  // namespace janus
