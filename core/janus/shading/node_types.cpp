// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/shading/node_types.h"

#include <unordered_map>
#include <vector>

#include "janus/shading/nodes/families.h"

namespace janus {

std::span<const NodeDecl> node_types() {
  static const std::vector<NodeDecl> table = [] {
    std::vector<NodeDecl> all;
    for (const auto family :
         {closure_nodes(),  math_nodes(),          mix_nodes(),          color_nodes(),
          curve_nodes(),    blackbody_nodes(),     vector_nodes(),       input_nodes(),
          geometry_nodes(), texture_nodes(),       noise_nodes(),        voronoi_nodes(),
          gabor_nodes(),    radial_tiling_nodes(), wavelength_nodes(),   pattern_nodes(),
          sky_nodes(),      normal_nodes(),        displacement_nodes(), ies_nodes()}) {
      all.insert(all.end(), family.begin(), family.end());
    }
    return all;
  }();
  return table;
}

const NodeDecl* find_node_type(std::string_view type) {
  static const auto index = [] {
    std::unordered_map<std::string_view, const NodeDecl*> rows;
    for (const NodeDecl& decl : node_types()) {
      rows.emplace(decl.type, &decl);
    }
    return rows;
  }();
  const auto found = index.find(type);
  return found == index.end() ? nullptr : found->second;
}

}  // namespace janus
