// SPDX-License-Identifier: GPL-3.0-or-later
//
// What light paths add to the film in a pass. Each block of paths has a list of its own, which one
// thread fills; the film takes the lists in their order.
#pragma once

#include <algorithm>
#include <vector>

#include "janus/film/film.h"

namespace janus {

class Splats {
 public:
  // None yet, in `blocks` lists, which keep their memory.
  void start(size_t blocks) {
    picture_.resize(std::max(picture_.size(), blocks));
    layers_.resize(picture_.size());
    blocks_ = blocks;
    for (size_t i = 0; i < blocks; ++i) {
      picture_[i].clear();
      layers_[i].clear();
    }
  }

  // To the picture alone.
  void add(size_t block, vec2 raster, Rgb value) { picture_[block].push_back({raster, value}); }

  // To the picture and, in parts, to its layers: spread(add) calls add(LayerMask, part). Most often
  // a part is the whole, which the film then takes in one.
  template <class Spread>
  void add(size_t block, vec2 raster, Rgb value, Spread&& spread) {
    std::vector<LayerSplat>& list = layers_[block];
    LayerMask with_picture{0};
    spread([&](LayerMask mask, Rgb part) {
      if (part == value && mask.first == with_picture.first) {
        with_picture.bits |= mask.bits;
      } else {
        list.push_back({raster, part, false, mask});
      }
    });
    list.push_back({raster, value, true, with_picture});
  }

  void add_to(Film& film, ThreadPool& pool) const {
    film.add_splats(std::span(picture_).first(blocks_), pool);
    if (film.layers() > 0) {
      film.add_splats(std::span(layers_).first(blocks_), pool);
    }
  }

 private:
  std::vector<std::vector<Splat>> picture_;
  std::vector<std::vector<LayerSplat>> layers_;
  size_t blocks_ = 0;
};

}  // namespace janus
