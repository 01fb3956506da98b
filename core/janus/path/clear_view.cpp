// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/path/clear_view.h"

namespace janus {

bool leaves_clear(const PathRules& rules, const PathVertex& v, const BsdfSample& sample,
                  TransportMode mode, Sampler& sampler) {
  if (!sample.transmitted || sample.delta) {
    return sample.transmitted;  // what is smooth is always clear
  }
  const bool radiance = mode == TransportMode::Radiance;
  const float share = clear_share(rules, v.bsdf(), radiance ? v.back : sample.direction,
                                  radiance ? sample.direction : v.back);
  return share > 0.0f && (share >= 1.0f || sampler.next_1d() < share);
}

}  // namespace janus
