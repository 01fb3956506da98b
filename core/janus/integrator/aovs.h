// SPDX-License-Identifier: GPL-3.0-or-later
//
// AOVs by Cycles' rule. A path of the camera writes at each surface until one has as much alpha as
// the view layer asks for, with no regard to what it has passed; the picture is the mean over all
// paths. So what lies behind something thin counts by the chance with which Cycles' paths get
// there. That is no measure of anything, but it is what the artist has seen.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "janus/film/data_film.h"
#include "janus/shading/program.h"

namespace janus {

// The share of Cycles' paths that get to where a walk straight ahead is.
class AovShare {
 public:
  float value() const { return value_; }

  // Meets a surface: with which share it writes. Cycles plays roulette with its paths from the
  // third one on; what emits is still seen by those that end there.
  float arrive(int crossings, bool emits) {
    const float before = value_;
    if (crossings >= 2) {
      const float survival = std::min(1.0f, std::sqrt(max_component(throughput_)));
      value_ *= survival;
      throughput_ /= survival;
    }
    return emits ? before : value_;
  }

  // Passes it: by a choice among Transparent and the lobes. What emits or holds out is no choice.
  void cross(const ShadingResult& shading) {
    const float through = average(shading.transparency);
    if (through > 0.0f) {
      const float chance = through / (through + shading.bsdf.albedo());
      value_ *= chance;
      throughput_ *= shading.transparency / chance;
    }
  }

 private:
  float value_ = 1.0f;
  Rgb throughput_ = Rgb(1.0f);
};

// From the numbers of AOVs in a scene to those that are wanted.
class AovWriter {
 public:
  AovWriter(const std::vector<std::string>& names, const std::vector<AovPass>& wanted)
      : wanted_(wanted) {
    for (const std::string& name : names) {
      places_.push_back(std::ranges::find(wanted, name, &AovPass::name) - wanted.begin());
    }
  }

  // What a program calls; adds to the sample. Several nodes of one name add up, alpha included.
  auto writer(float share, DataSample& sample) const {
    return [this, share, &sample](uint32_t aov, vec3 color, float value) {
      const auto place = static_cast<size_t>(places_[aov]);
      if (place < wanted_.size()) {
        sample.aovs.resize(wanted_.size(), vec4(0.0f));
        sample.aovs[place] +=
            share * (wanted_[place].color ? vec4(color, 1.0f) : vec4(value, 0.0f, 0.0f, 0.0f));
      }
    };
  }

 private:
  const std::vector<AovPass>& wanted_;
  std::vector<std::ptrdiff_t> places_;  // beyond the end: nobody wants it
};

}  // namespace janus
