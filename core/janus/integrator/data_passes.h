// SPDX-License-Identifier: GPL-3.0-or-later
//
// Fills passes of data: looks along the camera rays of a pass again, which sees the same as the
// integrator did, and does without the light. Apart from the integrators, so that none of them has
// to know.
#pragma once

#include <memory>

#include "janus/film/data_film.h"
#include "janus/integrator/integrator.h"

namespace janus {

// How much haze there is at a distance: from 0 at `start` to 1 `depth` metres behind it, to the
// power of `falloff`.
struct Mist {
  float start = 5.0f, depth = 25.0f, falloff = 2.0f;
  float at(float distance) const;
};

struct DataSettings {
  Mist mist;
  // Surfaces with less alpha are looked through, by the passes that are means.
  float alpha_threshold = 0.5f;
  float occlusion_distance = 0.0f;  // what is farther away does not occlude; metres, 0: infinite
};

std::unique_ptr<Integrator> make_data_passes(const RenderContext& context,
                                             const IntegratorSettings& settings,
                                             const DataSettings& data, DataFilm& film);

}  // namespace janus
