// SPDX-License-Identifier: BSD-3-Clause
/// @file  The mesh record: plain arrays that do not change during a run.
#pragma once
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "rondo/core/vec2.hpp"

namespace rondo::mesh {

/// Corner nodes, counter-clockwise; the last entry of a triangle is -1.
using Cell = std::array<int, 4>;

inline int n_corners(const Cell& cell) noexcept {
  return cell[3] < 0 ? 3 : 4;
}

/// Two nodes. The body is on the left when going from the first to the second; the outward normal
/// points to the right.
using Edge = std::array<int, 2>;

/// Corner nodes of a hexahedron: a face, counter-clockwise as seen from inside, then the opposite
/// face, corner by corner (the order of VTK).
using Hexahedron = std::array<int, 8>;

/// Four nodes, counter-clockwise as seen from outside.
using Face = std::array<int, 4>;

/// A named part of the surface of a wheel ("rim", "tread", or a physical curve of its section).
struct Surface {
  std::string name;
  std::vector<Face> faces;
};

/// A named part of the boundary (a physical curve of a file, or "rim" and "tread" of a disk).
struct Curve {
  std::string name;
  std::vector<Edge> edges;
};

struct Mesh {
  std::vector<Vec2> coordinates;  ///< (n) reference position X                                 [m]
  std::vector<Cell> cells;        ///< (e) corner nodes
  std::vector<int> clamped;       ///< nodes fixed in the rotating frame (u = 0), ascending
  std::vector<int> boundary;      ///< (nb) contact candidates, in order along the contact boundary
  std::vector<double>
      tributary;  ///< (nb) length of contact boundary that belongs to a candidate      [m]
  std::vector<Edge> contact_edges;  ///< edges between candidates, in order along the boundary
  std::vector<int> region;          ///< (e) index of a cell's surface in region_names; empty: one
  std::vector<std::string> region_names;  ///< physical surfaces of a file
  std::vector<Curve> curves;              ///< physical curves of a file
  int n_sectors = 0;                      ///< equal sectors of a cyclic mesh; 0: not cyclic
  std::vector<int>
      sector;  ///< (n) sector of a node, counter-clockwise from -90°; empty: not cyclic
  std::vector<int> sector_node;  ///< (n) number of a node within its sector; empty: not cyclic
  // The fields below belong to a wheel in three dimensions, which has no cells, contact_edges or
  // curves; its tributaries are areas [m²].
  std::vector<double> axial;          ///< (n) z of X, along the axle; empty: the body is plane [m]
  std::vector<Hexahedron> hexahedra;  ///< (e) corner nodes
  std::vector<Surface> surfaces;

  [[nodiscard]] std::size_t n_nodes() const noexcept { return coordinates.size(); }
  [[nodiscard]] bool is_solid() const noexcept { return !axial.empty(); }
  [[nodiscard]] std::size_t n_elements() const noexcept { return cells.size() + hexahedra.size(); }
};

/// (n) 1 at clamped nodes.
std::vector<char> clamped_flags(const Mesh& mesh);

/// The connected parts of a mesh: the number of each node's body, in the order of the first nodes.
struct Bodies {
  int count = 0;
  std::vector<int> of_node;  ///< (n) -1: the node belongs to no cell
};
Bodies find_bodies(const Mesh& mesh);

/// The mesh of some of its cells, with all nodes kept. @param kept (e) 1: the cell is kept
Mesh mesh_of_cells(const Mesh& mesh, std::span<const char> kept);

}  // namespace rondo::mesh
