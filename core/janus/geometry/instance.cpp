// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/geometry/instance.h"

#include <algorithm>
#include <set>

namespace janus {

std::array<int, kRayTypes> first_alike(const std::vector<Instance>& instances) {
  std::set<RayMask> masks;  // that there are: few, however many instances
  for (const Instance& instance : instances) {
    masks.insert(instance.visibility);
  }
  const auto sees = [](RayMask mask, int type) {
    return contains(mask, static_cast<RayType>(type));
  };
  std::array<int, kRayTypes> first;
  for (int type = 0; type < kRayTypes; ++type) {
    first[type] = type;
    for (int other = 0; other < type && first[type] == type; ++other) {
      if (std::ranges::all_of(masks, [&](RayMask m) { return sees(m, type) == sees(m, other); })) {
        first[type] = first[other];
      }
    }
    if (std::ranges::all_of(masks, [&](RayMask m) { return sees(m, type); })) {
      first[type] = kRayTypes;
    }
  }
  return first;
}

}  // namespace janus
