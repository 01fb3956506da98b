// SPDX-License-Identifier: GPL-3.0-or-later
//
// Finds the cached light vertices around a point: a hash of cubic cells, sorted by counting.
#pragma once

#include <cmath>
#include <vector>

#include "janus/integrator/vertex_cache.h"
#include "janus/math/hash.h"

namespace janus {

class VertexGrid {
 public:
  // Holds the vertices behind z_1, in the order of the cache. The cache outlives what is found.
  void build(const VertexCache& cache, float radius) {
    radius2_ = radius * radius;
    per_cell_ = 0.5f / radius;
    vertices_.clear();
    cache.for_each([&](const LightVertex& v) {
      if (v.edges > 1) {
        vertices_.push_back(&v);
      }
    });
    size_t buckets = 1;
    while (buckets < vertices_.size()) {
      buckets *= 2;
    }
    mask_ = buckets - 1;
    first_.assign(buckets + 1, 0);
    for (const LightVertex* v : vertices_) {
      ++first_[bucket(cell(v->p)) + 1];
    }
    for (size_t i = 0; i < buckets; ++i) {
      first_[i + 1] += first_[i];
    }
    items_.resize(vertices_.size());
    next_.assign(first_.begin(), first_.end() - 1);
    for (const LightVertex* v : vertices_) {
      items_[next_[bucket(cell(v->p))]++] = {v->p, v};
    }
  }

  // Calls found(const LightVertex&) for those within the radius of `p`.
  template <class Found>
  void for_each_near(vec3 p, Found&& found) const {
    // A cell is two radii wide: what is near lies in two cells along each axis.
    const glm::ivec3 low = cell(p - vec3(0.5f / per_cell_));
    size_t seen[8];
    for (int n = 0; n < 8; ++n) {
      seen[n] = bucket(low + glm::ivec3(n & 1, n >> 1 & 1, n >> 2));
      bool again = false;  // two cells can share a bucket
      for (int i = 0; i < n; ++i) {
        again |= seen[i] == seen[n];
      }
      for (size_t i = first_[seen[n]]; i < first_[seen[n] + 1] && !again; ++i) {
        if (length2(items_[i].p - p) <= radius2_) {
          found(*items_[i].vertex);
        }
      }
    }
  }

 private:
  struct Item {
    vec3 p;
    const LightVertex* vertex;
  };

  glm::ivec3 cell(vec3 p) const { return glm::ivec3(glm::floor(p * per_cell_)); }
  size_t bucket(glm::ivec3 c) const {
    return hash_combine(
               hash_combine(hash32(static_cast<uint32_t>(c.x)), static_cast<uint32_t>(c.y)),
               static_cast<uint32_t>(c.z)) &
           mask_;
  }

  float radius2_ = 0.0f, per_cell_ = 1.0f;
  size_t mask_ = 0;
  std::vector<const LightVertex*> vertices_;
  std::vector<size_t> first_{0, 0}, next_;  // by bucket
  std::vector<Item> items_;
};

}  // namespace janus
