// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/image/exr.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <set>
#include <string_view>
#include <utility>

#include "janus/util/error.h"

namespace janus {

namespace {

using ChannelNames = std::string_view;  // a letter for each component of a pixel; a dot: none
constexpr ChannelNames kRgba = "RGBA", kGrey = "Y..A", kNumber = "X";
// Of the layers that are read, the longer ones first: colours, Cryptomatte, data.
constexpr ChannelNames kLayerNames[] = {kRgba, "RGB", "rgba", "XYZW", "XYZ", "UVA", "Z", "X"};

// --- Writing -------------------------------------------------------------------------------------

[[noreturn]] void fail_to_write(const std::string& path, const std::string& why) {
  throw IoError("cannot write " + path + ": " + why);
}

// The stream that OpenEXR writes to. OpenEXR's own loses what fails in a destructor, such as the
// last flush to a full disk; this one keeps the first error for close().
class OutputStream final : public Imf::OStream {
 public:
  OutputStream(const std::string& path, mode_t mode, int flags)
      : OStream(path.c_str()),
        descriptor_(::open(path.c_str(), O_WRONLY | O_CLOEXEC | flags, mode)) {
    error_ = descriptor_ < 0 ? errno : 0;
  }
  ~OutputStream() override { close(); }
  OutputStream(const OutputStream&) = delete;
  OutputStream& operator=(const OutputStream&) = delete;

  void write(const char* bytes, int count) override {
    if (position_ != size_) {  // a part that is filled in later, such as the table of offsets
      flush();
      put(bytes, static_cast<size_t>(count), position_);
    } else {
      buffer_.append(bytes, static_cast<size_t>(count));
      size_ += static_cast<uint64_t>(count);
    }
    position_ += static_cast<uint64_t>(count);
    if (buffer_.size() >= kBufferSize) {
      flush();
    }
  }
  uint64_t tellp() override { return position_; }
  void seekp(uint64_t position) override { position_ = position; }

  // Closes the file; the errno of the first thing that failed, or 0.
  int close() {
    if (descriptor_ >= 0) {
      flush();
      if (::close(descriptor_) != 0 && error_ == 0) {
        error_ = errno;
      }
      descriptor_ = -1;
    }
    return error_;
  }
  int error() const { return error_; }

 private:
  static constexpr size_t kBufferSize = size_t{1} << 20;

  void flush() {
    put(buffer_.data(), buffer_.size(), size_ - buffer_.size());
    buffer_.clear();
  }

  void put(const char* bytes, size_t count, uint64_t position) {
    while (count > 0 && error_ == 0) {
      const ssize_t written = ::pwrite(descriptor_, bytes, count, static_cast<off_t>(position));
      if (written >= 0) {
        bytes += written;
        count -= static_cast<size_t>(written);
        position += static_cast<uint64_t>(written);
      } else if (errno != EINTR) {
        error_ = errno;
      }
    }
  }

  int descriptor_;
  int error_ = 0;
  std::string buffer_;  // the bytes before size_ that are not in the file yet
  uint64_t position_ = 0, size_ = 0;
};

ChannelNames names_of(const Image& image) { return image.channels == 1 ? kNumber : kRgba; }

std::string channel_name(const std::string& layer, char channel) {
  return (layer.empty() ? layer : layer + ".") + channel;
}

Imf::Header make_header(const std::string& path, const std::vector<ExrLayer>& layers,
                        const Metadata& metadata) {
  const Image& first = layers.front().image;
  Imf::Header header(first.width, first.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const ExrLayer& layer : layers) {
    for (int c = 0; c < layer.image.channels; ++c) {
      const std::string name = channel_name(layer.name, names_of(layer.image)[c]);
      if (name.size() > 255 || name.find('\0') != std::string::npos) {
        fail_to_write(path, "the name of a layer must have at most 253 bytes, none of them 0");
      }
      if (header.channels().findChannel(name)) {
        fail_to_write(path, "there are two layers '" + layer.name + "'");
      }
      header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    }
  }
  // Attributes that tell how the file is laid out; the others of them are in the header already.
  static const std::set<std::string> layout = {"chunkCount", "tiles", "type", "version"};
  for (const auto& [name, value] : metadata) {
    if (name.empty() || name.size() > 255 || name.find('\0') != std::string::npos) {
      fail_to_write(path, "the name of a metadata entry must have 1 to 255 bytes, none of them 0");
    }
    if (layout.contains(name) || header.find(name) != header.end()) {
      fail_to_write(path, "the name '" + name + "' is not free for metadata");
    }
    header.insert(name, Imf::StringAttribute(value));
  }
  return header;
}

// OpenEXR has the top row first.
void flip(Image& image) {
  const auto row = static_cast<ptrdiff_t>(image.width) * image.channels;
  for (int y = 0; y < image.height / 2; ++y) {
    const auto low = image.pixels.begin() + row * y;
    std::swap_ranges(low, low + row, image.pixels.begin() + row * (image.height - 1 - y));
  }
}

// (x0, y0): where the file's coordinates of the pixels start.
void insert_slices(Imf::FrameBuffer& buffer, Image& image, const std::string& layer,
                   ChannelNames names, int x0, int y0) {
  const size_t pixel = sizeof(float) * image.channels, row = pixel * image.width;
  const ptrdiff_t start = x0 * static_cast<ptrdiff_t>(pixel) + y0 * static_cast<ptrdiff_t>(row);
  for (int c = 0; c < image.channels; ++c) {
    if (names[c] != '.') {
      char* base = reinterpret_cast<char*>(image.pixels.data() + c) - start;
      buffer.insert(channel_name(layer, names[c]),
                    Imf::Slice(Imf::FLOAT, base, pixel, row, 1, 1, c == 3 ? 1.0 : 0.0));
    }
  }
}

void write_pixels(OutputStream& stream, const Imf::Header& header, std::vector<ExrLayer>& layers) {
  Imf::OutputFile file(stream, header);
  Imf::FrameBuffer buffer;
  for (ExrLayer& layer : layers) {
    insert_slices(buffer, layer.image, layer.name, names_of(layer.image), 0, 0);
  }
  file.setFrameBuffer(buffer);
  constexpr int kRows = 256;  // so that a full disk is noticed long before the end
  const int height = layers.front().image.height;
  for (int y = 0; y < height && stream.error() == 0; y += kRows) {
    file.writePixels(std::min(kRows, height - y));
  }
}

void check_layers(const std::string& path, const std::vector<ExrLayer>& layers) {
  if (layers.empty()) {
    fail_to_write(path, "there is no layer to write");
  }
  const Image& first = layers.front().image;
  for (const auto& [name, image] : layers) {
    const int least = name.empty() ? 3 : 1, count = image.channels == 2 ? 0 : image.channels;
    if (image.width < 1 || image.height < 1 || count < least || count > 4) {
      fail_to_write(path, "an image has at least 1x1 pixels of 3 or 4 channels, or a name and 1");
    }
    if (image.width != first.width || image.height != first.height) {
      fail_to_write(path, "layer '" + name + "' has another size than the first");
    }
  }
}

// A name in the folder of `path` that nothing else has.
std::string temporary_name(const std::string& path) {
  static std::atomic<unsigned> count{0};
  const std::filesystem::path target(path);
  const std::string name = "." + target.filename().string().substr(0, 200) + "." +
                           std::to_string(::getpid()) + "-" + std::to_string(count++) + ".tmp";
  return (target.parent_path() / name).string();
}

}  // namespace

void write_exr(const std::string& path, const Image& image, const Metadata& metadata) {
  write_exr(path, std::vector<ExrLayer>{{"", image}}, metadata);
}

void write_exr(const std::string& path, std::vector<ExrLayer> layers, const Metadata& metadata) {
  check_layers(path, layers);
  // A symbolic link stays; what it points to is replaced.
  std::error_code error;
  std::string target = path;
  struct stat status{};
  const bool exists = ::stat(path.c_str(), &status) == 0;
  if (exists && std::filesystem::is_symlink(path, error)) {
    target = std::filesystem::canonical(path, error).string();
  }
  if (exists && S_ISDIR(status.st_mode)) {
    fail_to_write(path, "it is a folder");
  }
  if (exists && !S_ISREG(status.st_mode)) {
    fail_to_write(path, "it is not a regular file");
  }
  const std::string temporary = temporary_name(target);
  bool created = false;
  try {
    const Imf::Header header = make_header(path, layers, metadata);
    for (ExrLayer& layer : layers) {
      flip(layer.image);
    }
    OutputStream stream(temporary, exists ? status.st_mode & 0777 : 0666, O_CREAT | O_EXCL);
    created = stream.error() == 0;
    if (created) {
      write_pixels(stream, header, layers);
    }
    if (const int failed = stream.close()) {
      fail_to_write(path, std::strerror(failed));
    }
    if (::rename(temporary.c_str(), target.c_str()) != 0) {
      fail_to_write(path, std::strerror(errno));
    }
  } catch (const std::exception& e) {
    if (created) {
      ::unlink(temporary.c_str());
    }
    if (dynamic_cast<const IoError*>(&e)) {
      throw;
    }
    fail_to_write(path, e.what());
  }
}

// --- Reading -------------------------------------------------------------------------------------

namespace {

[[noreturn]] void fail_to_read(const std::string& path, const std::string& why) {
  throw IoError("cannot read " + path + ": " + why);
}

std::string channel_names(const Imf::ChannelList& channels) {
  std::string names;
  for (auto it = channels.begin(); it != channels.end(); ++it) {
    names += (names.empty() ? "" : ", ") + std::string(it.name());
  }
  return names;
}

// The image of the right size, before its pixels. A damaged header may ask for any size: one that
// the file cannot hold at any compression is refused before memory is taken.
Image make_image(const std::string& path, const Imath::Box2i& window, int channels) {
  constexpr int64_t kMaxSide = 1 << 16, kMaxCompression = 1 << 14;
  const int64_t width = int64_t{window.max.x} - window.min.x + 1;
  const int64_t height = int64_t{window.max.y} - window.min.y + 1;
  std::error_code error;
  const auto bytes = static_cast<int64_t>(std::filesystem::file_size(path, error));
  if (width > kMaxSide || height > kMaxSide ||
      (!error && width * height / kMaxCompression > bytes)) {
    fail_to_read(path, "its size of " + std::to_string(width) + "x" + std::to_string(height) +
                           " pixels cannot be right");
  }
  return Image(static_cast<int>(width), static_cast<int>(height), channels);
}

void check_file(const std::string& path) {
  struct stat status{};
  if (::stat(path.c_str(), &status) != 0) {
    fail_to_read(path, std::strerror(errno));
  }
  if (!S_ISREG(status.st_mode)) {
    fail_to_read(path, "it is not a regular file");
  }
}

void refuse_subsampling(const std::string& path, const Imf::ChannelList& channels,
                        const Imf::FrameBuffer& buffer) {
  for (auto it = buffer.begin(); it != buffer.end(); ++it) {
    const Imf::Channel* channel = channels.findChannel(it.name());
    if (channel && (channel->xSampling != 1 || channel->ySampling != 1)) {
      fail_to_read(path, "its channel " + std::string(it.name()) + " is subsampled");
    }
  }
}

Metadata read_metadata(const Imf::Header& header) {
  Metadata metadata;
  for (auto it = header.begin(); it != header.end(); ++it) {
    const auto* text = dynamic_cast<const Imf::StringAttribute*>(&it.attribute());
    if (text && std::strcmp(it.name(), "type") != 0) {  // OpenEXR adds the type of the layout
      metadata[it.name()] = text->value();
    }
  }
  return metadata;
}

struct FoundLayer {
  ExrLayer layer;
  ChannelNames names;
};

// What has channels NAME.R, NAME.G and NAME.B, or others of kLayerNames (R, G and B: the empty
// name), with room for the pixels.
std::vector<FoundLayer> find_layers(const std::string& path, const Imf::Header& header) {
  std::vector<FoundLayer> layers;
  const Imf::ChannelList& channels = header.channels();
  for (auto it = channels.begin(); it != channels.end(); ++it) {
    const std::string channel = it.name();
    const size_t dot = channel.rfind('.');
    const std::string name = dot == std::string::npos ? "" : channel.substr(0, dot);
    const auto has = [&](char letter) {
      return channels.findChannel(channel_name(name, letter)) != nullptr;
    };
    const auto* names = std::ranges::find_if(
        kLayerNames, [&](ChannelNames candidate) { return std::ranges::all_of(candidate, has); });
    // Each once, where its first channel comes by.
    if (names != std::end(kLayerNames) && channel == channel_name(name, (*names)[0])) {
      const auto count = static_cast<int>(names->size());
      layers.push_back({{name, make_image(path, header.dataWindow(), count)}, *names});
    }
  }
  return layers;
}

}  // namespace

ExrFile read_exr(const std::string& path) {
  check_file(path);
  try {
    Imf::InputFile file(path.c_str());
    const Imf::Header& header = file.header();
    const Imf::ChannelList& channels = header.channels();
    const bool rgb =
        channels.findChannel("R") && channels.findChannel("G") && channels.findChannel("B");
    const bool grey = !rgb && channels.findChannel("Y") && !channels.findChannel("RY");
    if (!rgb && !grey) {
      fail_to_read(path, "it has no channels R, G and B, but: " + channel_names(channels));
    }
    const Imath::Box2i window = header.dataWindow();
    ExrFile result{make_image(path, window, 4), {}};
    Imf::FrameBuffer buffer;
    insert_slices(buffer, result.image, "", grey ? kGrey : kRgba, window.min.x, window.min.y);
    refuse_subsampling(path, channels, buffer);
    file.setFrameBuffer(buffer);
    file.readPixels(window.min.y, window.max.y);
    if (grey) {
      for (size_t i = 0; i < result.image.pixels.size(); i += 4) {
        result.image.pixels[i + 1] = result.image.pixels[i + 2] = result.image.pixels[i];
      }
    }
    flip(result.image);
    result.metadata = read_metadata(header);
    return result;
  } catch (const IoError&) {
    throw;
  } catch (const std::exception& e) {
    fail_to_read(path, e.what());
  }
}

ExrLayers read_exr_layers(const std::string& path) {
  check_file(path);
  try {
    Imf::MultiPartInputFile file(path.c_str());
    ExrLayers result;
    result.metadata = read_metadata(file.header(0));
    for (int number = 0; number < file.parts(); ++number) {
      const Imf::Header& header = file.header(number);
      const Imath::Box2i window = header.dataWindow();
      std::vector<FoundLayer> layers = find_layers(path, header);
      Imf::FrameBuffer buffer;
      for (auto& [layer, names] : layers) {
        insert_slices(buffer, layer.image, layer.name, names, window.min.x, window.min.y);
      }
      refuse_subsampling(path, header.channels(), buffer);
      Imf::InputPart part(file, number);
      part.setFrameBuffer(buffer);
      part.readPixels(window.min.y, window.max.y);
      for (auto& [layer, names] : layers) {
        flip(layer.image);
        result.layers.push_back(std::move(layer));
      }
    }
    return result;
  } catch (const IoError&) {
    throw;
  } catch (const std::exception& e) {
    fail_to_read(path, e.what());
  }
}

}  // namespace janus
