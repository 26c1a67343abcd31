// SPDX-License-Identifier: BSD-3-Clause
/// @file  Implicit elements in the explicit step (docs/theory.md, 3.9), chosen by hand.
#pragma once
#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "support/models.hpp"

namespace rondo::test {

/// The mesh of some of its cells. @param cells (e) 1: kept
inline mesh::Mesh part_of(const mesh::Mesh& mesh, const std::vector<char>& cells) {
  mesh::Mesh part = mesh;
  part.cells.clear();
  part.region.clear();
  for (std::size_t e = 0; e < cells.size(); ++e) {
    if (!cells[e]) continue;
    part.cells.push_back(mesh.cells[e]);
    if (!mesh.region.empty()) part.region.push_back(mesh.region[e]);
  }
  return part;
}

/// (e) 1 in the given layers of a generated disk; layer 1 is at the rim.
inline std::vector<char> cells_of_layers(const mesh::Mesh& mesh, const std::vector<int>& layers) {
  std::vector<double> radius;  // of the innermost corner
  for (const mesh::Cell& cell : mesh.cells) {
    double least = std::numeric_limits<double>::infinity();
    for (const int node : cell)
      least = std::min(least, norm(mesh.coordinates[static_cast<std::size_t>(node)]));
    radius.push_back(least);
  }
  std::vector<double> radii = radius;
  std::sort(radii.begin(), radii.end());
  radii.erase(
      std::unique(radii.begin(), radii.end(), [](double a, double b) { return b - a < 1e-9; }),
      radii.end());
  std::vector<char> chosen;
  for (const double r : radius) {
    const auto at = std::lower_bound(radii.begin(), radii.end(), r - 1e-9) - radii.begin();
    chosen.push_back(std::ranges::find(layers, static_cast<int>(at) + 1) != layers.end() ? 1 : 0);
  }
  return chosen;
}

/// Gives some elements another material. @param cells (e) 1: they have it
inline void set_region(Built& b, const DiskCase& c, const std::vector<char>& cells,
                       const fem::Material& material) {
  b.materials = {c.material, material};
  b.mesh.region.assign(cells.begin(), cells.end());
  b.model.mass = fem::lumped_mass(b.mesh, b.materials);
  set_stiffness(b, c);
}

/// K_I of these cells and their free nodes. @param cells (e) 1: implicit
inline dynamics::ImplicitPart implicit_part(const mesh::Mesh& mesh,
                                            std::span<const fem::Material> materials,
                                            const std::vector<char>& cells,
                                            std::span<const Vec2> prestress = {}) {
  const mesh::Mesh part = part_of(mesh, cells);
  std::vector<char> is_of(mesh.n_nodes(), 0);
  for (const mesh::Cell& cell : part.cells)
    for (int a = 0; a < mesh::n_corners(cell); ++a)
      is_of[static_cast<std::size_t>(cell[static_cast<std::size_t>(a)])] = 1;
  dynamics::ImplicitPart implicit{fem::assemble_stiffness(part, materials, prestress), {}};
  for (const int node : fem::free_nodes(mesh))
    if (is_of[static_cast<std::size_t>(node)]) implicit.nodes.push_back(node);
  return implicit;
}

/// Critical step of the explicit elements with the whole mass.
inline dynamics::CriticalStep explicit_step(const dynamics::Model& model, const mesh::Mesh& mesh,
                                            std::span<const fem::Material> materials,
                                            std::vector<char> cells, double beta) {
  for (char& chosen : cells) chosen = !chosen;
  const mesh::Mesh part = part_of(mesh, cells);
  return dynamics::critical_step(fem::assemble_stiffness(part, materials), model.mass, model.free,
                                 {beta, 0.0}, fem::element_eigenvalue_bound(part, materials));
}

/// Makes cells implicit; the step is c.safety times the critical step of the others.
inline void set_implicit(Built& b, const DiskCase& c, const std::vector<char>& cells) {
  b.model.implicit = implicit_part(b.mesh, b.materials, cells, b.prestress);
  b.critical = explicit_step(b.model, b.mesh, b.materials, cells, c.beta);
  b.model.dt = c.safety * b.critical.step;
}

}  // namespace rondo::test
