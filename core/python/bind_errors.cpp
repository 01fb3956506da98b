// SPDX-License-Identifier: GPL-3.0-or-later
#include <new>
#include <stdexcept>
#include <system_error>

#include "bind.h"
#include "janus/util/error.h"

namespace janus::python {

void bind_errors(py::module_& m) {
  // Immortal, as is everything that a translator needs.
  static const py::handle error =
      py::exception<Error>(m, "Error").release();  // NOLINT: never destroyed
  static const py::handle scene_error = py::exception<SceneError>(m, "SceneError", error).release();
  static const py::handle io_error = py::exception<IoError>(m, "IoError", error).release();
  static const py::handle cancelled = py::exception<Cancelled>(m, "Cancelled", error).release();
  error.attr("__doc__") = "Base of what the core raises on purpose.";
  scene_error.attr("__doc__") =
      "A description or a setting that cannot be rendered. key: the item given to SceneBuilder, "
      "or 'settings'; path: the offending part of it; message: what is wrong.";
  io_error.attr("__doc__") = "A file that cannot be read or written; the message names it.";
  cancelled.attr("__doc__") = "The work was cancelled.";

  py::register_local_exception_translator([](std::exception_ptr thrown) {
    try {
      std::rethrow_exception(thrown);
    } catch (const SceneError& e) {
      // As what(), which ends at the first 0 of a name.
      const std::string where = e.key + (e.path.empty() ? "" : " (" + e.path + ")");
      const py::object instance =
          py::reinterpret_borrow<py::object>(scene_error)(where + ": " + e.message);
      instance.attr("key") = e.key;
      instance.attr("path") = e.path;
      instance.attr("message") = e.message;
      PyErr_SetObject(scene_error.ptr(), instance.ptr());
    } catch (const IoError& e) {
      PyErr_SetString(io_error.ptr(), e.what());
    } catch (const Cancelled& e) {
      PyErr_SetString(cancelled.ptr(), e.what());
    } catch (const Error& e) {
      PyErr_SetString(error.ptr(), e.what());
    } catch (const std::bad_alloc&) {
      PyErr_SetString(PyExc_MemoryError,
                      "the machine has not enough memory for this: render a simpler scene, fewer "
                      "passes or less resolution");
    } catch (const std::length_error&) {  // of a vector: more than any machine has
      PyErr_SetString(PyExc_MemoryError, "no machine has enough memory for this");
    } catch (const std::system_error& e) {
      PyErr_SetString(error.ptr(),
                      (std::string("no thread could be started: ") + e.what()).c_str());
    }
  });
}

}  // namespace janus::python
