// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "janus/light/light.h"

namespace janus {

// Finds the lamps near a ray: those that rays meet without a surface, and the infinite lights.
class LampIndex {
 public:
  LampIndex() = default;

  // `lamps`: indices in `lights`, rising.
  LampIndex(const LightList& lights, const std::vector<size_t>& lamps);

  // Calls f(index of the light) for each lamp whose bounds the ray crosses before t_max, and for
  // each infinite light whatever t_max is; in the order of the indices.
  template <class F>
  void for_each_on_ray(const Ray& ray, F&& f) const {
    if (nodes_.empty()) {
      for (const uint32_t lamp : all_) {
        f(lamp);
      }
      return;
    }
    Found found;
    if (!find(ray, found)) {  // too many to sort here
      for (const uint32_t lamp : all_) {
        f(lamp);
      }
      return;
    }
    std::sort(found.lamps.begin(), found.lamps.begin() + found.count);
    for (size_t i = 0; i < found.count; ++i) {
      f(found.lamps[i]);
    }
  }

 private:
  static constexpr size_t kFew = 8;  // no hierarchy for so few finite lamps
  static constexpr size_t kMaxFound = 64;

  struct Found {
    std::array<uint32_t, kMaxFound> lamps;
    size_t count = 0;
    bool add(uint32_t lamp) {
      if (count == kMaxFound) {
        return false;
      }
      lamps[count++] = lamp;
      return true;
    }
  };
  struct Node {
    Bounds bounds;
    uint32_t next;  // leaf: kLeaf | lamp; else the right child (the left one comes next)
  };
  static constexpr uint32_t kLeaf = 0x80000000U;

  void build(std::vector<std::pair<Bounds, uint32_t>>& items, size_t begin, size_t end);
  bool find(const Ray& ray, Found& found) const;  // false: more than kMaxFound

  std::vector<uint32_t> all_, infinite_;
  std::vector<Node> nodes_;
};

}  // namespace janus
