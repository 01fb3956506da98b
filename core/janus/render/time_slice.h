// SPDX-License-Identifier: GPL-3.0-or-later
//
// A scene at one time of the shutter is a scene: everything in it stands still, and nothing that
// renders it need know of motion. Lamps, the world and materials are the same at all times, as in
// Cycles.
#pragma once

#include <memory>

#include "janus/render/scene.h"

namespace janus {

// Is the instance somewhere else, or of another form, at another time?
bool moves(const Scene& scene, const Instance& instance);

// Does anything change while the shutter is open?
bool moves(const Scene& scene);

// About how much there is to do for at_time(): the triangles and instances that it builds.
size_t slice_work(const Scene& scene);

// The scene at `time`, from 0 (the shutter opens) to 1 (it closes). Shares what stands still, and
// numbers instances, surfaces and lights alike. `whole`: Scene::whole. Throws Cancelled.
std::shared_ptr<const Scene> at_time(const std::shared_ptr<const Scene>& scene, float time,
                                     const CancelToken& cancel, const Scene* whole = nullptr);

}  // namespace janus
