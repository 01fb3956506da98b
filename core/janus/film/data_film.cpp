// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/film/data_film.h"

#include <algorithm>
#include <utility>

#include "janus/util/error.h"

namespace janus {

namespace {

constexpr float kNothing = 1e10f;  // the depth of the background, as in Cycles

std::string level_name(size_t kind, size_t level) {
  return std::string(kMatteNames[kind]) + (level < 10 ? "0" : "") + std::to_string(level);
}

}  // namespace

bool DataChoice::surfaces() const {
  DataChoice rest = *this;
  for (const DataPass pass : {DataPass::DenoisingAlbedo, DataPass::DenoisingNormal,
                              DataPass::DenoisingDepth, DataPass::SampleCount}) {
    rest.passes[static_cast<size_t>(pass)] = false;
  }
  return rest.any();
}

bool DataChoice::any() const { return !names().empty(); }

std::vector<std::string> DataChoice::names() const {
  std::vector<std::string> found;
  for (size_t i = 0; i < kDataPassCount; ++i) {
    if (passes[i]) {
      found.emplace_back(kDataPasses[i].name);
    }
  }
  for (size_t kind = 0; kind < kMatteKinds; ++kind) {
    for (size_t level = 0; mattes[kind] && level < static_cast<size_t>(matte_levels); ++level) {
      found.push_back(level_name(kind, level));
    }
  }
  for (const AovPass& aov : aovs) {
    found.push_back(aov.picture());
  }
  return found;
}

DataFilm::DataFilm(FilmRect rect, DataChoice choice)
    : rect_(rect), choice_(std::move(choice)), counts_(rect.pixels()) {
  for (size_t i = 0; i < kDataPassCount; ++i) {
    if (choice_.passes[i]) {
      passes_[i].resize(rect.pixels() * kDataPasses[i].kept());
    }
  }
  for (size_t kind = 0; kind < kMatteKinds; ++kind) {
    if (choice_.mattes[kind]) {
      mattes_[kind].resize(rect.pixels() * slots());
    }
  }
  for (const AovPass& aov : choice_.aovs) {
    aovs_.emplace_back(rect.pixels() * aov.channels());
  }
}

size_t DataFilm::bytes(const FilmRect& rect, const DataChoice& choice) {
  size_t floats = choice.any() ? 1 : 0;
  for (size_t i = 0; i < kDataPassCount; ++i) {
    floats += choice.passes[i] ? kDataPasses[i].kept() : 0;
  }
  for (const bool wanted : choice.mattes) {
    floats += wanted ? 4 * static_cast<size_t>(choice.matte_levels) : 0;
  }
  for (const AovPass& aov : choice.aovs) {
    floats += aov.channels();
  }
  return rect.pixels() * floats * sizeof(float);
}

std::span<Coverage> DataFilm::coverages(size_t pixel, size_t kind) {
  return std::span(mattes_[kind]).subspan(pixel * slots(), slots());
}

void DataFilm::add(size_t first, std::span<const std::optional<DataSample>> samples) {
  const std::lock_guard lock(mutex_);
  for (size_t n = 0; n < samples.size(); ++n) {
    if (!samples[n]) {
      continue;
    }
    const DataSample& sample = *samples[n];
    const size_t pixel = first + n;
    const bool is_first = counts_[pixel]++ == 0;
    for (size_t i = 0; i < kDataPassCount; ++i) {
      const size_t kept = kDataPasses[i].kept();
      if (choice_.passes[i] && (is_first || !kDataPasses[i].first)) {
        for (size_t k = 0; k < kept; ++k) {
          passes_[i][pixel * kept + k] += sample.values[i][k];
        }
      }
    }
    for (const DataSample::Matte& matte : sample.mattes) {
      for (size_t kind = 0; kind < kMatteKinds; ++kind) {
        if (choice_.mattes[kind]) {
          add_coverage(coverages(pixel, kind), matte.ids[kind], matte.weight);
        }
      }
    }
    for (size_t i = 0; i < sample.aovs.size(); ++i) {
      const size_t channels = choice_.aovs[i].channels();
      for (size_t k = 0; k < channels; ++k) {
        aovs_[i][pixel * channels + k] += sample.aovs[i][static_cast<int>(k)];
      }
    }
  }
}

Image DataFilm::develop(const std::string& name) const {
  for (size_t i = 0; i < kDataPassCount; ++i) {
    if (choice_.passes[i] && name == kDataPasses[i].name) {
      return develop_pass(i);
    }
  }
  for (size_t kind = 0; kind < kMatteKinds; ++kind) {
    for (size_t level = 0; level < slots() / 2; ++level) {
      if (choice_.mattes[kind] && name == level_name(kind, level)) {
        return develop_matte(kind, level);
      }
    }
  }
  const auto aov = std::ranges::find(choice_.aovs, name, &AovPass::picture);
  if (aov != choice_.aovs.end()) {
    return develop_aov(static_cast<size_t>(aov - choice_.aovs.begin()));
  }
  throw Error("there is no pass '" + name + "'");
}

Image DataFilm::develop_pass(size_t pass) const {
  const DataPassInfo& info = kDataPasses[pass];
  const auto channels = static_cast<size_t>(info.channels);
  Image image(rect_.width(), rect_.height(), info.channels);
  const std::lock_guard lock(mutex_);
  for (size_t pixel = 0; pixel < counts_.size(); ++pixel) {
    const float* sums = &passes_[pass][pixel * info.kept()];
    const float samples = info.seen ? sums[channels] : static_cast<float>(counts_[pixel]);
    const float scale = !info.first && samples > 0.0f ? 1.0f / samples : 1.0f;
    for (size_t c = 0; c < channels; ++c) {
      float value = scale * sums[c];
      switch (static_cast<DataPass>(pass)) {
        case DataPass::Depth:
          value = value == 0.0f ? kNothing : value;
          break;
        case DataPass::Mist:  // samples say how much is to be seen, so that the background is 1
          value = std::clamp(1.0f - value, 0.0f, 1.0f);
          break;
        case DataPass::SampleCount:
          value = static_cast<float>(counts_[pixel]);
          break;
        default:
          break;
      }
      image.pixels[pixel * channels + c] = value;
    }
  }
  return image;
}

Image DataFilm::develop_aov(size_t aov) const {
  const size_t channels = choice_.aovs[aov].channels();
  Image image(rect_.width(), rect_.height(), static_cast<int>(channels));
  const std::lock_guard lock(mutex_);
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    const uint32_t samples = counts_[i / channels];
    image.pixels[i] = samples > 0 ? aovs_[aov][i] / static_cast<float>(samples) : 0.0f;
  }
  return image;
}

Image DataFilm::develop_matte(size_t kind, size_t level) const {
  Image image(rect_.width(), rect_.height(), 4);
  const std::lock_guard lock(mutex_);
  std::vector<Coverage> sorted(slots());
  for (size_t pixel = 0; pixel < counts_.size(); ++pixel) {
    std::copy_n(mattes_[kind].begin() + static_cast<std::ptrdiff_t>(pixel * slots()), slots(),
                sorted.begin());
    std::ranges::stable_sort(sorted, std::ranges::greater(), &Coverage::weight);
    const float scale = counts_[pixel] > 0 ? 1.0f / static_cast<float>(counts_[pixel]) : 0.0f;
    for (size_t n = 0; n < 2; ++n) {
      image.pixels[4 * pixel + 2 * n] = sorted[2 * level + n].id;
      image.pixels[4 * pixel + 2 * n + 1] = scale * sorted[2 * level + n].weight;
    }
  }
  return image;
}

}  // namespace janus
