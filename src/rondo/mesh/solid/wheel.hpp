// SPDX-License-Identifier: BSD-3-Clause
/// @file  Wheels in three dimensions: a section in (r, z), revolved about the axle into equal
/// sectors of hexahedra (docs/wheel3d.md).
#pragma once
#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "rondo/core/vec3.hpp"
#include "rondo/mesh/disk.hpp"
#include "rondo/mesh/mesh.hpp"

namespace rondo::mesh {

/// A generated wheel: a disk (disk.hpp) with a width.
struct Wheel {
  Disk disk;                           ///< radii, layers, columns; outer radius of the middle
  double width = 0.0;                  ///< along the axle, z from -width/2 to width/2 [m], > 0
  int axial = 4;                       ///< elements over the width, >= 1
  std::optional<double> crown_radius;  ///< of the tread's section [m], >= width/2; absent: flat
  /// Grooves around the wheel, as deep as the tread: z of the middle and width of each [m]. They
  /// need disk.tread; if its groove_columns = 0, the wheel has no other grooves.
  std::vector<std::array<double, 2>> grooves;
};

/// The smallest number of elements over the width that resolves the edges of the grooves.
int least_axial(const Wheel& wheel);

/// z of the lines of nodes across the section, ascending: the side faces, the edges of the grooves
/// and, evenly spaced between these, the other lines [m]. @pre axial >= least_axial
std::vector<double> axial_lines(const Wheel& wheel);

/// Number of nodes that make_wheel would make, computed without making them. With grooves around
/// the wheel it is an upper bound.
std::size_t n_wheel_nodes(const Wheel& wheel) noexcept;

/// The cells of a sector: columns of the section, one after the other around the wheel.
struct Columns {
  int n_sectors = 0;  ///< >= 3
  int columns = 1;    ///< columns of elements in a sector, all of the same angle, >= 1
  /// (columns, cells of the section) 1: the cell exists; empty: all cells exist.
  std::vector<char> kept{};
};

/// The section as a plane mesh, where x is r and y is z, with counter-clockwise cells. Its curves:
/// "rim" is clamped, "tread" is the top, "left" and "right" are the sides at the least and the
/// largest z, "layer-K" the line between its layers K and K + 1, counted from 1 at the rim, in the
/// sense of growing z. It has no candidates. Nodes are numbered layer after layer outwards.
Mesh make_section(const Wheel& wheel);

/// The columns of a generated wheel; the cells left out are those of its tread and its grooves.
Columns columns_of(const Wheel& wheel, const Mesh& section);

/// Sector 0 begins at -90°, straight down. Nodes and hexahedra are numbered sector after sector, in
/// the same order in each. Nodes of no cell are left out. Clamped nodes are those made from clamped
/// nodes of the section. Each curve of its boundary becomes a surface, without the faces whose cell
/// a groove removed. Candidates are the nodes of the surface `contact` that are not clamped,
/// ascending; their tributaries are ∫ N dA over all its faces, also those at clamped nodes.
/// @param contact name of a curve of the section
/// @pre r > 0 in the section, which has no triangles.
Mesh revolve(const Mesh& section, const Columns& columns, std::string_view contact);

/// Moves the nodes and finds the tributaries again. @param by (n) [m]
/// @param contact surface of the candidates
void move_nodes(Mesh& mesh, std::span<const Vec3> by, std::string_view contact);

/// Edges around the wheel between candidates, each once, with the axle on the left of the edge.
/// @param contact surface of the candidates. @pre the mesh was made by revolve()
std::vector<Edge> rolling_edges(const Mesh& mesh, std::string_view contact);

inline Mesh make_wheel(const Wheel& wheel) {
  const Mesh section = make_section(wheel);
  return revolve(section, columns_of(wheel, section), "tread");
}

}  // namespace rondo::mesh
