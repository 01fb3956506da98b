// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "janus/scene/diagnostics.h"
#include "janus/scene/node_graph.h"
#include "janus/shading/program.h"

namespace janus {

// Compiles a flattened node graph. Never fails: what it cannot do becomes a Diagnostic that names
// `material` and the node, and the nearest closure or the socket's constant is used instead.
Program compile(const NodeGraph& graph, const std::string& material, Diagnostics& diagnostics);

// Cycles' surface for a face without a material: diffuse 0.8.
Program default_surface();

}  // namespace janus
