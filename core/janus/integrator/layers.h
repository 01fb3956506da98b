// SPDX-License-Identifier: GPL-3.0-or-later
//
// What integrators add to the layers of the film: first one for each light path expression, then
// the colours of surfaces, then the images of strategies, then what shadow catchers need.
#pragma once

#include "janus/film/film.h"
#include "janus/integrator/strategies.h"
#include "janus/path/catching.h"
#include "janus/path/match.h"
#include "janus/shading/surface_color.h"

namespace janus {

struct Layers {
  size_t expressions = 0;  // how many of them
  bool colors = false;     // what the camera sees, by kind: three layers
  int longest = 0;         // each strategy has images for paths of so many edges; 0: no images
  bool caught = false;     // light that belongs to shadow catchers
  bool matte = false;      // and, beside it, all other light, and what is covered by that

  // Each strategy has an image with its weights and, after it, one without: all light that it finds
  // alone. Strategies are in the order of their edges, then of s. Light straight into the camera
  // has only s=0.
  size_t strategy(Technique technique) const {
    const int k = technique.edges();
    const int shorter = k * (k + 1) / 2 - 1;  // 1 of one edge, k + 1 of k edges
    return first_strategy() + 2 * static_cast<size_t>(k == 1 ? 0 : shorter - 1 + technique.s);
  }
  // The weighted image of all that is longer.
  size_t longer() const { return strategy({0, longest + 2}); }

  // Of what surfaces scatter diffusely; then glossily, then what they transmit.
  size_t first_color() const { return expressions; }
  bool is_color(size_t layer) const { return layer >= first_color() && layer < first_strategy(); }

  // Of shadow catchers; what they hide of the background; light that belongs to none of them; how
  // much of a pixel does, and how much of it they cover.
  size_t caught_light() const { return longest > 0 ? longer() + 1 : first_strategy(); }
  size_t behind() const { return caught_light() + 1; }
  size_t matte_light() const { return caught_light() + 2; }
  size_t shares() const { return caught_light() + 3; }

  size_t count() const { return caught_light() + (caught ? 1 : 0) + (matte ? 3 : 0); }
  bool any() const { return count() > 0; }

  // Calls add(LayerMask, value) for the layers that show a part of `value`, to which a weight of
  // `weight` has been applied. `automaton`: null without expressions. As in Cycles, these show no
  // light that belongs to shadow catchers: their sum is the picture.
  template <class Add>
  void spread(Rgb value, float weight, Technique technique, const PathAutomaton* automaton,
              const SortedPath& path, Add&& add) const {
    if (caught && (path.caught || matte)) {
      add(LayerMask{1, catching(path.caught)}, value);
    }
    if (automaton && !path.caught) {
      for_each_match(*automaton, path, [&](ExpressionMask which, Rgb share) {
        add(LayerMask{which}, value * share);
      });
    }
    if (longest == 0) {
      return;
    }
    if (technique.edges() > longest) {
      add(LayerMask{1, static_cast<uint32_t>(longer())}, value);
      return;
    }
    const auto layer = static_cast<uint32_t>(strategy(technique));
    add(LayerMask{1, layer}, value);
    if (weight > 0.0f) {
      add(LayerMask{1, layer + 1}, value / weight);
    }
  }

  // Adds the colours of what the camera sees, through `beta`, to the layers of its pixel.
  void add_color(const BsdfView& bsdf, vec3 wo, Rgb beta, std::span<Rgb> layers) const {
    const SurfaceColor color = surface_color(bsdf, wo);
    layers[first_color()] += beta * color.diffuse;
    layers[first_color() + 1] += beta * color.glossy;
    layers[first_color() + 2] += beta * color.transmission;
  }

  // Where the light of a path goes, if there are layers for it.
  uint32_t catching(bool belongs) const {
    return static_cast<uint32_t>(belongs ? caught_light() : matte_light());
  }
  void add_coverage(const ViewCoverage& coverage, std::span<Rgb> layers) const {
    layers[behind()] += coverage.behind;
    layers[shares()] += Rgb(coverage.matte, coverage.caught, 0.0f);
  }

 private:
  size_t first_strategy() const { return first_color() + (colors ? 3 : 0); }
};

}  // namespace janus
