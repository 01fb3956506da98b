// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cryptomatte (Friedman and Jones 2015; specification 1.2.0): which names a pixel shows, and how
// much of it each covers. A name is known by a hash, which is kept as a float.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace janus {

// MurmurHash3_x86_32 with seed 0.
uint32_t cryptomatte_hash(std::string_view name);

// The hash as a float that is neither a denormal nor infinite, nor a NaN: those have an exponent of
// nought or of ones alone, whose lowest bit is turned.
float cryptomatte_id(uint32_t hash);

// Eight digits, as manifests have it.
std::string cryptomatte_hex(uint32_t hash);

struct Coverage {
  float id = 0.0f, weight = 0.0f;  // id 0: nobody
};

// Adds to the slot that has the id, or to a free one; where none is left, to the last.
inline void add_coverage(std::span<Coverage> slots, float id, float weight) {
  for (Coverage& slot : slots) {
    if (slot.id == 0.0f) {
      slot.id = id;
    }
    if (slot.id == id || &slot == &slots.back()) {
      slot.weight += weight;
      return;
    }
  }
}

}  // namespace janus
