// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/session/settings.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "janus/session/footage.h"
#include "janus/session/passes.h"
#include "janus/util/error.h"

namespace janus {

int RenderSettings::least_samples() const {
  constexpr int kLeast = 4;
  const float by_threshold = std::ceil(16.0f / std::pow(noise_threshold, 0.3f));
  return std::max(kLeast, min_samples > 0 ? min_samples : static_cast<int>(by_threshold));
}

void RenderSettings::validate() const {
  const auto require = [](bool ok, const char* name, const char* message) {
    if (!ok) {
      throw SceneError("settings", name, message);
    }
  };
  constexpr int kMaxSide = 1 << 16;
  require(width >= 1 && width <= kMaxSide, "width", "must be from 1 to 65536 pixels");
  require(height >= 1 && height <= kMaxSide, "height", "must be from 1 to 65536 pixels");
  if (crop) {
    require(crop->x0 >= 0 && crop->y0 >= 0 && crop->x1 <= width && crop->y1 <= height &&
                crop->x0 < crop->x1 && crop->y0 < crop->y1,
            "crop", "must be a part of the frame that is not empty");
  }
  require(samples >= 1, "samples", "must be at least 1");
  require(std::isfinite(noise_threshold) && noise_threshold >= 0.0f, "noise_threshold",
          "must be finite and at least 0");
  require(min_samples >= 0, "min_samples", "must be at least 0");
  require(std::isfinite(seconds) && seconds >= 0.0, "seconds", "must be finite and at least 0");
  require(threads >= 0 && threads <= 1024, "threads", "must be from 0 to 1024");
  for (const auto& [value, name] : {std::pair(max_bounces, "max_bounces"),
                                    {max_diffuse_bounces, "max_diffuse_bounces"},
                                    {max_glossy_bounces, "max_glossy_bounces"},
                                    {max_transmission_bounces, "max_transmission_bounces"},
                                    {transparent_max_bounces, "transparent_max_bounces"}}) {
    require(value >= 0 && value <= 1024, name, "must be from 0 to 1024");
  }
  require(std::isfinite(clamp_direct) && clamp_direct >= 0.0f, "clamp_direct",
          "must be finite and at least 0");
  require(std::isfinite(clamp_indirect) && clamp_indirect >= 0.0f, "clamp_indirect",
          "must be finite and at least 0");
  require(std::isfinite(filter_width) && filter_width > 0.0f && filter_width <= 100.0f,
          "filter_width", "must be above 0 and at most 100 pixels");
  require(std::isfinite(film_exposure) && film_exposure >= 0.0f, "film_exposure",
          "must be finite and at least 0");
  require(film_transparent_roughness >= 0.0f && film_transparent_roughness <= 1.0f,
          "film_transparent_roughness", "must be from 0 to 1");
  require(std::isfinite(light_paths) && light_paths >= 0.0f && light_paths <= 64.0f, "light_paths",
          "must be from 0 to 64 per pixel");
  require(std::isfinite(connections) && connections >= 0.0f && connections <= 64.0f, "connections",
          "must be from 0 to 64 per vertex");
  require(std::isfinite(merge_radius) && merge_radius >= 0.0f, "merge_radius",
          "must be finite and at least 0");
  const bool bidirectional = integrator == IntegratorType::Bdpt;
  require(bidirectional || !strategies, "strategies", "can be chosen for bdpt only");
  require(bidirectional || strategy_images == 0, "strategy_images", "are made by bdpt only");
  require(strategy_images >= 0 && strategy_images <= 12, "strategy_images",
          "must be from 0 to 12 edges");
  require(data.matte_levels >= 1 && data.matte_levels <= 8, "cryptomatte_levels",
          "must be from 1 to 8");
  require(data_settings.alpha_threshold >= 0.0f && data_settings.alpha_threshold <= 1.0f,
          "pass_alpha_threshold", "must be from 0 to 1");
  const Mist& mist = data_settings.mist;
  require(std::isfinite(mist.start) && std::isfinite(mist.depth) && mist.depth >= 0.0f &&
              std::isfinite(mist.falloff) && mist.falloff > 0.0f,
          "mist", "needs a start, a depth of at least 0, and a falloff above 0");
  std::set<std::string> names{"Combined"};
  for (const std::string& name : data.names()) {
    require(names.insert(name).second, "aovs", "two of them have the same name");
  }
  if (shadow_catcher) {
    names.insert(kShadowCatcher);
  }
  for (const std::string& name : light_passes) {
    if (!is_light_pass(name)) {
      throw SceneError("settings", "light_passes", "there is no pass '" + name + "'");
    }
    require(names.insert(name).second, "light_passes", "name one pass twice");
  }
  for (const ExpressionPass& pass : expressions) {
    require(!pass.name.empty(), "expressions", "need a name each");
    if (!names.insert(pass.name).second) {
      throw SceneError("settings", "expressions", "two passes are called '" + pass.name + "'");
    }
  }
  require(integrator != IntegratorType::LightTracer || light_paths > 0.0f, "light_paths",
          "must be above 0 for light tracing");
}

}  // namespace janus
