// SPDX-License-Identifier: GPL-3.0-or-later
//
// Attributes that are computed from a mesh where a shader asks for them, as Cycles does it.
#pragma once

#include <string>
#include <vector>

#include "janus/math/vec.h"
#include "janus/scene/description.h"

namespace janus {

// How convex the surface is at each position, 0 to 1; flat is 0.5. Positions at the same place are
// one. `normals`: of the positions. Edges must be pairs of positions that are there.
std::vector<float> pointiness(const std::vector<vec3>& positions, const std::vector<vec3>& normals,
                              const std::vector<glm::uvec2>& edges);

// For each of `count` positions a number in [0, 1], the same for all that edges connect.
std::vector<float> random_per_island(size_t count, const std::vector<glm::uvec2>& edges);

// Is this attribute to be computed: "pointiness" or "random_per_island", without values?
bool is_derived(const AttributeDesc& attribute);

// Computes those; "pointiness" needs the attribute "normal", of the positions. The mesh's triangles
// are checked. Throws SceneError for what is missing, and for edges of positions that are not
// there.
void derive_attributes(const std::string& key, const MeshDesc& desc,
                       std::vector<AttributeDesc>& attributes);

}  // namespace janus
