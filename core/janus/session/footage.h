// SPDX-License-Identifier: GPL-3.0-or-later
//
// What becomes of shadow catchers when the film is developed, as in Cycles: the light on them,
// divided by their light in Scene::catchers_alone, is a factor for the footage that they stand for,
// and the picture is laid over that.
#pragma once

#include "janus/film/film.h"
#include "janus/integrator/layers.h"

namespace janus {

inline constexpr const char* kShadowCatcher = "Shadow Catcher";  // the pass

struct FootageFilms {
  const Film& whole;  // of the scene, with `layers`
  const Film& alone;  // of its catchers alone, with the layer of what is caught
  const Layers& layers;
};
// The layers of FootageFilms::alone.
inline Layers layers_of_catchers() {
  Layers layers;
  layers.caught = true;
  return layers;
}

// The factor: RGB. 1 where there are no catchers.
Image shadows_on_footage(const FootageFilms& films);

// RGBA. `background`: the film shows it, and the shadows fall on that; else they make the picture
// opaque and black. That knows no colour: a factor of the footage is more (`apart`), and the
// picture is without shadows then.
Image lay_over_footage(const FootageFilms& films, bool background, bool apart, float exposure);

}  // namespace janus
