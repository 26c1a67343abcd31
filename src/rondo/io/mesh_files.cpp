// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/io/mesh_files.hpp"

#include <vector>

namespace rondo::io {
namespace {

struct CellCounts {
  std::size_t cells, corners, triangles;
  [[nodiscard]] bool mixed() const noexcept { return triangles > 0 && triangles < cells; }
  /// Entries of the list that XDMF wants of a mixed mesh: type, then corners.
  [[nodiscard]] std::size_t n_mixed() const noexcept { return 5 * cells - triangles; }
};

CellCounts counts_of(const mesh::Mesh& m) noexcept {
  CellCounts c{m.cells.size(), 4, 0};
  for (const mesh::Cell& cell : m.cells) c.triangles += mesh::n_corners(cell) == 3 ? 1 : 0;
  if (c.cells > 0 && c.triangles == c.cells) c.corners = 3;
  return c;
}

std::vector<int> cell_table(const mesh::Mesh& m, std::size_t corners) {
  std::vector<int> table;
  table.reserve(m.cells.size() * corners);
  for (const mesh::Cell& cell : m.cells)
    table.insert(table.end(), cell.begin(), cell.begin() + static_cast<std::ptrdiff_t>(corners));
  return table;
}

std::vector<int> mixed_list(const mesh::Mesh& m) {
  constexpr int triangle = 4, quadrilateral = 5;  // numbers of XDMF
  std::vector<int> list;
  for (const mesh::Cell& cell : m.cells) {
    const int corners = mesh::n_corners(cell);
    list.push_back(corners == 3 ? triangle : quadrilateral);
    list.insert(list.end(), cell.begin(), cell.begin() + corners);
  }
  return list;
}

template <class T>
std::span<const T> view(const std::vector<T>& values) {
  return values;
}

void write_cells(h5::File& file, const mesh::Mesh& m) {
  const CellCounts c = counts_of(m);
  file.write("/mesh/cells", {c.cells, c.corners}, view(cell_table(m, c.corners)),
             {"1", "corner nodes of each cell, counter-clockwise, from 0; -1: no such corner"});
  if (c.mixed())
    file.write("/mesh/cells_mixed", {c.n_mixed()}, view(mixed_list(m)),
               {"1", "the cells as a list for XDMF: 4 (triangle) or 5 (quadrilateral), its nodes"});
}

}  // namespace

void write_mesh(h5::File& file, const mesh::Mesh& m, std::span<const double> mass) {
  const std::size_t n = m.n_nodes(), nb = m.boundary.size();
  file.write("/mesh/coordinates", {n, 2}, view(m.coordinates),
             {"m", "reference position X of each node, turning frame, from the centre"});
  write_cells(file, m);
  file.write("/mesh/boundary", {nb}, view(m.boundary),
             {"1", "nodes that may touch the ground, in order along the boundary"});
  file.write("/mesh/tributary", {nb}, view(m.tributary),
             {"m", "length of boundary that each node of /mesh/boundary stands for"});
  file.write("/mesh/mass", {n}, mass, {"kg/m", "lumped mass of each node, per unit thickness"});
  if (m.n_sectors == 0) return;
  file.write("/mesh/sector", {n}, view(m.sector),
             {"1", "sector of each node, counter-clockwise from straight down, from 0"});
  file.write("/mesh/sector_node", {n}, view(m.sector_node),
             {"1", "number of each node within its sector: the same in all sectors"});
}

std::size_t mesh_bytes(const mesh::Mesh& m) noexcept {
  constexpr std::size_t real = 8, whole = 4;
  const CellCounts c = counts_of(m);
  const std::size_t cells = c.cells * c.corners + (c.mixed() ? c.n_mixed() : 0);
  return m.n_nodes() * (3 * real + (m.n_sectors > 0 ? 2 * whole : 0)) + cells * whole +
         m.boundary.size() * (whole + real);
}

XdmfTopology topology_of(const mesh::Mesh& m) {
  const CellCounts c = counts_of(m);
  if (c.mixed()) return {"Mixed", c.cells, "/mesh/cells_mixed", {c.n_mixed()}};
  return {
      c.corners == 3 ? "Triangle" : "Quadrilateral", c.cells, "/mesh/cells", {c.cells, c.corners}};
}

}  // namespace rondo::io
