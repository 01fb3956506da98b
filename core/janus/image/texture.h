// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pictures as textures, with Blender's interpolations and extensions.
#pragma once

#include <memory>

#include "janus/image/image.h"
#include "janus/math/vec.h"

namespace janus {

enum class Interpolation { Linear, Closest, Cubic };
enum class Extension { Repeat, Extend, Clip, Mirror };

struct Texture {
  std::shared_ptr<const Image> image;  // not empty
  Interpolation interpolation = Interpolation::Linear;
  Extension extension = Extension::Repeat;
  bool srgb = false;  // encoded; decoded after interpolation, as in Cycles

  // RGBA as the image holds it (alpha 1 if it has none); (0, 0) is its lower left corner.
  vec4 lookup(vec2 uv) const;
  // Asks for the memory that the lookup will wait for.
  void prefetch(vec2 uv) const;
  // What was looked up, as scene-linear colour.
  vec4 decode(vec4 rgba) const;

  bool operator==(const Texture&) const = default;
};

}  // namespace janus
