// SPDX-License-Identifier: BSD-3-Clause
#include "matrices.hpp"

#include <pybind11/stl.h>

namespace rondo::python {
namespace {

py::tuple csr_arrays(const study::Csr& m) {
  const auto entries = static_cast<std::ptrdiff_t>(m.nonZeros());
  const std::ptrdiff_t rows = m.rows();
  return py::make_tuple(owned(std::vector<double>(m.valuePtr(), m.valuePtr() + entries)),
                        owned(std::vector<int>(m.innerIndexPtr(), m.innerIndexPtr() + entries)),
                        owned(std::vector<int>(m.outerIndexPtr(), m.outerIndexPtr() + rows + 1)),
                        py::make_tuple(m.rows(), m.cols()));
}

py::array_t<double> vectors(std::vector<double> numbers, std::size_t components) {
  const auto width = static_cast<py::ssize_t>(components);
  const auto n = static_cast<py::ssize_t>(numbers.size()) / width;
  return owned(std::move(numbers), {n, width});
}

}  // namespace

py::dict operator_arrays(const study::Operators& o, const study::Setup& setup) {
  py::dict all;
  all["mass"] = csr_arrays(o.mass);
  all["damping"] = csr_arrays(o.damping);
  all["stiffness"] = csr_arrays(o.stiffness);
  all["gyroscopic"] = csr_arrays(o.gyroscopic);
  all["centrifugal"] = csr_arrays(o.centrifugal);
  all["nodes"] = owned(o.nodes);
  all["clamped"] = owned(setup.mesh.clamped);
  all["reference"] = vectors(o.reference, o.components);
  all["contact_nodes"] =
      owned(setup.model.contact ? setup.model.contact->nodes : std::vector<int>());
  return all;
}

py::dict contact_arrays(const study::ContactRows& contact, std::size_t components) {
  py::dict all;
  all["rows"] = csr_arrays(contact.rows);
  all["normal"] = vectors(contact.normal, components);
  all["normal_corotating"] = vectors(contact.normal_corotating, components);
  all["gap"] = owned(contact.gap);
  return all;
}

py::tuple frame_arrays(const study::FramePlace& frame, std::size_t components) {
  std::vector<double> center{frame.center.x, frame.center.y};
  if (components == 3) center.push_back(frame.center.z);
  return py::make_tuple(frame.angle, owned(std::move(center)));
}

Vec3 center_of(const std::vector<double>& center) {
  return {center.at(0), center.at(1), center.size() > 2 ? center[2] : 0.0};
}

}  // namespace rondo::python
