// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/geometry/derived.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>
#include <utility>

#include "janus/math/hash.h"
#include "janus/util/error.h"

namespace janus {

namespace {

constexpr float kEpsilon = std::numeric_limits<float>::epsilon();

float sum(vec3 p) { return p.x + p.y + p.z; }

// For each position the one that stands for all at its place. Positions close to each other have
// close sums of coordinates, so that in this order only neighbours need a look.
std::vector<uint32_t> weld(const std::vector<vec3>& positions) {
  std::vector<uint32_t> order(positions.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    const float x = sum(positions[a]), y = sum(positions[b]);
    return positions[a] == positions[b] ? a > b : x < y || (x == y && a < b);
  });
  std::vector<uint32_t> same(positions.size());
  for (size_t i = order.size(); i-- > 0;) {
    const vec3 p = positions[order[i]];
    same[order[i]] = order[i];
    for (size_t j = i + 1; j < order.size(); ++j) {
      const vec3 q = positions[order[j]];
      if (sum(q) - sum(p) > 3.0f * kEpsilon) {
        break;
      }
      if (length2(q - p) < kEpsilon) {
        same[order[i]] = same[order[j]];
        break;
      }
    }
  }
  return same;
}

// Sets of numbers that grow together (union by rank). Which number stands for a set is part of the
// picture: Cycles hashes it.
class DisjointSets {
 public:
  explicit DisjointSets(size_t count) : parents_(count), ranks_(count, 0) {
    std::iota(parents_.begin(), parents_.end(), 0);
  }
  uint32_t find(uint32_t x) {
    uint32_t root = x;
    while (parents_[root] != root) {
      root = parents_[root];
    }
    while (parents_[x] != root) {
      x = std::exchange(parents_[x], root);
    }
    return root;
  }
  void join(uint32_t a, uint32_t b) {
    a = find(a);
    b = find(b);
    if (a == b) {
      return;
    }
    if (ranks_[a] < ranks_[b]) {
      std::swap(a, b);
    }
    parents_[b] = a;
    ranks_[a] += ranks_[a] == ranks_[b] ? 1 : 0;
  }

 private:
  std::vector<uint32_t> parents_, ranks_;
};

std::vector<vec3> point_normals(const std::string& key, const MeshDesc& desc) {
  const size_t count = desc.positions.size();
  const auto found =
      std::ranges::find_if(desc.attributes, [](const auto& a) { return a.key == "normal"; });
  if (found == desc.attributes.end() || found->channels != 3 || found->values.size() != 3 * count) {
    throw SceneError(key, "attributes[pointiness]", "needs the attribute 'normal' of the points");
  }
  std::vector<vec3> normals(count);
  for (size_t i = 0; i < count; ++i) {
    const float* n = &found->values[3 * i];
    normals[i] = vec3(n[0], n[1], n[2]);
  }
  return normals;
}

// From values of positions that are the same all over a face to values of faces.
std::vector<float> by_face(const MeshDesc& desc, const std::vector<float>& of_position) {
  std::vector<float> result;
  for (size_t i = 0; i < desc.triangles.size(); ++i) {
    const uint32_t corner = desc.triangles[i][0];
    const size_t face = desc.faces.empty() ? i : desc.faces[i];
    result.resize(std::max(result.size(), face + 1), 0.0f);
    result[face] =
        of_position[desc.corner_vertices.empty() ? corner : desc.corner_vertices[corner]];
  }
  return result;
}

}  // namespace

std::vector<float> pointiness(const std::vector<vec3>& positions, const std::vector<vec3>& normals,
                              const std::vector<glm::uvec2>& edges) {
  const size_t count = positions.size();
  const std::vector<uint32_t> same = weld(positions);
  std::vector<vec3> normal(count, vec3(0.0f)), around(count, vec3(0.0f));
  for (size_t i = 0; i < count; ++i) {
    normal[same[i]] += normals[i];
  }
  std::vector<glm::uvec2> welded;
  std::set<std::pair<uint32_t, uint32_t>> seen;
  for (const glm::uvec2 edge : edges) {
    const uint32_t a = same[edge.x], b = same[edge.y];
    if (seen.insert(std::minmax(a, b)).second) {
      welded.emplace_back(a, b);
    }
  }
  std::vector<int> neighbours(count, 0);
  for (const glm::uvec2 edge : welded) {
    const vec3 d = positions[edge.y] - positions[edge.x];
    const float length = glm::length(d);
    const vec3 unit = length > 0.0f ? d / length : vec3(0.0f);
    around[edge.x] += unit;
    around[edge.y] -= unit;
    ++neighbours[edge.x];
    ++neighbours[edge.y];
  }
  std::vector<float> sharp(count, 0.0f);
  for (size_t i = 0; i < count; ++i) {
    if (same[i] == i && neighbours[i] > 0) {
      const float length = glm::length(normal[i]);
      const vec3 n = length > 0.0f ? normal[i] / length : normal[i];
      const float mean = dot(n, around[i] / static_cast<float>(neighbours[i]));
      sharp[i] = std::acos(std::clamp(mean, -1.0f, 1.0f)) * kInvPi;
    }
  }
  // A blur makes it look at the neighbours of the neighbours, too.
  std::vector<float> blurred = sharp;
  for (const glm::uvec2 edge : welded) {
    blurred[edge.x] += sharp[edge.y];
    blurred[edge.y] += sharp[edge.x];
  }
  std::vector<float> result(count);
  for (size_t i = 0; i < count; ++i) {
    result[i] = blurred[same[i]] / static_cast<float>(neighbours[same[i]] + 1);
  }
  return result;
}

std::vector<float> random_per_island(size_t count, const std::vector<glm::uvec2>& edges) {
  DisjointSets islands(count);
  for (const glm::uvec2 edge : edges) {
    islands.join(edge.x, edge.y);
  }
  std::vector<float> result(count);
  for (uint32_t i = 0; i < count; ++i) {
    result[i] = jenkins_number(std::array{islands.find(i)});
  }
  return result;
}

bool is_derived(const AttributeDesc& attribute) {
  return attribute.values.empty() &&
         (attribute.key == "pointiness" || attribute.key == "random_per_island");
}

void derive_attributes(const std::string& key, const MeshDesc& desc,
                       std::vector<AttributeDesc>& attributes) {
  const size_t count = desc.positions.size();
  for (size_t i = 0; i < desc.edges.size(); ++i) {
    if (desc.edges[i].x >= count || desc.edges[i].y >= count) {
      throw SceneError(key, "edges[" + std::to_string(i) + "]",
                       "is out of range: the mesh has " + std::to_string(count) + " positions");
    }
  }
  for (AttributeDesc& attribute : attributes) {
    if (!is_derived(attribute)) {
      continue;
    }
    attribute.channels = 1;
    if (attribute.key == "pointiness") {
      attribute.domain = AttributeDomain::Point;
      attribute.values = pointiness(desc.positions, point_normals(key, desc), desc.edges);
    } else {
      attribute.domain = AttributeDomain::Face;  // shaders hash it: it must not be interpolated
      attribute.values = by_face(desc, random_per_island(count, desc.edges));
    }
  }
}

}  // namespace janus
