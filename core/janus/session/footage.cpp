// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/session/footage.h"

#include <algorithm>

namespace janus {

Image shadows_on_footage(const FootageFilms& films) {
  const Image caught = films.whole.develop_layer(films.layers.caught_light());
  const Image before = films.alone.develop_layer(layers_of_catchers().caught_light());
  const Image shares = films.whole.develop_layer(films.layers.shares());
  const Image whole = films.whole.develop();
  Image factor(caught.width, caught.height, 3);
  for (size_t i = 0; i < factor.pixels.size(); ++i) {
    // Beside an edge, splats may come where the camera has seen none of the catcher.
    const bool seen = shares.pixels[i / 3 * 3 + 1] > 0.0f && before.pixels[i] != 0.0f;
    const float ratio = seen ? caught.pixels[i] / before.pixels[i] : 1.0f;
    const float alpha = std::clamp(whole.pixels[i / 3 * 4 + 3], 0.0f, 1.0f);
    // The ratio knows nothing of how much there is of the catcher: none in an empty pixel.
    factor.pixels[i] = (1.0f - alpha) + alpha * ratio;
  }
  return factor;
}

Image lay_over_footage(const FootageFilms& films, bool background, bool apart, float exposure) {
  const Image light = films.whole.develop_layer(films.layers.matte_light(), exposure);
  const Image shares = films.whole.develop_layer(films.layers.shares());
  const Image behind = films.whole.develop_layer(films.layers.behind(), exposure);
  const Image factor = shadows_on_footage(films);
  Image image(light.width, light.height, 4);
  for (size_t i = 0; i < light.pixels.size() / 3; ++i) {
    const float* f = &factor.pixels[3 * i];
    const float left = apart ? 1.0f : std::clamp((f[0] + f[1] + f[2]) / 3.0f, 0.0f, 1.0f);
    const float alpha = std::clamp(shares.pixels[3 * i], 0.0f, 1.0f);
    for (size_t c = 0; c < 3; ++c) {
      const float shown = background && !apart ? behind.pixels[3 * i + c] * left : 0.0f;
      image.pixels[4 * i + c] = light.pixels[3 * i + c] + shown;
    }
    image.pixels[4 * i + 3] = background && !apart ? 1.0f : alpha + (1.0f - alpha) * (1.0f - left);
  }
  return image;
}

}  // namespace janus
