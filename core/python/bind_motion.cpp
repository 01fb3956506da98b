// SPDX-License-Identifier: GPL-3.0-or-later
#include "bind_arrays.h"
#include "janus/render/builder.h"

namespace janus::python {

namespace {

using namespace py::literals;

std::vector<mat4> to_matrices(Key key, const py::object& value) {
  return to_series<mat4>(key, "motion", value, 4, 4,
                         [](const double* rows, py::ssize_t) { return to_matrix(rows); });
}

std::vector<std::vector<vec3>> to_vector_series(Key key, const char* path,
                                                const py::object& value) {
  return to_series<std::vector<vec3>>(key, path, value, 0, 3, [](const double* v, py::ssize_t n) {
    std::vector<vec3> vectors(static_cast<size_t>(n));
    for (vec3& to : vectors) {
      to = vec3(v[0], v[1], v[2]);
      v += 3;
    }
    return vectors;
  });
}

void set_mesh_motion(SceneBuilder& self, Key key, const py::object& positions,
                     const py::object& normals) {
  auto places = to_vector_series(key, "motion positions", positions);
  std::vector<std::vector<vec3>> turned(places.size());
  if (!normals.is_none()) {
    turned = to_vector_series(key, "motion normals", normals);
    if (turned.size() != places.size()) {
      throw SceneError(key, "motion normals",
                       "are of " + std::to_string(turned.size()) + " times, positions of " +
                           std::to_string(places.size()));
    }
  }
  std::vector<MeshKey> motion;
  for (size_t i = 0; i < places.size(); ++i) {
    motion.push_back({std::move(places[i]), std::move(turned[i])});
  }
  self.set_mesh_motion(key, std::move(motion));
}

void set_camera_motion(SceneBuilder& self, const py::object& transforms,
                       const std::vector<std::array<float, 4>>& windows) {
  const std::vector<mat4> matrices = to_matrices("camera", transforms);
  if (matrices.size() != windows.size()) {
    throw SceneError("camera", "motion", "transforms and windows are of different lengths");
  }
  std::vector<CameraDesc::Key> motion;
  for (size_t i = 0; i < matrices.size(); ++i) {
    const auto& [left, right, bottom, top] = windows[i];
    motion.push_back({matrices[i], left, right, bottom, top});
  }
  self.set_camera_motion(std::move(motion));
}

}  // namespace

void bind_motion(py::class_<SceneBuilder>& builder) {
  builder
      .def("set_mesh_motion", &set_mesh_motion, "key"_a, py::kw_only(), "positions"_a,
           "normals"_a = py::none(),
           "How a mesh that has been set changes its form while the shutter is open: positions "
           "float[K,N,3] at K even times, from opening to closing; normals float[K,N or C,3], of "
           "vertices or corners, whichever it has (None: it has none).")
      .def(
          "set_instance_motion",
          [](SceneBuilder& self, Key key, const py::object& transforms) {
            self.set_instance_motion(key, to_matrices(key, transforms));
          },
          "key"_a, py::kw_only(), "transforms"_a,
          "Where an instance that has been set is at K such times: float[K,4,4].")
      .def("set_camera_motion", &set_camera_motion, py::kw_only(), "transforms"_a, "windows"_a,
           "Where the camera is at K such times, float[K,4,4], and its window, float[K,4].")
      .def("set_shutter", &SceneBuilder::set_shutter, "openness"_a,
           "How open the shutter is at even times: float[N]; all times alike without.");
}

}  // namespace janus::python
