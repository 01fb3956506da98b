// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/film/film.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace janus {

namespace {
constexpr int kBandRows = 16;
}

Film::Film(FilmRect rect, Filter filter, size_t layers, bool adaptive)
    : rect_(rect),
      filter_(std::move(filter)),
      pass_(rect.pixels(), vec4(0.0f)),
      pass_splats_(rect.pixels(), Rgb(0.0f)),
      sum_(rect.pixels(), glm::dvec4(0.0)),
      layer_count_(layers),
      pass_layers_(rect.pixels() * layers, Rgb(0.0f)),
      sum_layers_(rect.pixels() * layers, glm::dvec3(0.0)),
      half_(adaptive ? rect.pixels() : 0, glm::dvec3(0.0)),
      counts_(half_.size(), 0),
      converged_(half_.size(), 0),
      stopped_(half_.size(), 0),
      active_pixels_(rect.pixels()) {}

void Film::begin_pass() {
  std::fill(pass_.begin(), pass_.end(), vec4(0.0f));
  std::fill(pass_splats_.begin(), pass_splats_.end(), Rgb(0.0f));
  if (abandoned_) {  // otherwise they have been cleared
    std::fill(pass_layers_.begin(), pass_layers_.end(), Rgb(0.0f));
  }
  abandoned_ = true;
}

template <class AnySplat, class Add>
void Film::for_each_splat(std::span<const std::vector<AnySplat>> blocks, ThreadPool& pool,
                          Add&& add) const {
  const size_t bands = (rect_.height() + kBandRows - 1) / kBandRows;
  const float radius = filter_.radius();
  pool.parallel_for(bands, [&](size_t band) {
    const int band_y0 = rect_.y0 + static_cast<int>(band) * kBandRows;
    const int band_y1 = std::min(band_y0 + kBandRows, rect_.y1);
    for (const std::vector<AnySplat>& block : blocks) {
      for (const AnySplat& splat : block) {
        // Pixels whose centre lies within the filter's support.
        const int y0 =
            std::max(band_y0, static_cast<int>(std::ceil(splat.raster.y - radius - 0.5f)));
        const int y1 =
            std::min(band_y1 - 1, static_cast<int>(std::floor(splat.raster.y + radius - 0.5f)));
        if (y0 > y1) {
          continue;
        }
        const int x0 =
            std::max(rect_.x0, static_cast<int>(std::ceil(splat.raster.x - radius - 0.5f)));
        const int x1 =
            std::min(rect_.x1 - 1, static_cast<int>(std::floor(splat.raster.x + radius - 0.5f)));
        for (int y = y0; y <= y1; ++y) {
          for (int x = x0; x <= x1; ++x) {
            const float weight = filter_.evaluate(splat.raster - vec2(x + 0.5f, y + 0.5f));
            add(static_cast<size_t>(y - rect_.y0) * rect_.width() + (x - rect_.x0),
                weight * splat.value, splat);
          }
        }
      }
    }
  });
}

void Film::add_splats(std::span<const std::vector<Splat>> blocks, ThreadPool& pool) {
  for_each_splat(blocks, pool,
                 [&](size_t pixel, Rgb value, const Splat&) { pass_splats_[pixel] += value; });
}

void Film::add_splats(std::span<const std::vector<LayerSplat>> blocks, ThreadPool& pool) {
  for_each_splat(blocks, pool, [&](size_t pixel, Rgb value, const LayerSplat& splat) {
    if (splat.picture) {
      pass_splats_[pixel] += value;
    }
    splat.layers.for_each(
        [&](size_t layer) { pass_layers_[pixel * layer_count_ + layer] += value; });
  });
}

void Film::end_pass(ThreadPool& pool) {
  pool.parallel_for(rect_.height(), [&](size_t row) {
    const size_t w = rect_.width();
    for (size_t i = row * w; i < (row + 1) * w; ++i) {
      const bool adds = active(i);
      if (adds) {
        const glm::dvec4 value = glm::dvec4(pass_[i]) + glm::dvec4(pass_splats_[i], 0.0f);
        sum_[i] += value;
        if (!counts_.empty() && counts_[i]++ % 2 == 1) {
          half_[i] += glm::dvec3(value);
        }
      }
      for (size_t k = i * layer_count_; k < (i + 1) * layer_count_; ++k) {
        sum_layers_[k] += adds ? glm::dvec3(pass_layers_[k]) : glm::dvec3(0.0);
        pass_layers_[k] = Rgb(0.0f);
      }
    }
  });
  ++passes_;
  abandoned_ = false;
}

bool Film::converged(size_t index, float threshold, float exposure) const {
  const double scale = exposure / passes_of(index);
  const glm::dvec3 whole = scale * glm::dvec3(sum_[index]), half = 2.0 * scale * half_[index];
  const glm::dvec3 off = glm::abs(whole - half);
  const double brightness = std::max(0.0, whole.x + whole.y + whole.z);
  const double norm = brightness < 1.0 ? std::sqrt(brightness) : brightness;
  return off.x + off.y + off.z < threshold * (1e-4 + norm);
}

void Film::stop_converged(float threshold, float exposure, ThreadPool& pool) {
  if (counts_.empty()) {
    return;
  }
  const size_t w = rect_.width(), h = rect_.height();
  pool.parallel_for(h, [&](size_t y) {
    for (size_t i = y * w; i < (y + 1) * w; ++i) {
      if (active(i)) {
        converged_[i] = converged(i, threshold, exposure);
      }
    }
  });
  std::vector<size_t> going_on(h, 0);  // by row
  pool.parallel_for(h, [&](size_t y) {
    for (size_t x = 0; x < w; ++x) {
      bool all = true;
      for (size_t ny = std::max<size_t>(y, 1) - 1; ny < std::min(y + 2, h); ++ny) {
        for (size_t nx = std::max<size_t>(x, 1) - 1; nx < std::min(x + 2, w); ++nx) {
          all = all && converged_[ny * w + nx];
        }
      }
      stopped_[y * w + x] = all;
      going_on[y] += all ? 0 : 1;
    }
  });
  active_pixels_ = std::accumulate(going_on.begin(), going_on.end(), size_t{0});
}

Image Film::develop(float exposure) const {
  Image image(rect_.width(), rect_.height(), 4);
  if (passes_ > 0) {
    for (size_t i = 0; i < sum_.size(); ++i) {
      for (int c = 0; c < 4; ++c) {
        const double factor = c < 3 ? exposure : 1.0;
        image.pixels[4 * i + c] = static_cast<float>(factor * sum_[i][c] / passes_of(i));
      }
    }
  }
  return image;
}

Image Film::develop_layer(size_t layer, float exposure) const {
  Image image(rect_.width(), rect_.height(), 3);
  if (passes_ > 0) {
    for (size_t i = 0; i < rect_.pixels(); ++i) {
      const double factor = exposure / passes_of(i);
      const glm::dvec3 mean = factor * sum_layers_[i * layer_count_ + layer];
      for (int c = 0; c < 3; ++c) {
        image.pixels[3 * i + c] = static_cast<float>(mean[c]);
      }
    }
  }
  return image;
}

}  // namespace janus
