// What each file of the module adds to it, and what they share.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "wilt/simulation/config.hpp"

namespace wilt::python {

namespace py = pybind11;

void bind_species(py::module_& m);
void bind_leaf(py::module_& m);
void bind_veins(py::module_& m);
void bind_frames(py::module_& m);
void bind_result(py::module_& m);
void bind_simulation(py::module_& m);
void bind_plan(py::module_& m);
void bind_reproduce(py::module_& m);

/// Keyword arguments as settings: water__humidity=0.3 is water.humidity = 0.3; so is **{"water.humidity":
/// 0.3}.
std::vector<Assignment> assignments_of(const py::dict& keywords, const std::string& prefix = "");

/// JSON text as Python's dictionaries, lists and numbers.
py::object from_json(const std::string& text);

/// A docstring: what a function does, then what each of its arguments means.
std::string with_arguments(const char* text,
                           std::initializer_list<std::pair<const char*, const char*>> arguments);

}  // namespace wilt::python
