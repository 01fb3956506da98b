// SPDX-License-Identifier: GPL-3.0-or-later
//
// OpenEXR files. Part of the library janus_exr, which Blender never loads.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "janus/image/image.h"

namespace janus {

using Metadata = std::map<std::string, std::string>;

// Writes `image` (3 channels: R, G, B; 4: R, G, B, A) as 32-bit float channels, ZIP-compressed, and
// `metadata` as string attributes. `path` is a byte string as the system takes it. The file appears
// under its name when it is complete: a failed write leaves what was there before. Throws IoError
// naming the file.
void write_exr(const std::string& path, const Image& image, const Metadata& metadata = {});

// One of several pictures in a file. Its channels are called NAME.R and so on; R and so on where
// the name is empty.
struct ExrLayer {
  std::string name;
  Image image;  // 3 channels: R, G, B; 4: R, G, B, A; where there is a name, 1: X
};

// The same for layers of one size, whose names differ.
void write_exr(const std::string& path, std::vector<ExrLayer> layers,
               const Metadata& metadata = {});

struct ExrFile {
  Image image;        // 4 channels: R, G, B, A
  Metadata metadata;  // the string attributes
};

// Reads the R, G, B and A channels of the data window as float; half and integer channels are
// converted, A is 1 where there is none, a lone Y is grey. Throws IoError naming the file.
ExrFile read_exr(const std::string& path);

struct ExrLayers {
  std::vector<ExrLayer> layers;  // by name in each part
  Metadata metadata;             // the string attributes of the first part
};

// Reads everything that has channels R, G and B, perhaps A; r, g, b and a; X, Y, Z, perhaps W;
// U, V and A; or Z or X alone; in all parts of the file. In this order, whatever the file's.
ExrLayers read_exr_layers(const std::string& path);

}  // namespace janus
