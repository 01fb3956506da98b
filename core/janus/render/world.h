// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <string>

#include "janus/light/environment_map.h"
#include "janus/scene/description.h"
#include "janus/scene/diagnostics.h"

namespace janus {

// The world that is a lat-long picture: Environment Texture -> Background, the texture's vector
// unlinked or from Texture Coordinate (Generated), by way of a Mapping that only turns. nullopt for
// any other graph, which compile() knows better. What is not as asked becomes a Diagnostic.
std::optional<EnvironmentMap> compile_world_map(const WorldDesc& world,
                                                const std::map<std::string, ImageDesc>& images,
                                                Diagnostics& diagnostics);

}  // namespace janus
