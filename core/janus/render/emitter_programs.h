// SPDX-License-Identifier: GPL-3.0-or-later
//
// The programs of worlds and lamps: one for each answer that Light Path gives.
#pragma once

#include <algorithm>
#include <vector>

#include "janus/scene/node_graph.h"
#include "janus/scene/ray_type.h"
#include "janus/shading/program.h"

namespace janus {

// Those who look at worlds and lamps.
inline constexpr RayType kOnlookers[] = {RayType::Camera, RayType::Diffuse, RayType::Glossy,
                                         RayType::Transmission};

// Does the tree ask who looks?
inline bool asks_for_rays(const NodeGraph& graph) {
  return std::ranges::any_of(graph.nodes,
                             [](const Node& node) { return node.type == "LIGHT_PATH"; });
}

struct SeenProgram {
  RayMask seen_by;  // the camera, and labels
  Program program;
};

// Adds a program that `ray` sees; programs that emit the same become one.
void add_seen(std::vector<SeenProgram>& programs, RayType ray, Program program);

// Does it scatter light, which worlds and lamps do not?
bool scatters(const Program& program);

}  // namespace janus
