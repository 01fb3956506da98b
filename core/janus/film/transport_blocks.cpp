// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/film/transport_blocks.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>

namespace janus {

namespace {

// Fewer samples tell nothing about how they are spread.
constexpr uint32_t kFewest = 4;
// Standard errors by which a gain that was seen is taken for less: chance makes some of even light.
constexpr double kErrors = 2.0;
// Light is taken to be so uneven, a variance among four children, where nothing was seen of it.
constexpr double kUnseen = 0.01;

int root_size(int width, int height) {
  return static_cast<int>(std::bit_ceil(static_cast<unsigned>(std::max(width, height))));
}

uint32_t spread_bits(uint32_t v) {
  v = (v | v << 8) & 0x00ff00ffU;
  v = (v | v << 4) & 0x0f0f0f0fU;
  v = (v | v << 2) & 0x33333333U;
  return (v | v << 1) & 0x55555555U;
}

// Pixels along a quadtree: children in the order of 2 y + x.
uint32_t morton(uint32_t x, uint32_t y) { return spread_bits(x) | spread_bits(y) << 1; }

}  // namespace

TransportBlocks::TransportBlocks(const CameraTiles& tiles, int source_width, int source_height)
    : size_(root_size(source_width, source_height)) {
  for (size_t i = 0; i < tiles.count(); ++i) {
    roots_.push_back(static_cast<uint32_t>(i));
    nodes_.push_back(kLeaf);
    first_.push_back(i);
    blocks_.push_back({0, 0, static_cast<uint16_t>(size_)});
  }
  first_.push_back(tiles.count());
}

uint32_t TransportBlocks::find(size_t tile, uint32_t x, uint32_t y) const {
  uint32_t node = nodes_[roots_[tile]];
  for (auto half = static_cast<uint32_t>(size_) / 2; (node & kLeaf) == 0; half /= 2) {
    node = nodes_[node + (x & half ? 1 : 0) + (y & half ? 2 : 0)];
  }
  return node & ~kLeaf;
}

TransportPilot::TransportPilot(int width, int height, int source_width, int source_height,
                               int shares_size)
    : TransportFilm(width, height, source_width, source_height),
      size_(root_size(source_width, source_height)),
      shares_size_(shares_size),
      tiles_seen_(tiles().count()) {}

void TransportPilot::take(std::vector<Transported>& contributions) {
  for (const Transported& t : contributions) {
    const uint32_t x = t.source % source_width(), y = t.source / source_width();
    tiles_seen_[tiles().tile(t.pixel)].push_back(
        {morton(x, y), tiles().place(t.pixel), average(t.value)});
  }
}

size_t TransportPilot::seen() const {
  size_t sum = 0;
  for (const auto& seen : tiles_seen_) {
    sum += seen.size();
  }
  return sum;
}

// What four children explain of the matrix, per pixel of them: for each camera pixel i, the squares
// of (E_ic - s_c E_i) over the area of a child, with E the light of the parent and of its children,
// and s_c the share of child c as the whole tile sees it, which the matrix knows anyway. Squares of
// sums count pairs of different samples alone (a U-statistic), so that noise is not taken for
// structure; and where few samples show none, there may be some all the same (kUnseen). Where
// blocks are smaller than the squares in which the shares are known, s_c is 1/4, and the tile's own
// structure is a gain, too.
float TransportPilot::gain(std::span<const Seen> seen, const uint32_t (&ends)[5], int child_size,
                           std::span<const float> weights) const {
  constexpr size_t kPixels = CameraTiles::kPixels;
  std::array<double, 4 * kPixels> sums{}, squares{};
  std::array<double, 4> tile{}, tile_squares{};
  for (size_t c = 0; c < 4; ++c) {
    for (uint32_t i = ends[c]; i < ends[c + 1]; ++i) {
      const double value = seen[i].value;
      sums[4 * seen[i].place + c] += value;
      squares[4 * seen[i].place + c] += value * value;
      tile[c] += value;
      tile_squares[c] += value * value;
    }
  }
  const double whole = tile[0] + tile[1] + tile[2] + tile[3];
  if (!(whole > 0.0)) {
    return 0.0f;
  }
  const bool known = child_size >= shares_size_;
  const auto children_of = [](const double* of) { return of[0] + of[1] + of[2] + of[3]; };
  double sum = 0.0, chance = 0.0, mean_weight = 0.0;
  for (size_t i = 0; i < kPixels; ++i) {
    const double* e = &sums[4 * i];
    const double* q = &squares[4 * i];
    const double all = children_of(e), all_squares = children_of(q), weight = weights[i];
    mean_weight += weight / kPixels;
    if (all == 0.0) {
      continue;
    }
    for (size_t c = 0; c < 4; ++c) {
      const double share = known ? tile[c] / whole : 0.25;
      sum += weight * ((e[c] * e[c] - q[c]) - 2.0 * share * (e[c] * all - q[c]) +
                       share * share * (all * all - all_squares));
    }
    chance += weight * weight * all_squares * all_squares;
  }
  // Of pairs of samples that fall into the children by chance: variance 2 (1/4 - 1/16) a pair.
  double gained = sum - kErrors * std::sqrt(0.375 * chance);
  const double squared = children_of(tile_squares.data());
  const double pairs = whole * whole - squared;
  if (!known) {
    double gained_by_tile = -0.25 * pairs - kErrors * std::sqrt(0.375) * squared;
    for (size_t c = 0; c < 4; ++c) {
      gained_by_tile += tile[c] * tile[c] - tile_squares[c];
    }
    gained = std::max(gained, mean_weight * gained_by_tile / kPixels);
  }
  gained = std::max(gained, 0.25 * kUnseen * mean_weight * pairs / kPixels);
  return static_cast<float>(gained / (static_cast<double>(child_size) * child_size));
}

TransportPilot::Tree TransportPilot::grow(std::vector<Seen> seen, float mean) const {
  std::vector<float> weights(CameraTiles::kPixels, mean);
  for (const Seen& s : seen) {
    weights[s.place] += s.value;
  }
  for (float& weight : weights) {
    weight = weight > 0.0f ? 1.0f / (weight * weight) : 0.0f;
  }
  std::ranges::stable_sort(seen, {}, &Seen::morton);
  Tree tree;
  tree.nodes.emplace_back();
  struct Task {
    uint32_t node, begin, end;
    int size;
  };
  std::vector<Task> tasks{{0, 0, static_cast<uint32_t>(seen.size()), size_}};
  while (!tasks.empty()) {
    const Task task = tasks.back();
    tasks.pop_back();
    if (task.size == 1 || task.end - task.begin < kFewest) {
      continue;
    }
    const int child_size = task.size / 2;
    const uint32_t step = static_cast<uint32_t>(child_size) * child_size;
    const uint32_t base = seen[task.begin].morton / (4 * step) * (4 * step);
    uint32_t ends[5] = {task.begin, 0, 0, 0, task.end};
    for (uint32_t c = 1; c < 4; ++c) {
      const auto at =
          std::lower_bound(seen.begin() + ends[c - 1], seen.begin() + task.end, base + c * step,
                           [](const Seen& s, uint32_t number) { return s.morton < number; });
      ends[c] = static_cast<uint32_t>(at - seen.begin());
    }
    const auto child = static_cast<uint32_t>(tree.nodes.size());
    tree.nodes[task.node] = {static_cast<int32_t>(child), gain(seen, ends, child_size, weights)};
    tree.nodes.resize(tree.nodes.size() + 4);
    for (uint32_t c = 0; c < 4; ++c) {
      tasks.push_back({child + c, ends[c], ends[c + 1], child_size});
    }
  }
  return tree;
}

// Splits where that gains more than `price` for each block; returns the blocks.
size_t TransportPilot::prune(Tree& tree, float price) const {
  std::vector<float> net(tree.nodes.size(), 0.0f);
  tree.split.assign(tree.nodes.size(), 0);
  for (size_t i = tree.nodes.size(); i-- > 0;) {  // children come after their parents
    const Node& node = tree.nodes[i];
    if (node.child >= 0) {
      const float* below = &net[node.child];
      const float value = node.gain - 3.0f * price + below[0] + below[1] + below[2] + below[3];
      tree.split[i] = value > 0.0f;
      net[i] = std::max(value, 0.0f);
    }
  }
  std::vector<size_t> open{0};
  size_t leaves = 0;
  while (!open.empty()) {
    const size_t i = open.back();
    open.pop_back();
    if (!tree.split[i]) {
      ++leaves;
      continue;
    }
    for (int c = 0; c < 4; ++c) {
      open.push_back(static_cast<size_t>(tree.nodes[i].child) + c);
    }
  }
  return leaves;
}

void TransportPilot::write(const Tree& tree, TransportBlocks& result) const {
  struct Task {
    uint32_t from, to, x, y, size;
  };
  const auto first = result.blocks_.size();
  result.roots_.push_back(static_cast<uint32_t>(result.nodes_.size()));
  std::vector<Task> tasks{{0, result.roots_.back(), 0, 0, static_cast<uint32_t>(size_)}};
  result.nodes_.push_back(0);
  while (!tasks.empty()) {
    const Task task = tasks.back();
    tasks.pop_back();
    if (!tree.split[task.from]) {
      result.nodes_[task.to] =
          TransportBlocks::kLeaf | static_cast<uint32_t>(result.blocks_.size() - first);
      const bool inside = task.x < static_cast<uint32_t>(source_width()) &&
                          task.y < static_cast<uint32_t>(source_height());
      if (inside) {  // what lies beyond the border is asked for by nobody
        result.blocks_.push_back({static_cast<uint16_t>(task.x), static_cast<uint16_t>(task.y),
                                  static_cast<uint16_t>(task.size)});
      }
      continue;
    }
    const auto child = static_cast<uint32_t>(result.nodes_.size());
    result.nodes_[task.to] = child;
    result.nodes_.resize(result.nodes_.size() + 4);
    for (uint32_t c = 0; c < 4; ++c) {
      const uint32_t half = task.size / 2;
      tasks.push_back({static_cast<uint32_t>(tree.nodes[task.from].child) + c, child + c,
                       task.x + (c & 1) * half, task.y + (c >> 1) * half, half});
    }
  }
}

TransportBlocks TransportPilot::choose(size_t most, ThreadPool& pool,
                                       const CancelToken& cancel) const {
  const size_t count = tiles_seen_.size();
  std::vector<double> sums(count, 0.0);
  for (size_t i = 0; i < count; ++i) {
    for (const Seen& seen : tiles_seen_[i]) {
      sums[i] += seen.value;
    }
  }
  const double pixels = static_cast<double>(tiles().width) * tiles().height;
  const auto mean = static_cast<float>(std::accumulate(sums.begin(), sums.end(), 0.0) / pixels);
  std::vector<Tree> trees(count);
  pool.parallel_for(count, [&](size_t i) {
    cancel.throw_if_cancelled();
    trees[i] = grow(tiles_seen_[i], mean);
  });

  std::vector<size_t> leaves(count);
  const auto blocks_at = [&](float price) {
    cancel.throw_if_cancelled();
    pool.parallel_for(count, [&](size_t i) { leaves[i] = prune(trees[i], price); });
    return std::accumulate(leaves.begin(), leaves.end(), size_t{0});
  };
  if (blocks_at(0.0f) > most) {
    float low = 1e-30f, high = 1.0f;
    while (blocks_at(high) > std::max(most, count) && high < 1e30f) {
      high *= 1e3f;
    }
    for (int i = 0; i < 40; ++i) {
      const float middle = std::sqrt(low * high);
      (blocks_at(middle) > most ? low : high) = middle;
    }
    blocks_at(high);
  }
  TransportBlocks result;
  result.size_ = size_;
  for (const Tree& tree : trees) {
    result.first_.push_back(result.blocks_.size());
    write(tree, result);
  }
  result.first_.push_back(result.blocks_.size());
  return result;
}

}  // namespace janus
