// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "janus/film/filter.h"
#include "janus/image/image.h"
#include "janus/math/vec.h"
#include "janus/util/parallel.h"

namespace janus {

// Pixels [x0, x1) x [y0, y1) of a full frame, from the bottom left.
struct FilmRect {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  size_t pixels() const { return static_cast<size_t>(width()) * height(); }
};

// A t=1 contribution at a raster position of the full frame, already divided by the number of
// light paths of the pass.
struct Splat {
  vec2 raster;
  Rgb value;
};

// A contribution to layers: to `first` + i for each bit i.
struct LayerMask {
  uint64_t bits;
  uint32_t first = 0;

  template <class F>
  void for_each(F&& f) const {
    for (uint64_t rest = bits; rest != 0; rest &= rest - 1) {
      f(first + static_cast<size_t>(std::countr_zero(rest)));
    }
  }
};
struct LayerSplat {
  vec2 raster;
  Rgb value;
  bool picture;  // also one to the picture
  LayerMask layers;
};

// Accumulates whole passes. A pass writes its camera samples (one per pixel, each pixel by one
// thread) and its splats; end_pass() adds both to the sums, so an abandoned pass leaves no trace.
// Every sum is taken in a fixed order, so the image does not depend on the number of threads.
//
// Layers are more pictures, in colour alone, to which integrators add what they want to show apart.
//
// Pixels may stop when they are good enough (adaptive sampling): they take part in no more passes,
// with neither samples nor splats, and are means over those that they took part in. As what stops
// a pixel is what it has got, that is a bias: what comes seldom is missed where it has not come
// yet.
class Film {
 public:
  // `adaptive`: pixels may stop.
  Film(FilmRect rect, Filter filter, size_t layers = 0, bool adaptive = false);

  // What one takes, bytes.
  static size_t bytes(const FilmRect& rect, size_t layers, bool adaptive = false) {
    const size_t picture = sizeof(vec4) + sizeof(Rgb) + sizeof(glm::dvec4);
    const size_t stops = adaptive ? sizeof(glm::dvec3) + sizeof(uint32_t) + 2 : 0;
    return rect.pixels() * (picture + stops + layers * (sizeof(Rgb) + sizeof(glm::dvec3)));
  }

  const FilmRect& rect() const { return rect_; }
  const Filter& filter() const { return filter_; }
  size_t layers() const { return layer_count_; }

  // The raster position of the sample for pixel `index` of the rect (row-major), u in [0,1)^2.
  vec2 sample_position(size_t index, vec2 u) const {
    const int w = rect_.width();
    const vec2 center(rect_.x0 + static_cast<int>(index % w) + 0.5f,
                      rect_.y0 + static_cast<int>(index / w) + 0.5f);
    return center + filter_.sample(u);
  }

  void begin_pass();
  // Adds to the pixel's sample of this pass. Calls for different pixels may run at once.
  void add_sample(size_t index, Rgb value, float alpha) { pass_[index] += vec4(value, alpha); }
  // Adds splats in the order given. `pool` spreads bands of rows; the result is the same.
  void add_splats(std::span<const std::vector<Splat>> blocks, ThreadPool& pool);
  void end_pass(ThreadPool& pool);

  // The layers of a pixel in this pass, to add to; as add_sample().
  std::span<Rgb> layers_at(size_t index) {
    return std::span(pass_layers_).subspan(index * layer_count_, layer_count_);
  }
  void add_splats(std::span<const std::vector<LayerSplat>> blocks, ThreadPool& pool);

  int passes() const { return passes_; }

  // Does the pixel take part in the next pass?
  bool active(size_t index) const { return stopped_.empty() || !stopped_[index]; }
  // How many do.
  size_t active_pixels() const { return active_pixels_; }

  // Between passes, of an adaptive film: stops pixels that are good enough, and whose neighbours
  // are. The measure is Cycles': how far the mean is from that of every second pass, relative to
  // the root of the brightness (where it is bright, to the brightness), with `exposure`.
  void stop_converged(float threshold, float exposure, ThreadPool& pool);

  // Between passes, of adaptive films: the same pixels stop as have stopped in `other`.
  void stop_with(const Film& other) {
    stopped_ = other.stopped_;
    active_pixels_ = other.active_pixels_;
  }

  // The mean of a pixel over the passes (at least one).
  Rgb mean(size_t index) const { return Rgb(sum_[index] / passes_of(index)); }

  // The mean over the passes: RGBA, premultiplied, its colour times `exposure`; black before the
  // first pass.
  Image develop(float exposure = 1.0f) const;
  // Of a layer: RGB.
  Image develop_layer(size_t layer, float exposure = 1.0f) const;

 private:
  template <class AnySplat, class Add>
  void for_each_splat(std::span<const std::vector<AnySplat>> blocks, ThreadPool& pool,
                      Add&& add) const;

  double passes_of(size_t index) const {
    return static_cast<double>(counts_.empty() ? static_cast<uint32_t>(passes_) : counts_[index]);
  }
  bool converged(size_t index, float threshold, float exposure) const;

  FilmRect rect_;
  Filter filter_;
  int passes_ = 0;
  std::vector<vec4> pass_;        // camera samples of the running pass
  std::vector<Rgb> pass_splats_;  // light image of the running pass
  std::vector<glm::dvec4> sum_;   // both, over whole passes
  size_t layer_count_;
  bool abandoned_ = false;              // was the last pass never ended?
  std::vector<Rgb> pass_layers_;        // all layers of a pixel in a row; samples and splats
  std::vector<glm::dvec3> sum_layers_;  // likewise
  // Of an adaptive film: colour over every second pass of a pixel, its passes, whether it was good
  // enough when it was last looked at, and whether it has stopped.
  std::vector<glm::dvec3> half_;
  std::vector<uint32_t> counts_;
  std::vector<uint8_t> converged_, stopped_;
  size_t active_pixels_;
};

}  // namespace janus
