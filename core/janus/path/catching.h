// SPDX-License-Identifier: GPL-3.0-or-later
//
// Shadow catchers stand for things of the footage that a picture is laid over. A path belongs to
// one if the camera sees it, directly or through what is transparent; that is a property of the
// path, whatever technique finds it. The light of such paths is no part of the picture: divided by
// what it is in Scene::catchers_alone, it says what the rest of the scene does to the footage.
#pragma once

#include "janus/path/rules.h"
#include "janus/render/scene.h"

namespace janus {

// What a camera ray's view covers of a pixel.
struct ViewCoverage {
  float alpha = 1.0f;      // of everything
  float matte = 1.0f;      // of what belongs to no shadow catcher
  float caught = 0.0f;     // what comes to shadow catchers
  Rgb behind = Rgb(0.0f);  // the background where there are shadow catchers, if the film shows it
};

inline bool catches(const Scene& scene, const SurfaceInteraction& hit) {
  return scene.instances[hit.instance].catcher;
}

// The camera's `ray`, of which `beta` has come through, meets `hit`: true if that is a shadow
// catcher, to which it belongs from here on. Where there are catchers alone, the rest of the whole
// scene still stands before the first one, and `beta` loses what that hides.
bool catch_view(const Scene& scene, const SurfaceInteraction& hit, const Ray& ray,
                const PathRules& rules, Rgb& beta, ViewCoverage& coverage);

// The same of a path that is seen from `to`, at the camera, over a clear segment from `from`, which
// is on a shadow catcher if `caught`, and has `value`.
bool catch_segment(const Scene& scene, vec3 from, vec3 to, bool caught, const PathRules& rules,
                   Rgb& value);

}  // namespace janus
