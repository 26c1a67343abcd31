// SPDX-License-Identifier: BSD-3-Clause
#include "arrays.hpp"

#include <pybind11/stl.h>

#include <algorithm>

namespace rondo::python {
namespace {

using Index = py::ssize_t;

Index size_of(std::size_t n) {
  return static_cast<Index>(n);
}

/// (n, 2), or (n, 3) of a wheel.
py::array_t<double> coordinates(const mesh::Mesh& m) {
  std::vector<double> x;
  for (std::size_t i = 0; i < m.n_nodes(); ++i) {
    x.insert(x.end(), {m.coordinates[i].x, m.coordinates[i].y});
    if (m.is_solid()) x.push_back(m.axial[i]);
  }
  return owned(std::move(x), {size_of(m.n_nodes()), m.is_solid() ? 3 : 2});
}

/// (e, 4), -1 where a triangle has no fourth corner; (e, 3) where all are triangles; (e, 8).
py::array_t<int> cells(const mesh::Mesh& m) {
  std::vector<int> corners;
  for (const mesh::Hexahedron& h : m.hexahedra) corners.insert(corners.end(), h.begin(), h.end());
  if (m.is_solid()) return owned(std::move(corners), {size_of(m.hexahedra.size()), 8});
  const bool triangles = std::all_of(m.cells.begin(), m.cells.end(), [](const mesh::Cell& cell) {
    return mesh::n_corners(cell) == 3;
  });
  const int width = triangles ? 3 : 4;
  for (const mesh::Cell& cell : m.cells)
    corners.insert(corners.end(), cell.begin(), cell.begin() + width);
  return owned(std::move(corners), {size_of(m.cells.size()), width});
}

py::object optional(const std::vector<int>& numbers) {
  return numbers.empty() ? py::object(py::none()) : py::object(owned(numbers));
}

}  // namespace

py::dict mesh_arrays(const mesh::Mesh& m, const std::vector<double>& mass,
                     const std::vector<int>& free_body) {
  py::dict mesh;
  mesh["coordinates"] = coordinates(m);
  mesh["cells"] = cells(m);
  mesh["boundary"] = owned(m.boundary);
  mesh["tributary"] = owned(m.tributary);
  mesh["mass"] = owned(mass);
  mesh["sector"] = optional(m.sector);
  mesh["sector_node"] = optional(m.sector_node);
  mesh["free_body"] = optional(free_body);
  mesh["region"] = m.region_names.empty() ? py::object(py::none()) : optional(m.region);
  mesh["region_names"] = py::tuple(py::cast(m.region_names));
  return mesh;
}

std::string text_of(const study::Json& json) {
  return json.dump(-1, ' ', false, study::Json::error_handler_t::replace);
}

}  // namespace rondo::python
