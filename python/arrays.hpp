// Numbers as NumPy arrays: views of what an object holds, or arrays that hold them.
#pragma once

#include <pybind11/numpy.h>

#include <Eigen/Core>
#include <memory>
#include <utility>
#include <vector>

namespace wilt::python {

namespace py = pybind11;

/// The Python object that holds `self`, for views of what is in it. Python may say None where pybind11
/// expects an object.
template <class T>
py::object owner_of(const std::shared_ptr<T>& self) {
  if (!self) throw py::type_error("None has no arrays");
  return py::cast(self);
}

/// The shape of a matrix (rows x columns, row by row) or vector.
template <class Derived>
std::vector<py::ssize_t> shape_of(const Eigen::PlainObjectBase<Derived>& values) {
  static_assert(Derived::IsRowMajor || Derived::IsVectorAtCompileTime, "NumPy's default order");
  if (Derived::IsVectorAtCompileTime) return {values.size()};
  return {values.rows(), values.cols()};
}

/// A read-only view; `owner`, the Python object that holds `values`, lives as long as it does.
template <class T>
py::array_t<T> view(const T* values, const std::vector<py::ssize_t>& shape, py::handle owner) {
  py::array_t<T> array(shape, values, owner);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}
template <class Derived>
auto view(const Eigen::PlainObjectBase<Derived>& values, py::handle owner) {
  return view(values.data(), shape_of(values), owner);
}

/// An array of its own that holds `values`, which are moved.
template <class Derived>
auto owned(Eigen::PlainObjectBase<Derived>&& values) {
  auto* held = new Derived(std::move(values.derived()));
  const py::capsule owner(held, [](void* matrix) { delete static_cast<Derived*>(matrix); });
  return py::array_t<typename Derived::Scalar>(shape_of(*held), held->data(), owner);
}

/// Indices, copied: an array of 32-bit integers.
template <class Id>
py::array_t<int> indices(const std::vector<Id>& ids) {
  py::array_t<int> array(static_cast<py::ssize_t>(ids.size()));
  int* to = array.mutable_data();
  for (const Id& id : ids) *to++ = static_cast<int>(id);
  return array;
}

/// One member of every row of a table as an array of double, int or bool.
template <class T, class Row>
py::array_t<T> column(const std::vector<Row>& rows, T Row::*member) {
  py::array_t<T> array(static_cast<py::ssize_t>(rows.size()));
  T* to = array.mutable_data();
  for (const Row& row : rows) *to++ = row.*member;
  return array;
}

}  // namespace wilt::python
