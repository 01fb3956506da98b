// SPDX-License-Identifier: GPL-3.0-or-later
//
// A hierarchy of emitters that chooses one for a receiver, by how much light it may send there
// (Conty Estevez & Kulla 2018, "Importance Sampling of Many Lights with Adaptive Tree Splitting",
// in the form of Pharr, Jakob & Humphreys 2023, 12.6.3).
#pragma once

#include <cstdint>
#include <vector>

#include "janus/light/light.h"

namespace janus {

// A surface point that wants light, as the choice of a light may depend on it. Both walks must
// describe a vertex in the same way: `n` is Ng on the side of the vertex's camera direction, which
// for a surface that does not transmit is the side of the light, too.
struct Receiver {
  vec3 p;
  vec3 n;
  bool two_sided;         // can light from behind `n` matter? (transmission)
  LinkMask unlit_by = 0;  // ReceiverLinks

  bool lit_by(const Light& light) const { return shines_on(link_bit(light.link_set), unlit_by); }
};

// About the cosine at which a surface of `receiver` sees light from within an angle (`cos_b`,
// `sin_b`) around `direction`. 0 only if no light from there can reach the receiver, with a margin
// for rounding; otherwise never close to 0.
float cos_receiver(const Receiver& receiver, vec3 direction, float cos_b, float sin_b);

class LightTree {
 public:
  struct Choice {
    uint32_t emitter;
    float pmf;
  };

  LightTree() = default;
  // Finite emitters only. Those of strength 0 are never chosen.
  explicit LightTree(const std::vector<Emitter>& emitters);

  bool empty() const { return nodes_.empty(); }

  // About the irradiance of the receiver, W/m^2. 0 only if no emitter can reach it.
  float importance(const Receiver& receiver) const { return importance(nodes_.front(), receiver); }

  // An emitter, by its position in the list. Not for empty trees. `u` in [0, 1).
  Choice sample(const Receiver& receiver, double u) const;

  // The pmf of that choice: the same floating-point operations in the same order.
  float pmf(const Receiver& receiver, uint32_t emitter) const;

 private:
  static constexpr uint32_t kLeaf = 0x80000000U;

  struct Node {
    vec3 center;
    float radius;  // of the bounding sphere
    vec3 axis;
    float strength;             // sum
    float cos_o, sin_o, cos_e;  // bounds of theta_o and theta_e
    LinkMask links;             // of all
    uint32_t next;  // leaf: kLeaf | emitter; else the right child (the left one comes next)
    bool two_sided;
  };

  // The way from the root to a leaf, one bit per level: 1 is right.
  struct Trail {
    uint64_t bits = 0;
    int depth = -1;  // -1: not in the tree
  };

  struct Build;
  static float importance(const Node& node, const Receiver& receiver);
  float pmf_left(uint32_t node, const Receiver& receiver) const;

  std::vector<Node> nodes_;
  std::vector<Trail> trails_;  // by emitter
};

}  // namespace janus
