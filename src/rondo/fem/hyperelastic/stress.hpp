// SPDX-License-Identifier: BSD-3-Clause
/// @file  Cauchy stress of cells of rubber (docs/rubber.md, 1.6) by the law without viscous
/// branches: J⁻¹ P Fᵀ of the isochoric energy at the points of the element, and the mean pressure
/// of its volume (for a triangle, that at its nodes).
#pragma once
#include <array>

#include "rondo/core/index.hpp"
#include "rondo/fem/hyperelastic/element.hpp"
#include "rondo/fem/nodal_dilatation.hpp"
#include "rondo/mesh/mesh.hpp"

namespace rondo::fem::hyperelastic {

/// Stress at the corners in the axes of u. With 2×2 points it is extrapolated bilinearly; with one
/// point, and in a triangle except for its pressures, it is constant. NaN if the cell is inverted.
/// @param pressure U' at a triangle's nodes; not used for a quadrilateral [Pa]
[[nodiscard]] std::array<Stress, 4> corner_stress(const Rubber& rubber, const DeformedCell& cell,
                                                  const std::array<double, 4>& pressure) noexcept;

/// U' of a volume [Pa]; NaN if the volume is not positive. @param j_less_1 J - 1
[[nodiscard]] double pressure_of(const Rubber& rubber, double j_less_1) noexcept;

/// @param u displacement of a node [m]
template <class Displacement>
DeformedCell deformed_cell(const mesh::Mesh& mesh, std::size_t cell, Displacement&& u) {
  DeformedCell deformed;
  const mesh::Cell& nodes = mesh.cells[cell];
  deformed.n_corners = mesh::n_corners(nodes);
  for (std::size_t a = 0; a < static_cast<std::size_t>(deformed.n_corners); ++a) {
    deformed.x[a] = mesh.coordinates[at(nodes[a])];
    deformed.u[a] = u(nodes[a]);
  }
  return deformed;
}

/// Corner stress of a cell of a mesh; a triangle's volume is that of the triangles at its nodes.
template <class Displacement>
std::array<Stress, 4> cell_stress(const mesh::Mesh& mesh, std::size_t cell, const Rubber& rubber,
                                  const NodalDilatation& dilatation, Displacement&& u) {
  std::array<double, 4> pressure{};
  for (std::size_t a = 0; dilatation.holds(cell) && a < 3; ++a) {
    const auto patch = static_cast<std::size_t>(dilatation.patches_of(cell)[a]);
    double change = 0.0;
    for (const int e : dilatation.cells(patch)) {
      const Center center = center_of(deformed_cell(mesh, static_cast<std::size_t>(e), u));
      change += center.area * center.j_less_1 / 3.0;
    }
    pressure[a] = pressure_of(rubber, change / dilatation.area(patch));
  }
  return corner_stress(rubber, deformed_cell(mesh, cell, u), pressure);
}

}  // namespace rondo::fem::hyperelastic
