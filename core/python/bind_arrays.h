// SPDX-License-Identifier: GPL-3.0-or-later
//
// NumPy's arrays as the core's vectors. What does not fit is a SceneError with the key and the
// part.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bind.h"
#include "janus/util/error.h"

namespace janus::python {

using Key = const std::string&;

inline std::string shape_of(const py::array& a) {
  return py::str(a.attr("shape")).cast<std::string>();
}

// Checks for [N, columns] (columns 0: [N]) and returns N.
inline size_t rows(Key key, const char* path, const py::array& a, py::ssize_t columns) {
  const bool ok = columns ? a.ndim() == 2 && a.shape(1) == columns : a.ndim() == 1;
  if (!ok) {
    throw SceneError(key, path,
                     "the shape must be " +
                         (columns ? "(N, " + std::to_string(columns) + ")" : "(N,)") + ", not " +
                         shape_of(a));
  }
  return static_cast<size_t>(a.shape(0));
}

inline std::vector<vec3> to_vectors(Key key, const char* path, const py::array& a) {
  const char kind = a.dtype().kind();
  if (kind != 'f' && kind != 'i' && kind != 'u') {
    throw SceneError(key, path, "must hold numbers");
  }
  const size_t count = rows(key, path, a, 3);
  const auto values = py::array_t<float, py::array::c_style | py::array::forcecast>::ensure(a);
  const auto* first = reinterpret_cast<const vec3*>(values.data());
  return {first, first + count};
}

template <class T>
void copy_indices(Key key, const char* path, const py::array& a, uint32_t* out) {
  const auto values = py::array_t<T, py::array::c_style | py::array::forcecast>::ensure(a);
  for (py::ssize_t i = 0; i < values.size(); ++i) {
    const T value = values.data()[i];
    if (value < 0 || static_cast<uint64_t>(value) > UINT32_MAX) {
      const py::ssize_t row = a.ndim() == 2 ? i / a.shape(1) : i;
      throw SceneError(key, path + ("[" + std::to_string(row) + "]"),
                       "the index " + std::to_string(value) + " is out of range");
    }
    out[i] = static_cast<uint32_t>(value);
  }
}

// Indices of any integer type, as Index (uint32_t, or a vector of `columns` of them); the core
// checks the upper bound. Blender's own type is copied in one go.
template <class Index>
std::vector<Index> to_indices(Key key, const char* path, const py::array& a, py::ssize_t columns) {
  const char kind = a.dtype().kind();
  if (kind != 'i' && kind != 'u') {
    throw SceneError(key, path, "must hold integers");
  }
  std::vector<Index> result(rows(key, path, a, columns));
  auto* out = reinterpret_cast<uint32_t*>(result.data());
  if (a.dtype().equal(py::dtype::of<int32_t>())) {
    copy_indices<int32_t>(key, path, a, out);
  } else {
    copy_indices<int64_t>(key, path, a, out);
  }
  return result;
}

// Anything that NumPy makes an array of.
inline py::array to_array(const py::object& value) {
  auto a = py::array::ensure(value);
  if (!a) {
    throw py::type_error("not an array of numbers");
  }
  return a;
}

inline std::optional<py::array> optional_array(const py::object& value) {
  if (value.is_none()) {
    return std::nullopt;
  }
  return to_array(value);
}

}  // namespace janus::python
