// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/film/transport_film.h"

#include <algorithm>

namespace janus {

void TransportFilm::begin_pass() {
  for (auto* lists : {&camera_, &light_}) {
    for (auto& list : *lists) {
      list.clear();
    }
  }
}

void TransportFilm::end_pass(ThreadPool& pool) {
  pool.parallel_for(tiles_.rows(), [&](size_t row) {
    const size_t first = row * CameraTiles::kSide;
    const size_t end = std::min<size_t>(first + CameraTiles::kSide, tiles_.height);
    std::vector<Transported> taken;
    for (size_t y = first; y < end; ++y) {
      taken.insert(taken.end(), camera_[y].begin(), camera_[y].end());
    }
    const auto begin_pixel = static_cast<uint32_t>(first * tiles_.width);
    const auto end_pixel = static_cast<uint32_t>(end * tiles_.width);
    for (const auto& list : light_) {
      std::ranges::copy_if(list, std::back_inserter(taken), [&](const Transported& t) {
        return t.pixel >= begin_pixel && t.pixel < end_pixel;
      });
    }
    take(taken);
  });
  pass_taken();
}

}  // namespace janus
