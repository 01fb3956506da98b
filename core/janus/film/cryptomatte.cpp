// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/film/cryptomatte.h"

#include <bit>
#include <cstdio>
#include <cstring>

namespace janus {

uint32_t cryptomatte_hash(std::string_view name) {
  constexpr uint32_t kFirst = 0xcc9e2d51U, kSecond = 0x1b873593U;
  const auto mixed = [](uint32_t k) { return std::rotl(k * kFirst, 15) * kSecond; };
  uint32_t hash = 0;
  size_t at = 0;
  for (; at + 4 <= name.size(); at += 4) {
    uint32_t block;  // little-endian, as all that Blender runs on
    std::memcpy(&block, name.data() + at, sizeof block);
    hash = std::rotl(hash ^ mixed(block), 13) * 5U + 0xe6546b64U;
  }
  uint32_t tail = 0;
  for (size_t i = name.size(); i > at; --i) {
    tail = tail << 8 | static_cast<uint8_t>(name[i - 1]);
  }
  hash ^= mixed(tail);
  hash ^= static_cast<uint32_t>(name.size());
  hash = (hash ^ hash >> 16) * 0x85ebca6bU;
  hash = (hash ^ hash >> 13) * 0xc2b2ae35U;
  return hash ^ hash >> 16;
}

float cryptomatte_id(uint32_t hash) {
  const uint32_t exponent = hash >> 23 & 0xffU;
  return std::bit_cast<float>(exponent == 0 || exponent == 0xffU ? hash ^ 1U << 23 : hash);
}

std::string cryptomatte_hex(uint32_t hash) {
  char text[9];
  std::snprintf(text, sizeof text, "%08x", hash);
  return text;
}

}  // namespace janus
