// SPDX-License-Identifier: GPL-3.0-or-later
//
// Trees that ask who looks (Light Path): they are compiled for each type of ray, and what answers
// differ make things of their own, visible to those rays alone, so that no transport code knows.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "janus/scene/diagnostics.h"
#include "janus/scene/node_graph.h"
#include "janus/scene/ray_type.h"
#include "janus/shading/program.h"

namespace janus {

// Those who look at worlds and lamps, and those who meet surfaces.
inline constexpr RayType kOnlookers[] = {RayType::Camera, RayType::Diffuse, RayType::Glossy,
                                         RayType::Transmission};
inline constexpr RayType kRays[] = {RayType::Diffuse, RayType::Glossy, RayType::Transmission,
                                    RayType::Camera, RayType::Shadow};

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

// Of rays that get other answers from the tree of a surface than those before them in kRays,
// the place there; of others the place of those whose answers are theirs.
std::array<size_t, std::size(kRays)> first_with_answers(const NodeGraph& graph);

// Adds those that are not there yet: the same tree has the same things to say to each ray.
void add_new(Diagnostics& said, const Diagnostics& more);

// Does it scatter light, which worlds and lamps do not?
bool scatters(const Program& program);

}  // namespace janus
