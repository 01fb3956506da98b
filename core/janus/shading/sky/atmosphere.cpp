// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/shading/sky/atmosphere.h"

#include <algorithm>
#include <deque>
#include <mutex>

#include "janus/shading/sky/models.h"
#include "janus/util/parallel.h"

namespace janus {

namespace {

constexpr size_t kKept = 8;  // pictures, 1.5 MB each

Image picture_of(const Atmosphere& atmosphere) {
  switch (atmosphere.model) {
    case Atmosphere::Model::SingleScattering:
      return single_scattering_picture(atmosphere);
    case Atmosphere::Model::Nishita:
      return nishita_picture(atmosphere);
    case Atmosphere::Model::MultipleScattering:
      break;
  }
  return multiple_scattering_picture(atmosphere);
}

}  // namespace

// That of Blender's colour management from 5.0 on; in older ones blue is 2.4e-4 brighter.
Rgb xyz_to_rgb(vec3 xyz) {
  return Rgb(dot(xyz, vec3(3.2409699f, -1.5373832f, -0.4986108f)),
             dot(xyz, vec3(-0.9692436f, 1.8759675f, 0.0415551f)),
             dot(xyz, vec3(0.0556301f, -0.2039770f, 1.0569715f)));
}

Image mirrored_picture(int rows, int first, const std::function<HalfRow(int row)>& left) {
  Image picture(kSkyColumns, rows, 3);
  ThreadPool(0).parallel_for(rows - first, [&](size_t i) {
    const int row = first + static_cast<int>(i);
    const HalfRow colors = left(row);
    float* pixels = &picture.pixels[static_cast<size_t>(row) * 3 * kSkyColumns];
    for (int x = 0; x < kSkyColumns; ++x) {
      const Rgb c = colors[std::min(x, kSkyColumns - 1 - x)];
      std::copy_n(&c.x, 3, pixels + 3 * x);
    }
  });
  return picture;
}

// Viewports commit their scene again with each change, and several programs may share a sky.
std::shared_ptr<const Image> sky_picture(const Atmosphere& atmosphere) {
  struct Kept {
    Atmosphere atmosphere;
    std::shared_ptr<const Image> picture;
  };
  static std::mutex mutex;
  static std::deque<Kept> kept;
  const std::lock_guard lock(mutex);
  const auto found = std::ranges::find(kept, atmosphere, &Kept::atmosphere);
  if (found != kept.end()) {
    return found->picture;
  }
  if (kept.size() == kKept) {
    kept.pop_front();
  }
  kept.push_back({atmosphere, std::make_shared<const Image>(picture_of(atmosphere))});
  return kept.back().picture;
}

Rgb sun_irradiance(const Atmosphere& atmosphere, float elevation) {
  return atmosphere.model == Atmosphere::Model::MultipleScattering
             ? multiple_scattering_sun(atmosphere, elevation)
             : single_scattering_sun(atmosphere, elevation);
}

}  // namespace janus
