// SPDX-License-Identifier: BSD-3-Clause
/// @file  What can be wrong with the cells and nodes of a mesh that the user made. No check changes
/// the mesh; each takes time in proportion to it.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "rondo/mesh/edges.hpp"
#include "rondo/mesh/mesh.hpp"

namespace rondo::mesh {

/// Shape of a cell by the corner Jacobians det(∂x/∂ξ) of the bilinear map, which the lumped mass
/// (docs/theory.md, (2.5)) takes at the corners: all have to be positive.
enum class CellShape {
  good,
  repeated,   ///< one node at two corners
  flat,       ///< no area
  clockwise,  ///< negative area
  concave     ///< positive area, but a corner of 180 degrees or more, or two edges that cross
};
CellShape cell_shape(const Mesh& mesh, const Cell& cell);

/// Cells of each kind that is not good, ascending.
struct BadCells {
  std::vector<int> repeated, flat, clockwise, concave;
  [[nodiscard]] std::size_t count() const noexcept {
    return repeated.size() + flat.size() + clockwise.size() + concave.size();
  }
};
BadCells check_cells(const Mesh& mesh);

/// The other sense, the same first corner.
Cell reversed(const Cell& cell);

/// Pairs of cells (later, earlier) with the same corners, whatever their order.
std::vector<std::array<int, 2>> duplicate_cells(const Mesh& mesh);

/// Cells that share an edge with two others or more, or lie on the same side of it as another: the
/// mesh is folded or overlaps there. @pre no bad cell
struct BadEdge {
  Edge nodes{};
  std::vector<int> cells;
};
std::vector<BadEdge> crowded_edges(const EdgeTable& table);

/// Pairs of nodes (later, earlier) nearer to each other than about 2·10⁻⁹ of the size of the mesh;
/// every node that has one before it stands in one pair. @pre finite coordinates
std::vector<std::array<int, 2>> coincident_nodes(const Mesh& mesh);

}  // namespace rondo::mesh
