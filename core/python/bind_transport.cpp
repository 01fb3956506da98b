// SPDX-License-Identifier: GPL-3.0-or-later
#include "bind_progress.h"
#include "janus/session/transport.h"

namespace janus::python {

namespace {

using namespace py::literals;

bool wait(TransportSession& self, double seconds) {
  return wait_slices([&](double slice) { return self.wait(slice); }, seconds);
}

void finish(TransportSession& self) {
  if (self.progress().state == Progress::State::Waiting) {
    return;
  }
  while (!wait(self, 1.0)) {
  }
  self.finish();
}

// An array of [values.size() / row, row] or with `shape`, which owns the values.
template <class T, class Value>
py::array_t<T> own(std::vector<Value> values, std::vector<py::ssize_t> shape) {
  auto* kept = new std::vector<Value>(std::move(values));
  const py::capsule owner(kept, [](void* p) { delete static_cast<std::vector<Value>*>(p); });
  return py::array_t<T>(std::move(shape), reinterpret_cast<const T*>(kept->data()), owner);
}

py::dict matrix(const TransportSession& self) {
  TransportMatrix m;
  {
    const py::gil_scoped_release release;
    m = self.matrix();
  }
  const auto count = static_cast<py::ssize_t>(m.values.size());
  const auto blocks = static_cast<py::ssize_t>(m.blocks.size());
  const ProjectorDesc& projector = self.projector();
  const auto squares = [&](int side) -> py::ssize_t {
    return (side + m.shares_size - 1) / m.shares_size;
  };
  const py::ssize_t rows = squares(projector.height), columns = squares(projector.width);
  const py::ssize_t tiles = static_cast<py::ssize_t>(m.shares.size()) / (rows * columns);
  py::dict d;
  d["samples"] = m.samples;
  d["tile_size"] = CameraTiles::kSide;
  d["shares_size"] = m.shares_size;
  d["blocks"] = own<uint32_t>(std::move(m.blocks), {blocks, 4});
  d["entry_pixel"] = own<uint32_t>(std::move(m.pixels), {count});
  d["entry_block"] = own<uint32_t>(std::move(m.entry_blocks), {count});
  d["entry_value"] = own<float>(std::move(m.values), {count, 3});
  d["entry_variance"] = own<float>(std::move(m.variances), {count, 3});
  d["share_value"] = own<float>(std::move(m.shares), {tiles, rows, columns, 3});
  d["share_variance"] = own<float>(std::move(m.share_variances), {tiles, rows, columns, 3});
  return d;
}

py::list rows_of(const mat4& m) {
  py::list rows;
  for (int i = 0; i < 4; ++i) {
    rows.append(py::make_tuple(m[0][i], m[1][i], m[2][i], m[3][i]));
  }
  return rows;
}

py::dict projector(const TransportSession& self) {
  const ProjectorDesc& p = self.projector();
  mat4 transform(p.rotation);
  transform[3] = vec4(p.center, 1.0f);
  const std::vector<py::ssize_t> shape{p.height, p.width, 3};
  py::dict d;
  d["name"] = p.lamp.name;
  d["type"] = p.parallel ? "ORTHO" : "PERSP";
  d["transform"] = rows_of(transform);
  d["window"] = py::make_tuple(p.low.x, p.high.x, p.low.y, p.high.y);
  d["own_watts"] = own<float>(self.watts().own, shape);
  d["plain_watts"] = own<float>(self.watts().plain, shape);
  return d;
}

py::dict camera(const TransportSession& self) {
  const CameraDesc& c = self.camera();
  py::dict d;
  d["name"] = c.name;
  d["transform"] = rows_of(c.transform);
  d["window"] = py::make_tuple(c.left, c.right, c.bottom, c.top);
  return d;
}

}  // namespace

void bind_transport(py::module_& m) {
  const TransportSettings d;
  py::class_<TransportSession>(
      m, "TransportSession", py::release_gil_before_calling_cpp_dtor(),
      "Captures the light transport matrix between a projector, the spot or area light of that "
      "name, and the camera. janus_core.dual has what works with it. On threads of its own, as "
      "RenderSession; dropping it cancels it.")
      .def(py::init([](const std::shared_ptr<Scene>& scene, const RenderSettings& settings,
                       const std::string& name, int width, int height, size_t memory) {
             return std::make_unique<TransportSession>(
                 scene, settings, TransportSettings{name, width, height, memory});
           }),
           "scene"_a.none(false), "settings"_a, py::kw_only(), "projector"_a,
           "projector_width"_a = d.width, "projector_height"_a = d.height, "memory"_a = d.memory)
      .def("start", &TransportSession::start, "Starts the capture and returns. Once only.")
      .def("wait", &wait, "seconds"_a,
           "Waits up to `seconds` for the end, without the GIL; True if the capture has ended.")
      .def(
          "progress", [](const TransportSession& s) { return to_dict(s.progress()); },
          "As RenderSession.progress(), with the first passes, which choose the blocks.")
      .def(
          "stats", [](const TransportSession& s) { return to_dict(s.statistics()); },
          "As RenderSession.stats(), of the passes of which the matrix is made.")
      .def("cancel", &TransportSession::cancel,
           "Asks the capture to stop and returns. Whole passes are kept.")
      .def("finish", &finish, "Waits for the end and raises what went wrong, if anything.")
      .def(
          "snapshot",
          [](const TransportSession& s) { return to_array([&] { return s.snapshot(); }); },
          "The camera's picture while each pixel of the projector shines with one watt: float32 "
          "[height, width, 4], bottom row first.")
      .def("matrix", &matrix,
           "After the end: the arrays of a TransportMatrix (see janus_core.dual), as a dict. A new "
           "copy each time.")
      .def_property_readonly(
          "projector", &projector,
          "name, type, transform (4x4), window (left, right, bottom, top), and the watts that the "
          "lamp emits into each pixel: own_watts, with its node tree, and plain_watts without.")
      .def_property_readonly("camera", &camera, "name, transform, window.");
}

}  // namespace janus::python
