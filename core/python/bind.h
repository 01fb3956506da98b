// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the binding files share. Python errors are TypeError for a wrong kind of argument and
// SceneError, with key and path, for data that cannot be rendered.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <string>
#include <vector>

#include "janus/math/vec.h"
#include "janus/scene/node_graph.h"

namespace janus {
class SceneBuilder;
}

namespace janus::python {

namespace py = pybind11;

void bind_errors(py::module_& m);
void bind_scene(py::module_& m);
void bind_mesh(py::class_<SceneBuilder>& builder);
void bind_motion(py::class_<SceneBuilder>& builder);
void bind_session(py::module_& m);
void bind_transport(py::module_& m);

// {"nodes": [...], "surface": ...} as the add-on's flattener writes it. `key` is for messages.
NodeGraph to_graph(const std::string& key, const py::dict& graph);

// Raises the pending Python exception after Ctrl-C. Needs the GIL.
inline void check_signals() {
  if (PyErr_CheckSignals() != 0) {
    throw py::error_already_set();
  }
}

// Calls wait(seconds), which tells whether what it waits for has come, without the GIL and in
// slices short enough for Ctrl-C, until it has, or `seconds` have passed: true or false. No number
// is no time. Needs the GIL.
template <class Wait>
bool wait_slices(Wait&& wait, double seconds) {
  constexpr double kSlice = 0.1;
  for (;;) {
    bool ended;
    {
      const py::gil_scoped_release release;
      ended = wait(seconds > 0.0 ? std::min(seconds, kSlice) : 0.0);
    }
    check_signals();
    seconds -= kSlice;
    if (ended || !(seconds > 0.0)) {
      return ended;
    }
  }
}

// The two names of a value of an enum, for tables shared by both directions.
template <class Enum>
struct EnumName {
  const char* name;
  Enum value;
};

template <class Enum, size_t N>
Enum from_name(const EnumName<Enum> (&table)[N], const std::string& name, const std::string& what) {
  std::string known;
  for (const auto& entry : table) {
    if (name == entry.name) {
      return entry.value;
    }
    known += (known.empty() ? "" : ", ") + std::string(entry.name);
  }
  throw py::value_error(what + ": '" + name + "' is none of " + known);
}

template <class Enum, size_t N>
std::string to_name(const EnumName<Enum> (&table)[N], Enum value) {
  for (const auto& entry : table) {
    if (value == entry.value) {
      return entry.name;
    }
  }
  return "?";
}

}  // namespace janus::python
