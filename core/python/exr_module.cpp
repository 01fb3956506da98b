// SPDX-License-Identifier: GPL-3.0-or-later
//
// The module janus_core._exr: OpenEXR files. Apart from _core, so that Blender never loads OpenEXR.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "janus/image/exr.h"
#include "janus/util/error.h"

namespace py = pybind11;

namespace janus {

namespace {

// Raises janus_core.IoError. It is _core's class: the two modules share no C++ type.
void translate(std::exception_ptr pointer) {
  try {
    if (pointer) {
      std::rethrow_exception(pointer);
    }
  } catch (const IoError& error) {
    const py::object type = py::module_::import("janus_core._core").attr("IoError");
    // The message has the bytes of the path, which need not be UTF-8.
    const auto text = py::reinterpret_steal<py::object>(PyUnicode_DecodeFSDefault(error.what()));
    PyErr_SetObject(type.ptr(), text.ptr());
  }
}

py::str decode(const std::string& bytes) {
  return py::reinterpret_steal<py::str>(
      PyUnicode_DecodeUTF8(bytes.data(), static_cast<Py_ssize_t>(bytes.size()), "replace"));
}

using Pixels = py::array_t<float, py::array::c_style | py::array::forcecast>;

Image make_image(const Pixels& pixels) {
  const auto channels = pixels.ndim() == 3 ? pixels.shape(2) : 0;
  if (channels != 3 && channels != 4 && channels != 1) {
    throw py::value_error("pixels must have the shape [height, width, 4], or 3 or 1 for it");
  }
  constexpr py::ssize_t kMaxSide = 1 << 16;
  if (pixels.shape(0) > kMaxSide || pixels.shape(1) > kMaxSide) {
    throw py::value_error("pixels must have at most 65536 rows and columns");
  }
  Image image(static_cast<int>(pixels.shape(1)), static_cast<int>(pixels.shape(0)),
              static_cast<int>(pixels.shape(2)));
  std::copy_n(pixels.data(), image.pixels.size(), image.pixels.data());
  return image;
}

void write(const std::string& path, const Pixels& pixels, const Metadata& metadata) {
  const Image image = make_image(pixels);
  const py::gil_scoped_release released;
  write_exr(path, image, metadata);
}

void write_layers(const std::string& path,
                  const std::vector<std::pair<std::string, Pixels>>& pictures,
                  const Metadata& metadata) {
  std::vector<ExrLayer> layers;
  for (const auto& [name, pixels] : pictures) {
    layers.push_back({name, make_image(pixels)});
  }
  const py::gil_scoped_release released;
  write_exr(path, std::move(layers), metadata);
}

py::dict decode(const Metadata& metadata) {
  py::dict result;
  for (const auto& [name, value] : metadata) {
    result[decode(name)] = decode(value);
  }
  return result;
}

py::tuple read(const std::string& path) {
  auto file = std::make_unique<ExrFile>();
  {
    const py::gil_scoped_release released;
    *file = read_exr(path);
  }
  const py::dict metadata = decode(file->metadata);
  const Image& image = file->image;
  const float* data = image.pixels.data();
  const py::ssize_t height = image.height, width = image.width;
  const py::capsule owner(file.release(), [](void* p) { delete static_cast<ExrFile*>(p); });
  return py::make_tuple(py::array_t<float>({height, width, py::ssize_t{4}}, data, owner), metadata);
}

py::tuple read_layers(const std::string& path) {
  ExrLayers file;
  {
    const py::gil_scoped_release released;
    file = read_exr_layers(path);
  }
  py::list layers;
  for (const auto& [name, image] : file.layers) {
    const py::ssize_t height = image.height, width = image.width, channels = image.channels;
    layers.append(py::make_tuple(
        decode(name), py::array_t<float>({height, width, channels}, image.pixels.data())));
  }
  return py::make_tuple(layers, decode(file.metadata));
}

}  // namespace

}  // namespace janus

PYBIND11_MODULE(_exr, module, py::mod_gil_not_used()) {
  module.doc() = "OpenEXR files; use janus_core.exr.";
  py::register_local_exception_translator(janus::translate);
  module.def("write", &janus::write, py::arg("path"), py::arg("pixels"), py::arg("metadata"),
             "Writes float32[H, W, 3 or 4], bottom row first, to the path (bytes).");
  module.def("write_layers", &janus::write_layers, py::arg("path"), py::arg("layers"),
             py::arg("metadata"),
             "The same for (name, pixels) of several pictures of one size, or float32[H, W, 1].");
  module.def("read_layers", &janus::read_layers, py::arg("path"),
             "([(name, float32[H, W, 3 or 4] bottom row first)], metadata) of all that is RGB.");
  module.def("read", &janus::read, py::arg("path"),
             "(float32[H, W, 4] bottom row first, metadata) of the file at the path (bytes).");
}
