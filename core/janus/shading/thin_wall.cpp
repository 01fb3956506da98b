// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/shading/thin_wall.h"

#include <algorithm>

#include "janus/shading/facet_lobes.h"

namespace janus {

ThinGlass thin_glass(const Lobe& side, Rgb tint, float cos) {
  const GlassEvents front(side, cos, side.ior);
  const float cos2_t = 1.0f - (1.0f - sqr(cos)) / sqr(side.ior);
  if (!(cos2_t > 0.0f)) {
    return {front.reflected, Rgb(0.0f)};
  }
  // Without a film both sides are alike.
  const float cos_t = std::sqrt(cos2_t);
  const GlassEvents back = film(side).exists() ? GlassEvents(side, cos_t, 1.0f / side.ior) : front;
  const Rgb kept = glm::pow(tint, Rgb(1.0f / cos_t));  // on one way across, by Beer's law
  const Rgb between = back.reflected * kept;
  // One way, one and two reflections, one and four ...
  const Rgb transmitted =
      front.transmitted * back.transmitted * kept / glm::max(1.0f - between * between, Rgb(1e-6f));
  return {front.reflected + transmitted * between, transmitted};
}

float thin_width(float alpha, float ior) {
  const float scale2 = 3.4f * (ior - 1.0f) * sqr(ior - 0.5f) / (ior * ior * ior);
  return std::min(1.0f, alpha * std::sqrt(std::max(0.0f, scale2)));
}

}  // namespace janus
