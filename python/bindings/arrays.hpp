// SPDX-License-Identifier: BSD-3-Clause
/// @file  Numbers of the library as numpy's arrays.
#pragma once
#include <pybind11/numpy.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "rondo/core/vec2.hpp"
#include "rondo/mesh/mesh.hpp"
#include "rondo/output/run_files.hpp"

namespace rondo::python {

namespace py = pybind11;

/// An array that owns what was moved into it.
template <class T>
py::array_t<T> owned(std::vector<T> numbers, std::vector<py::ssize_t> shape) {
  auto kept = std::make_unique<std::vector<T>>(std::move(numbers));
  const T* data = kept->data();
  const py::capsule base(kept.release(), [](void* p) { delete static_cast<std::vector<T>*>(p); });
  return py::array_t<T>(std::move(shape), data, base);
}

template <class T>
py::array_t<T> owned(std::vector<T> numbers) {
  const auto size = static_cast<py::ssize_t>(numbers.size());
  return owned(std::move(numbers), {size});
}

/// A view that may be read alone, and keeps what it looks at.
template <class Owner>
py::array_t<double> view(std::shared_ptr<Owner> owner, const double* data,
                         std::vector<py::ssize_t> shape) {
  auto kept = std::make_unique<std::shared_ptr<Owner>>(std::move(owner));
  const py::capsule base(kept.release(),
                         [](void* p) { delete static_cast<std::shared_ptr<Owner>*>(p); });
  py::array_t<double> array(std::move(shape), data, base);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

/// As rondo.Mesh has them (docs/python.md): coordinates, cells, boundary, ...
py::dict mesh_arrays(const mesh::Mesh& mesh, const std::vector<double>& mass,
                     const std::vector<int>& free_body);

/// As text, numbers that are not finite as null.
std::string text_of(const study::Json& json);

}  // namespace rondo::python
