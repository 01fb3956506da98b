// SPDX-License-Identifier: GPL-3.0-or-later
//
// Passes that say what the camera sees rather than how bright it is, with Blender's names.
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "janus/film/cryptomatte.h"
#include "janus/film/film.h"

namespace janus {

enum class DataPass : uint8_t {
  Depth,
  Position,
  ObjectIndex,
  MaterialIndex,
  Normal,
  Uv,
  Vector,
  Mist,
  AmbientOcclusion,
  DenoisingAlbedo,
  DenoisingNormal,
  DenoisingDepth,
  SampleCount
};
struct DataPassInfo {
  const char* name;
  int channels;
  bool first;         // what the first sample of a pixel sees: means would make no sense
  bool seen = false;  // the mean over the samples that see a surface, not over all

  // Numbers that the film keeps.
  constexpr size_t kept() const { return static_cast<size_t>(channels) + (seen ? 1 : 0); }
};
inline constexpr DataPassInfo kDataPasses[] = {{"Depth", 1, true},
                                               {"Position", 3, true},
                                               {"IndexOB", 1, true},
                                               {"IndexMA", 1, true},
                                               {"Normal", 3, false},
                                               {"UV", 3, false},
                                               {"Vector", 4, false, true},
                                               {"Mist", 1, false},
                                               {"AO", 3, false},
                                               {"Denoising Albedo", 3, false},
                                               {"Denoising Normal", 3, false},
                                               {"Denoising Depth", 1, false},
                                               {"Debug Sample Count", 1, true}};
inline constexpr size_t kDataPassCount = std::size(kDataPasses);

// What Cryptomatte tells apart.
enum class MatteKind : uint8_t { Object, Material, Asset };
inline constexpr const char* kMatteNames[] = {"CryptoObject", "CryptoMaterial", "CryptoAsset"};
inline constexpr size_t kMatteKinds = std::size(kMatteNames);

// An AOV of a view layer.
struct AovPass {
  std::string name;
  bool color = true;  // what the nodes' Color says, and alpha; false: their Value

  size_t channels() const { return color ? 4 : 1; }
  // Of its picture: a name that no other pass has.
  std::string picture() const { return "AOV " + name; }
};

// Which passes are wanted.
struct DataChoice {
  bool passes[kDataPassCount] = {};
  bool mattes[kMatteKinds] = {};
  int matte_levels = 3;  // pictures of two ids each
  std::vector<AovPass> aovs;

  bool wants(DataPass pass) const { return passes[static_cast<size_t>(pass)]; }
  bool wants(MatteKind kind) const { return mattes[static_cast<size_t>(kind)]; }
  bool features() const {
    return wants(DataPass::DenoisingAlbedo) || wants(DataPass::DenoisingNormal) ||
           wants(DataPass::DenoisingDepth);
  }
  // Is anything but that wanted of surfaces?
  bool surfaces() const;
  bool any() const;
  // The names of all pictures that there are then: CryptoObject00, CryptoObject01, ...
  std::vector<std::string> names() const;
};

// What one camera sample sees. What it does not see is as it is here.
struct DataSample {
  float values[kDataPassCount][5] = {};
  struct Matte {
    float ids[kMatteKinds];
    float weight;
  };
  std::vector<Matte> mattes;
  std::vector<vec4> aovs;  // as many as are wanted, or none

  void set(DataPass pass, vec3 value) {
    float* to = values[static_cast<size_t>(pass)];
    to[0] = value.x, to[1] = value.y, to[2] = value.z;
  }
  // Of a surface that is seen.
  void set_seen(DataPass pass, vec4 value) {
    float* to = values[static_cast<size_t>(pass)];
    to[0] = value.x, to[1] = value.y, to[2] = value.z, to[3] = value.w, to[4] = 1.0f;
  }
  void set(DataPass pass, float value) { values[static_cast<size_t>(pass)][0] = value; }
};

// Accumulates samples. A pixel is the mean of those that it has got, so a pass that was abandoned
// does no harm.
class DataFilm {
 public:
  DataFilm(FilmRect rect, DataChoice choice);

  // Bytes that one takes.
  static size_t bytes(const FilmRect& rect, const DataChoice& choice);

  const DataChoice& choice() const { return choice_; }

  // Adds one sample, or none, to each of the pixels from `first` on. May be called from any thread.
  void add(size_t first, std::span<const std::optional<DataSample>> samples);

  // The picture of that name (DataChoice::names()) so far. May be called from any thread.
  Image develop(const std::string& name) const;

 private:
  size_t slots() const { return 2 * static_cast<size_t>(choice_.matte_levels); }
  std::span<Coverage> coverages(size_t pixel, size_t kind);
  Image develop_pass(size_t pass) const;
  Image develop_matte(size_t kind, size_t level) const;
  Image develop_aov(size_t aov) const;

  FilmRect rect_;
  DataChoice choice_;
  mutable std::mutex mutex_;  // guards all below
  std::vector<uint32_t> counts_;
  std::vector<float> passes_[kDataPassCount];  // of those that are wanted, what is kept in a row
  std::vector<Coverage> mattes_[kMatteKinds];
  std::vector<std::vector<float>> aovs_;
};

}  // namespace janus
