#include "errors.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl/filesystem.h>

#include <exception>

#include "wilt/core/error.hpp"

namespace wilt::python {
namespace {

namespace py = pybind11;

PyObject* python_error(ErrorCode code) {
  switch (code) {
    case ErrorCode::output:
      return PyExc_OSError;
    case ErrorCode::simulation:
      return PyExc_RuntimeError;
    case ErrorCode::interrupted:
      return PyExc_KeyboardInterrupt;
    default:
      return PyExc_ValueError;
  }
}

}  // namespace

void translate_errors() {
  py::register_local_exception_translator([](std::exception_ptr thrown) {
    try {
      std::rethrow_exception(thrown);
    } catch (const Error& error) {
      PyErr_SetString(python_error(error.code()), error.what());
    }
  });
}

std::filesystem::path path_of(py::handle path) {
  const auto text = py::reinterpret_steal<py::object>(PyOS_FSPath(path.ptr()));
  if (!text) throw py::error_already_set();
  return text.cast<std::filesystem::path>();
}

void reading(const std::filesystem::path& file, const std::function<void()>& read) {
  try {
    read();
  } catch (const Error& error) {
    std::error_code unknown;
    if (error.code() != ErrorCode::input || std::filesystem::exists(file, unknown)) throw;
    PyErr_SetString(PyExc_FileNotFoundError, error.what());
    throw py::error_already_set();
  }
}

}  // namespace wilt::python
