# SPDX-License-Identifier: GPL-3.0-or-later
"""Film, samples, threads."""

from __future__ import annotations

from mistake import Edit, Mistake, one

from mistakes.sources import ADAPTIVE, BDPT, CAMERAS, FILM, PICTURES

FILM_AND_SAMPLES = (
    one(
        "stopped-pixels-take-splats",
        0,
        "a pixel that has stopped goes on to take what light paths bring",
        ADAPTIVE,
        FILM,
        "const bool adds = active(i);",
        "const bool adds = true;",
    ),
    one(
        "mean-over-all-passes",
        0,
        "a pixel that has stopped is divided by the passes that it missed",
        ADAPTIVE,
        FILM,
        "factor * sum_[i][c] / passes_of(i)",
        "factor * sum_[i][c] / passes_",
    ),
    one(
        "light-paths-of-stopped-pixels",
        0,
        "classic bdpt counts the light paths of pixels that have none",
        ADAPTIVE,
        "core/janus/integrator/classic_bdpt.cpp",
        "counts_.splat = static_cast<float>(light_paths_);",
        "counts_.splat = static_cast<float>(context_.film.rect().pixels());",
    ),
    one(
        "box-filter-for-splats",
        10,
        "splats fall into one pixel whatever the filter",
        f"{PICTURES}:*Film*:*Filters*",
        FILM,
        "filter_.evaluate(splat.raster - vec2(x + 0.5f, y + 0.5f));",
        "static_cast<int>(std::floor(splat.raster.x)) == x &&"
        " static_cast<int>(std::floor(splat.raster.y)) == y ? 1.0f : 0.0f;",
    ),
    Mistake(
        "splats-over-sum-of-taps",
        10,
        "splats are divided by the sum of the filter's taps",
        f"{PICTURES}:*Film*:*Filters*",
        (
            Edit(
                FILM,
                "for (int y = y0; y <= y1; ++y) {",
                """float taps = 0.0f;
        for (int y = y0; y <= y1; ++y) {
          for (int x = x0; x <= x1; ++x) {
            taps += filter_.evaluate(splat.raster - vec2(x + 0.5f, y + 0.5f));
          }
        }
        for (int y = y0; y <= y1; ++y) {""",
            ),
            Edit(
                FILM,
                "weight * splat.value, splat);",
                "weight * splat.value / std::max(taps, 1e-6f), splat);",
            ),
        ),
    ),
    one(
        "splats-per-wave",
        23,
        "splats count the light paths of their wave, not of the pass",
        "*Techniques*",
        BDPT,
        "static_cast<float>(light_paths_), roulette_, margin",
        "static_cast<float>(wave_paths_), roulette_, margin",
    ),
    one(
        "shared-stream",
        17,
        "light and camera walks draw from the same stream",
        f"{PICTURES}:Sampler.*",
        "core/janus/sampling/sampler.h",
        "Light = 0x4c494748",
        "Light = Camera",
    ),
    one(
        "shared-dimensions",
        17,
        "light path i shares its random numbers with the camera path of pixel i",
        f"{PICTURES}:Sampler.*",
        BDPT,
        "Sampler sampler(settings_.seed, Stream::Light, 0, first_light_path_ + i);",
        "Sampler sampler = camera_sampler(i, first_light_path_ / light_paths_);",
    ),
    Mistake(
        "cache-in-order-of-threads",
        0,
        "the cache is filled in the order in which threads end",
        "*Threads*",
        (
            Edit(
                BDPT,
                "start_splats(blocks);",
                "start_splats(blocks); std::vector<CacheBlock> ended;",
            ),
            Edit(
                BDPT,
                "counters.light_vertices = caches[block].vertices.size();",
                """counters.light_vertices = caches[block].vertices.size();
      {
        const std::lock_guard lock(check_mutex_);
        ended.push_back(std::move(caches[block]));
      }""",
            ),
            Edit(
                BDPT,
                "cache_.finish();",
                "std::ranges::move(ended, caches.begin()); cache_.finish();",
            ),
        ),
    ),
    one(
        "no-splats-around-the-frame",
        10,
        "splats beyond the border of the frame are dropped, whatever the filter's reach",
        CAMERAS,
        BDPT,
        "const float margin = context_.film.filter().radius();",
        "const float margin = 0.0f;",
    ),
    one(
        "connections-per-pass",
        23,
        "connections count the light paths of the pass, not of their wave",
        "*Techniques*",
        BDPT,
        "static_cast<float>(cache_.size()) / (effort_.connections *"
        " static_cast<float>(wave_paths_));",
        "static_cast<float>(cache_.size()) / (effort_.connections * light_paths_);",
    ),
    one(
        "the-same-light-paths",
        17,
        "every pass traces the light paths of the first one",
        PICTURES,
        BDPT,
        "first_light_path_ += light_paths_;",
        "",
    ),
)
