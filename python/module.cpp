// The extension wilt._core; python/wilt/__init__.py is what users import.
#include "bindings.hpp"
#include "errors.hpp"

PYBIND11_MODULE(_core, m) {
  m.doc() = "Leaves that wither.";
  wilt::python::translate_errors();
  wilt::python::bind_species(m);
  wilt::python::bind_leaf(m);
  wilt::python::bind_veins(m);
  wilt::python::bind_frames(m);
  wilt::python::bind_result(m);
  wilt::python::bind_simulation(m);
  wilt::python::bind_reproduce(m);
  wilt::python::bind_plan(m);
}
