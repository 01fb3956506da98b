// SPDX-License-Identifier: GPL-3.0-or-later
//
// The light-vertex cache: what the light paths of a wave leave for camera vertices to join.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "janus/path/connect.h"

namespace janus {

// Connectible light vertices of a block of light paths, with their lobes in one pool.
struct CacheBlock {
  std::vector<LightVertex> vertices;
  std::vector<Lobe> lobes;
  std::vector<Reshading> reshadings;  // of those that depend on the view
  std::vector<WeightedState> states;  // of the automaton of light path expressions

  void clear() {
    states.clear();
    vertices.clear();
    lobes.clear();
    reshadings.clear();
  }
  void add(const PathVertex& v) {
    LightVertex out(v);
    out.first_lobe = static_cast<uint32_t>(lobes.size());
    if (v.reshading.program) {
      out.reshading = static_cast<int32_t>(reshadings.size());
      reshadings.push_back(v.reshading);
    }
    if (v.trace) {
      const std::span<const WeightedState> read = v.trace->states();
      out.first_state = static_cast<uint32_t>(states.size());
      out.state_count = static_cast<uint8_t>(read.size());
      states.insert(states.end(), read.begin(), read.end());
    }
    const BsdfView bsdf = v.bsdf();
    // View-free and connectible: the rest is asked for only where it may cover another one.
    const bool layered = std::ranges::any_of(bsdf.lobes(), &Lobe::above);
    for (const Lobe& lobe : bsdf.lobes()) {
      if (layered || (out.entry ? lobe.type == LobeType::Subsurface : is_connectible(lobe))) {
        lobes.push_back(lobe);
        ++out.lobe_count;
      }
    }
    vertices.push_back(out);
  }
  BsdfView bsdf(const LightVertex& v) const {
    return {std::span(lobes).subspan(v.first_lobe, v.lobe_count), v.ng, v.ns,
            v.reshading < 0 ? nullptr : &reshadings[static_cast<size_t>(v.reshading)],
            v.entry ? VertexKind::SubsurfaceEntry : VertexKind::Surface};
  }
  std::span<const WeightedState> states_of(const LightVertex& v) const {
    return std::span(states).subspan(v.first_state, v.state_count);
  }
  size_t bytes() const {
    return states.size() * sizeof(WeightedState) + vertices.size() * sizeof(LightVertex) +
           lobes.size() * sizeof(Lobe) + reshadings.size() * sizeof(Reshading);
  }
};

// The cache: blocks in the order of the light paths, whichever thread traced what. They keep their
// memory from pass to pass.
class VertexCache {
 public:
  std::span<CacheBlock> start(size_t blocks) {
    if (blocks_.size() < blocks) {
      blocks_.resize(blocks);
    }
    count_ = blocks;
    return {blocks_.data(), blocks};
  }

  // Counts what the blocks hold.
  void finish() {
    first_.assign(1, 0);
    for (size_t i = 0; i < count_; ++i) {
      first_.push_back(first_.back() + blocks_[i].vertices.size());
    }
    blocks_per_entry_ =
        static_cast<double>(count_) / static_cast<double>(std::max<size_t>(size(), 1));
  }

  size_t size() const { return first_.back(); }
  size_t bytes() const {
    size_t sum = 0;
    for (size_t i = 0; i < count_; ++i) {
      sum += blocks_[i].bytes();
    }
    return sum;
  }

  // Calls visit(vertex, number of its block), in the order of the light paths.
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (size_t i = 0; i < count_; ++i) {
      for (const LightVertex& v : blocks_[i].vertices) {
        visit(v, static_cast<uint32_t>(i));
      }
    }
  }
  const CacheBlock& block(uint32_t number) const { return blocks_[number]; }

  struct Entry {
    const CacheBlock* block;
    const LightVertex* vertex;
  };
  // Entry `i` in the order of the light paths. Blocks are about equally full, so the guess is
  // close.
  Entry at(size_t i) const {
    size_t block =
        std::min(static_cast<size_t>(static_cast<double>(i) * blocks_per_entry_), count_ - 1);
    while (first_[block] > i) {
      --block;
    }
    while (first_[block + 1] <= i) {
      ++block;
    }
    return {&blocks_[block], &blocks_[block].vertices[i - first_[block]]};
  }

  // Entries to be joined with a camera vertex. RenderSettings allows 64, and one may be added by
  // chance.
  static constexpr int kMostPicks = 65;
  struct Picks {
    int count = 0;
    std::array<Entry, kMostPicks> entries;
  };

  // Picks uniformly, with `mean` entries expected unless there is none, and asks for the memory: it
  // arrives while next event estimation is at work.
  Picks pick(float mean, Sampler& sampler) const {
    Picks picks;
    if (size() == 0) {
      return picks;
    }
    picks.count = static_cast<int>(mean + sampler.next_1d());
    for (int n = 0; n < picks.count; ++n) {
      const auto i = static_cast<size_t>(sampler.next_1d() * static_cast<double>(size()));
      picks.entries[n] = at(std::min(i, size() - 1));
      const auto* bytes = reinterpret_cast<const char*>(picks.entries[n].vertex);
      __builtin_prefetch(bytes);
      __builtin_prefetch(bytes + 64);
    }
    return picks;
  }

 private:
  std::vector<CacheBlock> blocks_;
  size_t count_ = 0;  // blocks in use
  double blocks_per_entry_ = 0.0;
  std::vector<size_t> first_{0};  // number of the block's first entry; the total at the end
};

}  // namespace janus
