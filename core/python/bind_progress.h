// SPDX-License-Identifier: GPL-3.0-or-later
//
// What sessions of every kind report, as Python sees it.
#pragma once

#include <memory>

#include "bind.h"
#include "janus/session/session.h"

namespace janus::python {

py::dict to_dict(const Progress& progress);
py::dict to_dict(const Statistics& statistics);

// float32[height, width, channels], which owns the pixels.
py::array_t<float> to_array(std::unique_ptr<Image> image);

// Of what `snapshot` returns, without the GIL.
template <class Snapshot>
py::array_t<float> to_array(Snapshot&& snapshot) {
  std::unique_ptr<Image> image;
  {
    const py::gil_scoped_release release;
    image = std::make_unique<Image>(snapshot());
  }
  return to_array(std::move(image));
}

}  // namespace janus::python
