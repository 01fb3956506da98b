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
  Rgb transparency = Rgb(0.0f);
};

// A compiled node graph. Its inputs are constants, so what is left of the graph is the list of
// closures with their shares; run() places them on the surface.
class Program {
 public:
  struct Instruction {
    LobeType type;
    Rgb weight;
    float ior = 1.0f;
  };

  std::vector<Instruction> instructions;
  Rgb emission = Rgb(0.0f);
  Rgb transparency = Rgb(0.0f);

  // `normal`: shading normal on the front side, unit.
  ShadingResult run(vec3 normal) const {
    ShadingResult result;
    run(normal, result);
    return result;
  }
  void run(vec3 normal, ShadingResult& result) const {
    result.bsdf.clear();
    for (const Instruction& i : instructions) {
      result.bsdf.add(Lobe{i.type, i.weight, normal, i.ior, 0.0f});
    }
    result.bsdf.finish();
    result.emission = emission;
    result.transparency = transparency;
  }
};

}  // namespace janus
