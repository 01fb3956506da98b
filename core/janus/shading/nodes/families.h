// SPDX-License-Identifier: GPL-3.0-or-later
//
// The rows of the table of node types, by family. Each file here holds its nodes whole: inputs,
// outputs, and what they do.
#pragma once

#include "janus/shading/node_types.h"

namespace janus {

std::span<const NodeDecl> closure_nodes();
std::span<const NodeDecl> math_nodes();
std::span<const NodeDecl> mix_nodes();
std::span<const NodeDecl> color_nodes();
std::span<const NodeDecl> curve_nodes();
std::span<const NodeDecl> blackbody_nodes();
std::span<const NodeDecl> vector_nodes();
std::span<const NodeDecl> input_nodes();
std::span<const NodeDecl> geometry_nodes();
std::span<const NodeDecl> texture_nodes();
std::span<const NodeDecl> noise_nodes();
std::span<const NodeDecl> voronoi_nodes();
std::span<const NodeDecl> gabor_nodes();
std::span<const NodeDecl> radial_tiling_nodes();
std::span<const NodeDecl> wavelength_nodes();
std::span<const NodeDecl> pattern_nodes();
std::span<const NodeDecl> sky_nodes();
std::span<const NodeDecl> normal_nodes();
std::span<const NodeDecl> displacement_nodes();
std::span<const NodeDecl> ies_nodes();

}  // namespace janus
