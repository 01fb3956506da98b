// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/light/lamp_index.h"

namespace janus {

namespace {

// Lamps may be flat, and rounding must not hide one: wider than any error of the slab test.
Bounds widened(Bounds b) {
  const vec3 reach = glm::max(glm::abs(b.lower), glm::abs(b.upper));
  const vec3 margin(1e-4f * b.radius() + 1e-5f * max_component(reach) + 1e-12f);
  return {b.lower - margin, b.upper + margin};
}

bool crosses(const Bounds& b, const Ray& ray, vec3 inverse) {
  const vec3 a = (b.lower - ray.origin) * inverse, c = (b.upper - ray.origin) * inverse;
  float near = 0.0f, far = ray.t_max;
  for (int i = 0; i < 3; ++i) {
    // Comparisons are false for 0 * infinity, a ray in the plane of a face: no limit then.
    const float low = a[i] < c[i] ? a[i] : c[i], high = a[i] < c[i] ? c[i] : a[i];
    near = low > near ? low : near;
    far = high < far ? high : far;
  }
  return near <= far * (1.0f + 1e-5f);
}

}  // namespace

LampIndex::LampIndex(const LightList& lights, const std::vector<size_t>& lamps) {
  std::vector<std::pair<Bounds, uint32_t>> items;
  for (const size_t lamp : lamps) {
    const auto index = static_cast<uint32_t>(lamp);
    all_.push_back(index);
    if (lights[lamp]->infinite()) {
      infinite_.push_back(index);
    } else {
      items.emplace_back(widened(lights[lamp]->emitters()[0].bounds), index);
    }
  }
  if (items.size() > kFew && infinite_.size() < kMaxFound) {
    nodes_.reserve(2 * items.size() - 1);
    build(items, 0, items.size());
  }
}

// Halves by the widest axis: balanced, so find() needs a stack of no more than 32.
void LampIndex::build(std::vector<std::pair<Bounds, uint32_t>>& items, size_t begin, size_t end) {
  const size_t index = nodes_.size();
  Bounds bounds, centers;
  for (size_t i = begin; i < end; ++i) {
    bounds.extend(items[i].first);
    centers.extend(items[i].first.center());
  }
  nodes_.push_back({bounds, kLeaf | items[begin].second});
  if (end - begin == 1) {
    return;
  }
  const vec3 extent = centers.upper - centers.lower;
  const int axis = extent.x >= std::max(extent.y, extent.z) ? 0 : extent.y >= extent.z ? 1 : 2;
  const size_t middle = begin + (end - begin) / 2;
  const auto at = [&](size_t i) { return items.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end), [&](const auto& a, const auto& b) {
    const float ca = a.first.center()[axis], cb = b.first.center()[axis];
    return ca != cb ? ca < cb : a.second < b.second;
  });
  build(items, begin, middle);
  nodes_[index].next = static_cast<uint32_t>(nodes_.size());
  build(items, middle, end);
}

bool LampIndex::find(const Ray& ray, Found& found) const {
  for (const uint32_t lamp : infinite_) {
    found.add(lamp);
  }
  const vec3 inverse = 1.0f / ray.direction;
  std::array<uint32_t, 40> stack;
  size_t size = 0;
  uint32_t node = 0;
  for (;;) {
    const Node& n = nodes_[node];
    if (crosses(n.bounds, ray, inverse)) {
      if (!(n.next & kLeaf)) {
        stack[size++] = n.next;
        ++node;
        continue;
      }
      if (!found.add(n.next & ~kLeaf)) {
        return false;
      }
    }
    if (size == 0) {
      return true;
    }
    node = stack[--size];
  }
}

}  // namespace janus
