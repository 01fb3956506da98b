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

// As a C array of T. Raises what NumPy does where it cannot be made, such as MemoryError.
template <class T>
auto converted(const py::object& a) {
  return py::array_t<T, py::array::c_style | py::array::forcecast>(a);
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
  const auto values = converted<float>(a);
  const auto* first = reinterpret_cast<const vec3*>(values.data());
  return {first, first + count};
}

inline std::vector<float> to_numbers(Key key, const char* path, const py::array& a) {
  const size_t count = rows(key, path, a, 0);
  const auto values = py::array_t<float, py::array::c_style | py::array::forcecast>::ensure(a);
  if (!values) {
    PyErr_Clear();
    throw SceneError(key, path, "must hold numbers");
  }
  return {values.data(), values.data() + count};
}

template <class T>
void copy_indices(Key key, const char* path, const py::array& a, uint32_t* out) {
  const auto values = converted<T>(a);
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

// float[N, rows, columns] as N matrices; `read(values, i)` makes one of the i-th.
template <class T, class Read>
std::vector<T> to_series(Key key, const char* path, const py::object& value, py::ssize_t rows,
                         py::ssize_t columns, Read&& read) {
  const auto a = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(value);
  if (!a || a.ndim() != 3 || (rows && a.shape(1) != rows) || a.shape(2) != columns) {
    PyErr_Clear();
    std::string shape = "must be an array of numbers, (N, ";
    shape += rows ? std::to_string(rows) : "M";
    shape += ", ";
    shape += std::to_string(columns);
    shape += ")";
    throw SceneError(key, path, shape);
  }
  std::vector<T> result;
  for (py::ssize_t i = 0; i < a.shape(0); ++i) {
    result.push_back(read(a.data() + i * a.shape(1) * columns, a.shape(1)));
  }
  return result;
}

// From the rows of a matrix.
inline mat4 to_matrix(const double* rows) {
  mat4 result;
  for (int i = 0; i < 16; ++i) {
    result[i % 4][i / 4] = static_cast<float>(rows[i]);
  }
  return result;
}

inline mat4 to_matrix(Key key, const py::object& value) {
  const auto a = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(value);
  if (!a || a.ndim() != 2 || a.shape(0) != 4 || a.shape(1) != 4) {
    PyErr_Clear();
    throw SceneError(key, "transform", "must be a 4x4 matrix of numbers");
  }
  return to_matrix(a.data());
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
