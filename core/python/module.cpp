// SPDX-License-Identifier: GPL-3.0-or-later
//
// The native module janus_core._core. It holds no OpenEXR: it lives in Blender's process, which has
// its own.
#include <algorithm>

#include "bind.h"
#include "janus/geometry/accel.h"
#include "janus/shading/node_types.h"

namespace janus::python {

namespace {

const char* name_of(SocketType type) {
  switch (type) {
    case SocketType::Float:
      return "FLOAT";
    case SocketType::Vector:
      return "VECTOR";
    case SocketType::Color:
      return "COLOR";
    case SocketType::Closure:
      break;
  }
  return "CLOSURE";
}

py::list names(std::span<const std::string_view> items) {
  py::list result;
  for (const std::string_view item : items) {
    result.append(std::string(item));
  }
  return result;
}

py::list node_type_list() {
  py::list result;
  for (const NodeDecl& decl : node_types()) {
    py::list inputs;
    for (const SocketDecl& socket : decl.inputs) {
      py::dict input;
      input["identifier"] = std::string(socket.identifier);
      input["type"] = name_of(socket.type);
      input["default"] = py::make_tuple(socket.value.x, socket.value.y, socket.value.z);
      inputs.append(input);
    }
    py::dict node;
    node["type"] = std::string(decl.type);
    node["inputs"] = inputs;
    py::list outputs;
    for (const std::string_view output : decl.outputs) {
      outputs.append(std::string(output));
    }
    node["outputs"] = outputs;
    py::dict settings;
    for (const EnumDecl& setting : decl.settings) {
      settings[py::str(std::string(setting.property))] =
          py::make_tuple(names(setting.items), names(setting.named));
    }
    node["settings"] = settings;
    result.append(node);
  }
  return result;
}

py::dict build_info() {
  py::dict info;
  info["version"] = JANUS_VERSION;
  info["embree"] = Accel::embree_version();
  info["compiler"] = __VERSION__;
  info["python"] = PY_VERSION;
  info["pybind11"] =
      PYBIND11_TOSTRING(PYBIND11_VERSION_MAJOR) "." PYBIND11_TOSTRING(PYBIND11_VERSION_MINOR);
#ifdef NDEBUG
  info["asserts"] = false;
#else
  info["asserts"] = true;
#endif
  return info;
}

}  // namespace

}  // namespace janus::python

PYBIND11_MODULE(_core, m) {
  using namespace janus::python;
  m.doc() = "The native core of Janus. Import janus_core, not this.";
  m.attr("__version__") = JANUS_VERSION;
  bind_errors(m);
  bind_scene(m);
  bind_session(m);
  bind_transport(m);
  m.def("build_info", &build_info,
        "Versions of the core, of Embree and of the tools that it was built with, as a dict.");
  m.def("node_types", &node_type_list,
        "The shader nodes that the core knows: a list of dicts with type (Blender's node.type), "
        "inputs (identifier, type, default, and whether a value other than the default is left out "
        "and named), outputs, and settings: for each property the items that are supported, and "
        "those that are named where they matter.");
}
