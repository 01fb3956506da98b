// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/film/data_film.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

namespace janus::test {
namespace {

// Of the reference implementation of MurmurHash3_x86_32, seed 0.
TEST(Cryptomatte, HashesNames) {
  EXPECT_EQ(cryptomatte_hash(""), 0u);
  EXPECT_EQ(cryptomatte_hash("hello"), 0x248bfa47u);
  EXPECT_EQ(cryptomatte_hash("hello, world"), 0x149bbb7fu);
  EXPECT_EQ(cryptomatte_hash("The quick brown fox jumps over the lazy dog"), 0x2e4ff723u);
  EXPECT_EQ(cryptomatte_hex(0x2e4ffu), "0002e4ff");
}

TEST(Cryptomatte, IdsAreNormalNumbers) {
  for (const uint32_t hash : {0u, 1u, 0x007fffffu, 0x80000001u, 0x7f800000u, 0xff812345u}) {
    EXPECT_TRUE(std::isnormal(cryptomatte_id(hash))) << hash;
    EXPECT_EQ(std::bit_cast<uint32_t>(cryptomatte_id(hash)), hash ^ 1u << 23);
  }
  EXPECT_EQ(std::bit_cast<uint32_t>(cryptomatte_id(0x248bfa47u)), 0x248bfa47u);
}

DataChoice choice() {
  DataChoice c;
  for (const DataPass pass :
       {DataPass::Depth, DataPass::Normal, DataPass::Mist, DataPass::Uv, DataPass::SampleCount}) {
    c.passes[static_cast<size_t>(pass)] = true;
  }
  c.mattes[static_cast<size_t>(MatteKind::Material)] = true;
  c.matte_levels = 2;
  return c;
}

DataSample sample(float depth, vec3 normal, std::vector<std::pair<float, float>> materials) {
  DataSample s;
  s.set(DataPass::Depth, depth);
  s.set(DataPass::Normal, normal);
  s.set(DataPass::Mist, 0.25f * depth);
  for (const auto& [id, weight] : materials) {
    s.mattes.push_back({{-1.0f, id, -1.0f}, weight});
  }
  return s;
}

TEST(DataFilm, HasThePassesThatWereAskedFor) {
  const std::vector<std::string> names = {
      "Depth",           "Normal", "UV", "Mist", "Debug Sample Count", "CryptoMaterial00",
      "CryptoMaterial01"};
  EXPECT_EQ(choice().names(), names);
  EXPECT_FALSE(DataChoice().any());
  EXPECT_TRUE(choice().surfaces() && !choice().features());
  DataChoice features;
  features.passes[static_cast<size_t>(DataPass::DenoisingAlbedo)] = true;
  EXPECT_TRUE(features.features() && !features.surfaces());
  DataFilm film({0, 0, 3, 2}, choice());
  EXPECT_EQ(film.develop("UV").channels, 3);
  EXPECT_EQ(film.develop("CryptoMaterial01").channels, 4);
  EXPECT_THROW(film.develop("Position"), std::exception);
  EXPECT_THROW(film.develop("CryptoObject00"), std::exception);
  EXPECT_EQ(DataFilm::bytes({0, 0, 3, 2}, choice()),
            6 * sizeof(float) * (1 + 1 + 3 + 3 + 1 + 1 + 8));
}

// One pixel with two samples, one with one, one with none.
TEST(DataFilm, KeepsFirstSamplesAndMeans) {
  DataFilm film({5, 5, 8, 6}, choice());
  const std::optional<DataSample> first[] = {sample(2, {0, 0, 1}, {}), sample(3, {1, 0, 0}, {})};
  film.add(0, first);
  const std::optional<DataSample> second[] = {sample(1, {0, 1, 0}, {}), std::nullopt};
  film.add(0, second);
  EXPECT_EQ(film.develop("Depth").pixels, (std::vector<float>{2, 3, 1e10f}));
  EXPECT_EQ(film.develop("Normal").pixels, (std::vector<float>{0, .5f, .5f, 1, 0, 0, 0, 0, 0}));
  EXPECT_EQ(film.develop("Mist").pixels, (std::vector<float>{1 - .375f, .25f, 1}));
  EXPECT_EQ(film.develop("Debug Sample Count").pixels, (std::vector<float>{2, 1, 0}));
}

// The mean over what sees a surface: a sample of nothing does not make it slower.
TEST(DataFilm, TakesTheMeanOfWhatIsSeen) {
  DataChoice vector;
  vector.passes[static_cast<size_t>(DataPass::Vector)] = true;
  DataFilm film({0, 0, 2, 1}, vector);
  std::optional<DataSample> samples[] = {DataSample(), DataSample()};
  film.add(0, samples);
  samples[0]->set_seen(DataPass::Vector, vec4(1, 2, 3, 4));
  film.add(0, samples);
  samples[0]->set_seen(DataPass::Vector, vec4(3, 4, 5, 6));
  film.add(0, samples);
  EXPECT_EQ(film.develop("Vector").pixels, (std::vector<float>{2, 3, 4, 5, 0, 0, 0, 0}));
  EXPECT_EQ(DataFilm::bytes({0, 0, 2, 1}, vector), 2 * sizeof(float) * (1 + 5));
}

TEST(DataFilm, TakesTheMeanOfAovs) {
  DataChoice aovs;
  aovs.aovs = {{"Tint", true}, {"Mask", false}};
  EXPECT_EQ(aovs.names(), (std::vector<std::string>{"AOV Tint", "AOV Mask"}));
  EXPECT_TRUE(aovs.any() && aovs.surfaces() && !aovs.features());
  DataFilm film({0, 0, 2, 1}, aovs);
  std::optional<DataSample> samples[] = {DataSample(), std::nullopt};
  film.add(0, samples);  // sees nothing that writes
  samples[0]->aovs = {vec4(2, -4, 6, 2), vec4(-3, 0, 0, 0)};
  film.add(0, samples);
  EXPECT_EQ(film.develop("AOV Tint").pixels, (std::vector<float>{1, -2, 3, 1, 0, 0, 0, 0}));
  EXPECT_EQ(film.develop("AOV Mask").pixels, (std::vector<float>{-1.5f, 0}));
  EXPECT_THROW(film.develop("Tint"), std::exception);
  EXPECT_EQ(DataFilm::bytes({0, 0, 2, 1}, aovs), 2 * sizeof(float) * (1 + 4 + 1));
}

// Ids by their coverage, two in a picture; what finds no place counts for the last.
TEST(DataFilm, SortsMattesByCoverage) {
  DataFilm film({0, 0, 1, 1}, choice());
  const DataSample samples[] = {sample(1, {}, {{7, .25f}, {8, .5f}}), sample(1, {}, {{9, 1}}),
                                sample(1, {}, {{8, .5f}, {10, .25f}, {11, .125f}}),
                                sample(1, {}, {})};
  for (const DataSample& s : samples) {
    const std::optional<DataSample> one[] = {s};
    film.add(0, one);
  }
  const Image best = film.develop("CryptoMaterial00"), rest = film.develop("CryptoMaterial01");
  EXPECT_EQ(best.pixels, (std::vector<float>{8, .25f, 9, .25f}));
  EXPECT_EQ(rest.pixels, (std::vector<float>{10, .375f / 4, 7, .0625f}));
}

}  // namespace
}  // namespace janus::test
