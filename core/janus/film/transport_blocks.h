// SPDX-License-Identifier: GPL-3.0-or-later
//
// The hierarchy of a light transport matrix: for each tile of the camera, a partition of the
// projector's pixels into square blocks, a pruned quadtree. As it is a partition, every
// contribution lies in one block, and no sum over the projector depends on how fine it is.
#pragma once

#include <span>

#include "janus/film/transport_film.h"
#include "janus/util/cancel.h"

namespace janus {

// A square of projector pixels, in pixels; at the border a part of it may lie outside.
struct SourceBlock {
  uint16_t x, y, size;
};

class TransportBlocks {
 public:
  // In each tile one block, all of the projector.
  TransportBlocks(const CameraTiles& tiles, int source_width, int source_height);

  std::span<const SourceBlock> of_tile(size_t tile) const {
    return std::span(blocks_).subspan(first_[tile], first_[tile + 1] - first_[tile]);
  }
  // The number of its first block among all; of `tile` == number of tiles: of all blocks.
  size_t first(size_t tile) const { return first_[tile]; }
  size_t count() const { return blocks_.size(); }

  // The block of the tile, counted within it, in which the pixel lies.
  uint32_t find(size_t tile, uint32_t x, uint32_t y) const;

 private:
  friend class TransportPilot;
  // Quadtrees, node by node: that of the first of four children, or a leaf's block.
  static constexpr uint32_t kLeaf = 0x80000000U;
  TransportBlocks() = default;

  int size_ = 1;  // of a root: a power of two
  std::vector<uint32_t> roots_, nodes_;
  std::vector<size_t> first_;
  std::vector<SourceBlock> blocks_;
};

// Looks for such partitions in the contributions of a few passes, which are then forgotten: what
// the matrix is made of is independent of how it is divided, so nothing is biased.
class TransportPilot final : public TransportFilm {
 public:
  // `shares_size`: the smallest squares over which the tiles' shares are known (TransportSums).
  TransportPilot(int width, int height, int source_width, int source_height, int shares_size);

  // The partitions with at most `most` blocks in all (at least one for each tile) that approximate
  // best what was seen, by the squared error of the matrix, each row relative to its sum: optimal
  // pruning of trees (Chou, Lookabaugh and Gray 1989). Throws Cancelled.
  TransportBlocks choose(size_t most, ThreadPool& pool, const CancelToken& cancel) const;

  // Contributions seen.
  size_t seen() const;

 private:
  struct Seen {
    uint32_t morton;
    uint32_t place;  // in the tile
    float value;     // mean of the channels
  };
  struct Node {
    int32_t child = -1;  // the first of four; -1: none
    float gain = 0.0f;   // squared error that goes away with them
  };
  struct Tree {
    std::vector<Node> nodes;
    std::vector<uint8_t> split;
  };

  void take(std::vector<Transported>& contributions) override;
  Tree grow(std::vector<Seen> seen, float mean) const;
  float gain(std::span<const Seen> seen, const uint32_t (&ends)[5], int child_size,
             std::span<const float> weights) const;
  size_t prune(Tree& tree, float price) const;
  void write(const Tree& tree, TransportBlocks& result) const;

  int size_;  // of a root
  int shares_size_;
  std::vector<std::vector<Seen>> tiles_seen_;
};

}  // namespace janus
