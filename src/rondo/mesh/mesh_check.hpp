// SPDX-License-Identifier: BSD-3-Clause
/// @file  Checks of the cells and nodes of a mesh that the user made. No check changes the mesh;
/// the time of each is proportional to the size of the mesh.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "rondo/mesh/edges.hpp"
#include "rondo/mesh/mesh.hpp"

namespace rondo::mesh {

/// Shape of a cell by the corner Jacobians det(∂x/∂ξ) of the bilinear map, at which the lumped mass
/// (docs/theory.md, (2.5)) is integrated: all must be positive.
enum class CellShape {
  good,
  repeated,   ///< one node at two corners
  flat,       ///< no area
  clockwise,  ///< negative area
  concave     ///< positive area, but a corner of 180 degrees or more, or two edges that cross
};
CellShape cell_shape(const Mesh& mesh, const Cell& cell);

/// The cells of each bad shape, ascending.
struct BadCells {
  std::vector<int> repeated, flat, clockwise, concave;
  [[nodiscard]] std::size_t count() const noexcept {
    return repeated.size() + flat.size() + clockwise.size() + concave.size();
  }
};
BadCells check_cells(const Mesh& mesh);

/// The cell in the opposite sense, with the same first corner.
Cell reversed(const Cell& cell);

/// Pairs of cells (later, earlier) with the same corners in any order.
std::vector<std::array<int, 2>> duplicate_cells(const Mesh& mesh);

/// An edge shared by three or more cells, or with two cells on the same side of it: the mesh is
/// folded or overlaps there. @pre no bad cell
struct BadEdge {
  Edge nodes{};
  std::vector<int> cells;
};
std::vector<BadEdge> crowded_edges(const EdgeTable& table);

/// Pairs of nodes (later, earlier) closer to each other than about 2·10⁻⁹ of the size of the mesh.
/// Every node that coincides with an earlier one is in exactly one pair. @pre finite coordinates
std::vector<std::array<int, 2>> coincident_nodes(const Mesh& mesh);

}  // namespace rondo::mesh
