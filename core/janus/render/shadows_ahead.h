// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bit>

#include "janus/math/vec.h"
#include "janus/scene/ray_type.h"

namespace janus {

// What lies before the lights on a ray, as the shadow rays of all lights see it: they may be of
// several types, and each meets other objects.
class ShadowsAhead {
 public:
  // `types`: Scene::shadow_types; `crossings`: of transparent surfaces that the path has so far.
  ShadowsAhead(RayMask types, int crossings, int max_crossings)
      : types_(types), left_(max_crossings - crossings) {
    for_each([&](int i, RayType) {
      through_[i] = Rgb(1.0f);
      crossings_[i] = 0;
    });
  }

  // What comes through to a shadow ray of this type, which is one of them.
  Rgb through(RayType type) const { return through_[std::popcount(types_ & (ray_bit(type) - 1))]; }

  // The ray goes on behind something that rays of `visibility` meet.
  void meet(RayMask visibility, Rgb transparency) {
    for_each([&](int i, RayType type) {
      if (contains(visibility, type)) {
        through_[i] *= crossings_[i]++ < left_ ? transparency : Rgb(0.0f);
      }
    });
  }

  // What the ray has crossed, as the first of the types counts it.
  int crossings() const { return types_ == 0 ? 0 : crossings_[0]; }

  // Can no light be seen any more?
  bool ended() const {
    bool dark = true;
    for_each([&](int i, RayType) { dark = dark && is_black(through_[i]); });
    return dark;
  }

 private:
  template <class F>
  void for_each(F&& f) const {
    int i = 0;
    for (RayMask rest = types_; rest != 0; rest &= rest - 1) {
      f(i++, first_type(rest));
    }
  }

  RayMask types_;
  int left_;
  Rgb through_[kMostShadowSets + 2];  // of the types, in their order
  int crossings_[kMostShadowSets + 2];
};

}  // namespace janus
