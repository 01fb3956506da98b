// SPDX-License-Identifier: GPL-3.0-or-later
//
// Finds the cached light vertices around a point: a hash of cubic cells, sorted by counting.
#pragma once

#include <vector>

#include "janus/integrator/vertex_cache.h"
#include "janus/math/hash.h"

namespace janus {

class VertexGrid {
  struct Item {
    vec3 p;
    uint32_t block;
    const LightVertex* vertex;
  };

 public:
  // At most, for each vertex of the cache.
  static constexpr size_t kBytesPerVertex = sizeof(Item) + 2 * sizeof(size_t);

  // Holds the vertices behind z_1. The cache outlives what is found; coordinates over the radius
  // are numbers of 32 bits.
  void build(const VertexCache& cache, float radius) {
    radius_ = radius;
    cache_ = &cache;
    size_t buckets = 1;
    while (buckets < cache.size()) {
      buckets *= 2;
    }
    mask_ = buckets - 1;
    // Where each bucket ends; filling it from there leaves where it begins.
    first_.assign(buckets + 1, 0);
    for_each_bounced(cache, [&](const LightVertex& v, uint32_t) { ++first_[bucket(cell(v.p))]; });
    for (size_t i = 1; i <= buckets; ++i) {
      first_[i] += first_[i - 1];
    }
    items_.resize(first_.back());
    for_each_bounced(cache, [&](const LightVertex& v, uint32_t block) {
      items_[--first_[bucket(cell(v.p))]] = {v.p, block, &v};
    });
  }

  // Calls found(const LightVertex&, const CacheBlock&) for those within the radius of `p`, in an
  // order that does not depend on the threads.
  template <class Found>
  void for_each_near(vec3 p, Found&& found) const {
    // A cell is two radii wide: what is near lies in two cells along each axis.
    const glm::ivec3 low = cell(p - vec3(radius_));
    size_t seen[8];
    for (int n = 0; n < 8; ++n) {
      seen[n] = bucket(low + glm::ivec3(n & 1, n >> 1 & 1, n >> 2));
      if (std::find(seen, seen + n, seen[n]) != seen + n) {
        continue;  // two cells can share a bucket
      }
      for (size_t i = first_[seen[n]]; i < first_[seen[n] + 1]; ++i) {
        if (length2(items_[i].p - p) <= radius_ * radius_) {
          found(*items_[i].vertex, cache_->block(items_[i].block));
        }
      }
    }
  }

 private:
  template <class Visit>
  static void for_each_bounced(const VertexCache& cache, Visit&& visit) {
    cache.for_each([&](const LightVertex& v, uint32_t block) {
      if (v.edges > 1) {
        visit(v, block);
      }
    });
  }

  glm::ivec3 cell(vec3 p) const { return glm::ivec3(glm::floor(p * (0.5f / radius_))); }
  size_t bucket(glm::ivec3 c) const {
    const uint32_t xy =
        hash_combine(hash32(static_cast<uint32_t>(c.x)), static_cast<uint32_t>(c.y));
    return hash_combine(xy, static_cast<uint32_t>(c.z)) & mask_;
  }

  const VertexCache* cache_ = nullptr;
  float radius_ = 1.0f;
  size_t mask_ = 0;
  std::vector<size_t> first_{0, 0};  // by bucket
  std::vector<Item> items_;
};

}  // namespace janus
