// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sums of which a light transport matrix is made: T = E S. E has, for each camera pixel, the
// light that it gets of each block of projector pixels. S says how the light of a block is spread
// over its pixels, as the whole tile of the camera sees it. Where a block is one pixel, S has
// nothing to say; where light is diffuse, it is the same for all pixels of a tile.
#pragma once

#include "janus/film/transport_blocks.h"

namespace janus {

// Radiance per watt, by channel, with the variance of each mean over the passes.
struct TransportMatrix {
  int samples = 0;
  int shares_size = 1;  // of a square of `shares`
  struct Block {
    uint32_t tile, x, y, size;
  };
  std::vector<Block> blocks;
  // Entries of E that are not zero, by tile, then by pixel, then by block.
  std::vector<uint32_t> pixels, entry_blocks;
  std::vector<Rgb> values, variances;
  // Sums over all pixels of a tile, for squares of projector pixels: [tile][row][column]. S is the
  // quotient of these and of their sums over a block.
  std::vector<Rgb> shares, share_variances;
};

class TransportSums final : public TransportFilm {
 public:
  TransportSums(int width, int height, int source_width, int source_height, int shares_size,
                TransportBlocks blocks);

  // The smallest power of two for which the shares take no more than `bytes`.
  static int shares_size_for(const CameraTiles& tiles, int source_width, int source_height,
                             size_t bytes);
  // How many blocks fit into `bytes`.
  static size_t blocks_for(size_t bytes) { return bytes / (CameraTiles::kPixels * sizeof(Sum)); }

  int passes() const { return passes_; }
  // Not within end_pass().
  TransportMatrix matrix() const;

 private:
  struct Sum {
    Rgb value = Rgb(0.0f), square = Rgb(0.0f);  // over the passes
  };
  struct Part {
    uint64_t index;
    Rgb value;
  };

  void take(std::vector<Transported>& contributions) override;
  void pass_taken() override { ++passes_; }
  static void accumulate(std::vector<Part>& parts, std::vector<Sum>& sums);

  size_t first_sum(size_t tile) const { return CameraTiles::kPixels * blocks_.first(tile); }
  uint32_t squares(int side) const { return (side + shares_size_ - 1) / shares_size_; }

  TransportBlocks blocks_;
  int shares_size_;
  int passes_ = 0;
  std::vector<Sum> sums_, shares_;
};

}  // namespace janus
