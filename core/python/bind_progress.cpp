// SPDX-License-Identifier: GPL-3.0-or-later
#include "bind_progress.h"

namespace janus::python {

namespace {

using namespace py::literals;

constexpr EnumName<Progress::State> kStates[] = {{"waiting", Progress::State::Waiting},
                                                 {"rendering", Progress::State::Rendering},
                                                 {"done", Progress::State::Done},
                                                 {"cancelled", Progress::State::Cancelled},
                                                 {"failed", Progress::State::Failed}};

}  // namespace

py::dict to_dict(const Progress& p) {
  py::dict d;
  d["samples"] = p.samples;
  d["target_samples"] = p.target_samples;
  d["seconds"] = p.seconds;
  d["remaining"] = p.remaining;
  d["state"] = to_name(kStates, p.state);
  return d;
}

py::dict to_dict(const Statistics& s) {
  const Counters& c = s.counters;
  py::dict d;
  d["samples"] = s.samples;
  d["seconds"] = s.seconds;
  d["paths"] = py::dict("camera"_a = c.camera_paths, "light"_a = c.light_paths);
  d["rays"] =
      py::dict("camera"_a = c.camera_rays, "specular"_a = c.specular_rays, "light"_a = c.light_rays,
               "nee"_a = c.nee_rays, "connection"_a = c.connection_rays, "splat"_a = c.splat_rays);
  // How far connections and other joins came before they were given up, in this order.
  d["joins"] =
      py::dict("connections"_a = c.connections, "connections_facing"_a = c.connections_facing,
               "connections_evaluated"_a = c.connections_evaluated, "nee"_a = c.nee_samples,
               "splats"_a = c.splats, "merges"_a = c.merges);
  d["light_vertices"] = c.light_vertices;
  d["light_cache_bytes"] = s.cache_bytes;
  d["dropped"] = c.dropped;
  d["effort"] =
      py::dict("light_paths"_a = s.effort.light_paths, "connections"_a = s.effort.connections);
  d["weight_error"] = s.weight_error;
  return d;
}

py::array_t<float> to_array(std::unique_ptr<Image> image) {
  const py::ssize_t shape[] = {image->height, image->width, image->channels};
  const float* pixels = image->pixels.data();
  const py::capsule owner(image.release(), [](void* p) { delete static_cast<Image*>(p); });
  return py::array_t<float>(shape, pixels, owner);
}

}  // namespace janus::python
