// SPDX-License-Identifier: BSD-3-Clause
/// @file  Wheels in three dimensions: a section in (r, z), revolved about the axle into equal
/// sectors of hexahedra (docs/wheel3d.md).
#pragma once
#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "rondo/mesh/disk.hpp"
#include "rondo/mesh/mesh.hpp"

namespace rondo::mesh {

/// A generated wheel: a disk (disk.hpp) with a width.
struct Wheel {
  Disk disk;                           ///< radii, layers, columns; outer radius: in the middle
  double width = 0.0;                  ///< along the axle, from -width/2 to width/2 [m], > 0
  int axial = 4;                       ///< elements over the width, >= 1
  std::optional<double> crown_radius;  ///< of the tread across; absent: flat [m], >= width/2
  /// Grooves around the wheel, as deep as the tread: z of their middle and width [m]. They need a
  /// disk.tread; one with groove_columns = 0 has no others.
  std::vector<std::array<double, 2>> grooves;
};

/// Elements over the width that the grooves' edges need at the least.
int least_axial(const Wheel& wheel);

/// z of the lines of nodes across the section, ascending: on the faces and on the edges of the
/// grooves, others evenly between these [m]. @pre axial >= least_axial
std::vector<double> axial_lines(const Wheel& wheel);

/// Number of nodes that make_wheel would make, without making them; no fewer where there are
/// grooves around the wheel.
std::size_t n_wheel_nodes(const Wheel& wheel) noexcept;

/// What a sector is made of: columns of the section, one after the other around the wheel.
struct Columns {
  int n_sectors = 0;  ///< >= 3
  int columns = 1;    ///< of elements in a sector, all of the same angle, >= 1
  /// (columns, cells of the section) 1: the cell is there; empty: all are.
  std::vector<char> kept{};
};

/// The section as a plane mesh, x being r and y being z, cells counter-clockwise: "rim" is clamped,
/// "tread" is the top; "left" and "right" are the sides, at the least and the largest z. It has no
/// candidates. Nodes are numbered layer after layer outwards.
Mesh make_section(const Wheel& wheel);

/// The columns of a generated wheel, its tread and its grooves being what is left out.
Columns columns_of(const Wheel& wheel, const Mesh& section);

/// Sector 0 begins at -90°, straight down; nodes and hexahedra are numbered sector after sector, in
/// each alike. Nodes of no cell are left out. Clamped are those of the section's clamped ones.
/// Curves of the section's boundary become surfaces, of the faces that no groove has taken the cell
/// from. Candidates are the nodes of the surface `contact` that are not clamped, ascending; their
/// tributaries are ∫ N dA of its faces, those beside a clamped node too.
/// @param contact name of a curve of the section
/// @pre r > 0 in the section, which has no triangles.
Mesh revolve(const Mesh& section, const Columns& columns, std::string_view contact);

/// Edges around the wheel between candidates, each once, the axle on the left of it.
/// @param contact name of the surface of the candidates. @pre the mesh is of revolve()
std::vector<Edge> rolling_edges(const Mesh& mesh, std::string_view contact);

inline Mesh make_wheel(const Wheel& wheel) {
  const Mesh section = make_section(wheel);
  return revolve(section, columns_of(wheel, section), "tread");
}

}  // namespace rondo::mesh
