// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "janus/math/vec.h"
#include "janus/shading/bsdf.h"

namespace janus {

// What a surface does at a point.
struct ShadingResult {
  Bsdf bsdf;
  Rgb emission = Rgb(0.0f);  // radiance, on both sides
  // Share of the light that passes straight through (Transparent BSDF, alpha): not a lobe, but a
  // crossing, which belongs to the walk.
  Rgb transparency = Rgb(0.0f);
};

// A compiled node graph. Its inputs are constants, so what is left of the graph is its lobes;
// run() places them on the surface.
class Program {
 public:
  std::vector<Lobe> lobes;  // with selection probabilities, without normals; at most kMaxLobes
  Rgb emission = Rgb(0.0f);
  Rgb transparency = Rgb(0.0f);
  bool sample_emission = true;  // MaterialDesc::sample_emission

  bool has_transparency() const { return !is_black(transparency); }

  // `normal`: shading normal on the front side, unit.
  ShadingResult run(vec3 normal) const {
    ShadingResult result;
    run(normal, result);
    return result;
  }
  void run(vec3 normal, ShadingResult& result) const {
    result.bsdf.clear();
    for (Lobe lobe : lobes) {
      lobe.normal = normal;
      result.bsdf.add(lobe);
    }
    result.emission = emission;
    result.transparency = transparency;
  }
};

}  // namespace janus
