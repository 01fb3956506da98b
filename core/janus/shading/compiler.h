// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "janus/scene/description.h"
#include "janus/scene/diagnostics.h"
#include "janus/scene/node_graph.h"
#include "janus/shading/program.h"
#include "janus/shading/seen_tree.h"

namespace janus {

using ImageMap = std::map<std::string, ImageDesc>;

// Compiles a flattened node graph. Never fails: what it cannot do becomes a Diagnostic that names
// `material` and the node, and the nearest closure or the socket's constant is used instead.
// `seen`: of what it is the graph, and who looks; that makes a difference to Light Path alone.
Program compile(const NodeGraph& graph, const std::string& material, const ImageMap& images,
                Diagnostics& diagnostics, SeenTree seen = kAnySurface);

// The program of the AOV Output nodes in a graph. `names`: of the AOVs of the scene, by number; new
// ones are added.
Program compile_aovs(const NodeGraph& graph, const std::string& material, const ImageMap& images,
                     std::vector<std::string>& names, Diagnostics& diagnostics, SeenTree seen);

// What Light Path answers in the tree of a world or a lamp that rays of this type see; nullopt:
// that output is not supported.
std::optional<bool> light_path_answer(RayType ray, std::string_view output);

// The keys of the mesh attributes that the program of a graph reads: see node_emitter.h.
std::vector<std::string> required_attributes(const NodeGraph& graph);
std::vector<std::string> attributes_of_aovs(const NodeGraph& graph);

// Cycles' surface for a face without a material: diffuse 0.8.
Program default_surface();

}  // namespace janus
