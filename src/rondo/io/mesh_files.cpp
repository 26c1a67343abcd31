// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/io/mesh_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "rondo/core/error.hpp"
#include "rondo/core/index.hpp"
#include "rondo/io/h5/hash.hpp"

namespace rondo::io {
namespace {

struct CellCounts {
  std::size_t cells, corners, triangles;
  [[nodiscard]] bool mixed() const noexcept { return triangles > 0 && triangles < cells; }
  /// Length of the list that XDMF requires for a mixed mesh: type, then corners of each cell.
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

void write_hexahedra(h5::File& file, const mesh::Mesh& m) {
  file.write("/mesh/hexahedra", {m.hexahedra.size(), 8}, m.hexahedra,
             {"1",
              "corner nodes of each hexahedron, from 0: a face, counter-clockwise as seen from "
              "inside, then the one opposite, corner by corner"});
}

void write_cells(h5::File& file, const mesh::Mesh& m) {
  if (m.is_solid()) return write_hexahedra(file, m);
  const CellCounts c = counts_of(m);
  file.write("/mesh/cells", {c.cells, c.corners}, cell_table(m, c.corners),
             {"1", "corner nodes of each cell, counter-clockwise, from 0; -1: no such corner"});
  if (c.mixed())
    file.write("/mesh/cells_mixed", {c.n_mixed()}, mixed_list(m),
               {"1", "the cells as a list for XDMF: 4 (triangle) or 5 (quadrilateral), its nodes"});
}

void write_coordinates(h5::File& file, const mesh::Mesh& m) {
  if (!m.is_solid())
    return file.write(
        "/mesh/coordinates", {m.n_nodes(), 2}, m.coordinates,
        {"m",
         "reference position X of each node: co-rotating frame, from the center; of free bodies "
         "fixed frame"});
  std::vector<std::array<double, 3>> places;
  for (std::size_t i = 0; i < m.n_nodes(); ++i)
    places.push_back({m.coordinates[i].x, m.coordinates[i].y, m.axial[i]});
  file.write("/mesh/coordinates", {m.n_nodes(), 3}, std::span<const std::array<double, 3>>(places),
             {"m",
              "reference position X of each node: co-rotating frame, from the center; z along the "
              "axle, to the right of the heading"});
}

}  // namespace

void write_mesh(h5::File& file, const mesh::Mesh& m, std::span<const double> mass) {
  const std::size_t n = m.n_nodes(), nb = m.boundary.size();
  const bool solid = m.is_solid();
  write_coordinates(file, m);
  write_cells(file, m);
  file.write("/mesh/boundary", {nb}, m.boundary,
             {"1", solid ? "nodes that may touch something, ascending"
                         : "nodes that may touch something, in order along the boundary"});
  file.write(
      "/mesh/tributary", {nb}, m.tributary,
      {solid ? "m2" : "m", solid ? "area that each node of /mesh/boundary stands for, undeformed"
                                 : "length of boundary that each node of /mesh/boundary "
                                   "stands for, undeformed"});
  file.write("/mesh/mass", {n}, mass,
             {solid ? "kg" : "kg/m",
              solid ? "lumped mass of each node" : "lumped mass of each node, per unit thickness"});
  if (!m.region.empty()) {
    file.write("/mesh/region", {m.region.size()}, m.region,
               {"1", "physical surface of each cell: its attributes name_0, name_1, ..."});
    for (std::size_t k = 0; k < m.region_names.size(); ++k)
      file.set_attribute("/mesh/region", fmt::format("name_{}", k), m.region_names[k]);
  }
  if (m.n_sectors == 0) return;
  file.write("/mesh/sector", {n}, m.sector,
             {"1", "sector of each node, counter-clockwise from straight down, from 0"});
  file.write("/mesh/sector_node", {n}, m.sector_node,
             {"1", "number of each node within its sector: the same in all sectors"});
}

namespace {

[[noreturn]] void damaged(const h5::File& file, const std::string& what) {
  throw FileError(file.path(), "/mesh " + what + ": damaged, or not of this program");
}

std::vector<mesh::Cell> read_cells(const h5::File& file) {
  const h5::Dataset dataset = file.dataset("/mesh/cells", {h5::any, h5::any});
  const std::size_t corners = dataset.shape()[1];
  if (corners != 3 && corners != 4) damaged(file, fmt::format("has cells of {} corners", corners));
  if (corners == 4) return dataset.read<mesh::Cell>();
  std::vector<mesh::Cell> cells;
  for (const auto& [a, b, c] : dataset.read<std::array<int, 3>>()) cells.push_back({a, b, c, -1});
  return cells;
}

/// Masses of nodes outside this range are refused, because weights of a POD would overflow [kg/m].
constexpr double lightest = 1e-100, heaviest = 1e100;

/// Each pair (sector, number within it) must belong to one node. @return number of sectors
int count_sectors(const h5::File& file, const mesh::Mesh& m) {
  const auto n = static_cast<long long>(m.n_nodes());
  const long long sectors = 1LL + *std::max_element(m.sector.begin(), m.sector.end());
  if (sectors < 1 || n % sectors != 0)
    damaged(file, fmt::format("has {} nodes in {} sectors", n, sectors));
  const long long of_each = n / sectors;
  std::vector<char> seen(m.n_nodes(), 0);
  for (std::size_t i = 0; i < m.n_nodes(); ++i) {
    const long long s = m.sector[i], k = m.sector_node[i];
    if (s < 0 || k < 0 || k >= of_each || seen[at(s * of_each + k)]++ != 0)
      damaged(file,
              fmt::format("has node {} at place {} of sector {}, where it cannot be", i, k, s));
  }
  return static_cast<int>(sectors);
}

void check_nodes(const h5::File& file, const mesh::Mesh& m) {
  const auto n = static_cast<long long>(m.n_nodes());
  const auto is_node = [n](int node) { return node >= 0 && node < n; };
  for (std::size_t c = 0; c < m.cells.size(); ++c)
    for (int k = 0; k < mesh::n_corners(m.cells[c]); ++k)
      if (!is_node(m.cells[c][at(k)]))
        damaged(file, fmt::format("has cell {} with a node that is none of the {}", c, n));
  for (std::size_t e = 0; e < m.hexahedra.size(); ++e)
    if (!std::ranges::all_of(m.hexahedra[e], is_node))
      damaged(file, fmt::format("has hexahedron {} with a node that is none of the {}", e, n));
  for (const double z : m.axial)
    if (!std::isfinite(z)) damaged(file, "has a node at a place that is not finite");
  for (const int node : m.boundary)
    if (!is_node(node)) damaged(file, fmt::format("has contact node {} among {} nodes", node, n));
  for (std::size_t i = 0; i < m.n_nodes(); ++i)
    if (!std::isfinite(m.coordinates[i].x) || !std::isfinite(m.coordinates[i].y))
      damaged(file, fmt::format("has node {} at a place that is not finite", i));
}

void read_solid(const h5::File& file, mesh::Mesh& m) {
  for (const auto& [x, y, z] :
       file.dataset("/mesh/coordinates", {h5::any, 3}).read<std::array<double, 3>>()) {
    m.coordinates.push_back({x, y});
    m.axial.push_back(z);
  }
  m.hexahedra = file.dataset("/mesh/hexahedra", {h5::any, 8}).read<mesh::Hexahedron>();
}

}  // namespace

MeshWithMass read_mesh(const h5::File& file) {
  MeshWithMass out;
  mesh::Mesh& m = out.mesh;
  const bool solid = file.contains("/mesh/hexahedra");
  if (solid)
    read_solid(file, m);
  else
    m.coordinates = file.dataset("/mesh/coordinates", {h5::any, 2}).read<Vec2>();
  const std::size_t n = m.n_nodes();
  if (n == 0) damaged(file, "has no nodes");
  if (!solid) m.cells = read_cells(file);
  m.boundary = file.dataset("/mesh/boundary", {h5::any}).read<int>();
  m.tributary = file.dataset("/mesh/tributary", {m.boundary.size()}).read<double>();
  out.mass = file.dataset("/mesh/mass", {n}).read<double>();
  for (std::size_t i = 0; i < n; ++i)
    if (!(out.mass[i] >= lightest && out.mass[i] <= heaviest))
      damaged(file, fmt::format("has node {} with the mass {} {}", i, out.mass[i],
                                solid ? "kg" : "kg/m"));
  check_nodes(file, m);
  if (!file.contains("/mesh/sector")) return out;
  m.sector = file.dataset("/mesh/sector", {n}).read<int>();
  m.sector_node = file.dataset("/mesh/sector_node", {n}).read<int>();
  m.n_sectors = count_sectors(file, m);
  return out;
}

std::size_t mesh_bytes(const mesh::Mesh& m) noexcept {
  constexpr std::size_t real = 8, whole = 4;
  const CellCounts c = counts_of(m);
  const std::size_t cells = c.cells * c.corners + (c.mixed() ? c.n_mixed() : 0);
  if (m.is_solid())
    return m.n_nodes() * (4 * real + 2 * whole) + m.hexahedra.size() * 8 * whole +
           m.boundary.size() * (whole + real) + m.region.size() * whole;
  return m.n_nodes() * (3 * real + (m.n_sectors > 0 ? 2 * whole : 0)) + cells * whole +
         m.boundary.size() * (whole + real) + m.region.size() * whole;
}

std::string mesh_hash(const mesh::Mesh& m) {
  Hash hash;
  const auto add = [&](const auto& values) {
    const std::size_t size = values.size();
    hash.add(std::span(&size, 1));
    hash.add(std::span(values));
  };
  for (const auto* nodes : {&m.clamped, &m.boundary, &m.region, &m.sector, &m.sector_node})
    add(*nodes);
  add(m.coordinates);
  add(m.cells);
  add(m.tributary);
  add(m.contact_edges);
  for (const mesh::Curve& curve : m.curves) add(curve.edges);
  if (m.is_solid()) {
    add(m.axial);
    add(m.hexahedra);
    for (const mesh::Surface& surface : m.surfaces) add(surface.faces);
  }
  return hash.text();
}

XdmfTopology topology_of(const mesh::Mesh& m) {
  if (m.is_solid())
    return {"Hexahedron",
            m.hexahedra.size(),
            "/mesh/hexahedra",
            {m.hexahedra.size(), 8},
            8 * m.hexahedra.size()};
  const CellCounts c = counts_of(m);
  const std::size_t corners = 4 * c.cells - c.triangles;
  if (c.mixed()) return {"Mixed", c.cells, "/mesh/cells_mixed", {c.n_mixed()}, corners};
  return {c.corners == 3 ? "Triangle" : "Quadrilateral",
          c.cells,
          "/mesh/cells",
          {c.cells, c.corners},
          corners};
}

namespace {

std::string counts_differ(std::size_t a, std::size_t b, const char* what) {
  return a == b ? std::string() : fmt::format("{} {} against {}", a, what, b);
}

/// First index at which two lists of equal length differ; their length if they are equal.
template <class T>
std::size_t first_difference(const std::vector<T>& a, const std::vector<T>& b) {
  std::size_t i = 0;
  while (i < a.size() && a[i] == b[i]) ++i;
  return i;
}

std::string sizes_differ(const mesh::Mesh& a, const mesh::Mesh& b) {
  for (const std::string& text :
       {counts_differ(a.n_nodes(), b.n_nodes(), "nodes"),
        counts_differ(a.cells.size(), b.cells.size(), "cells"),
        counts_differ(a.hexahedra.size(), b.hexahedra.size(), "hexahedra"),
        counts_differ(a.axial.size(), b.axial.size(), "axial places"),
        counts_differ(a.boundary.size(), b.boundary.size(), "candidates"),
        counts_differ(static_cast<std::size_t>(a.n_sectors), static_cast<std::size_t>(b.n_sectors),
                      "sectors")})
    if (!text.empty()) return text;
  return {};
}

}  // namespace

std::string mesh_difference(const mesh::Mesh& a, const mesh::Mesh& b) {
  if (const std::string text = sizes_differ(a, b); !text.empty()) return text;
  const std::size_t n = a.n_nodes();
  if (const auto i = first_difference(a.coordinates, b.coordinates); i < n)
    return fmt::format("coordinates differ at node {} by {:.3g} m", i,
                       norm(a.coordinates[i] - b.coordinates[i]));
  if (const auto c = first_difference(a.cells, b.cells); c < a.cells.size())
    return fmt::format("cells differ at cell {}", c);
  if (const auto c = first_difference(a.hexahedra, b.hexahedra); c < a.hexahedra.size())
    return fmt::format("hexahedra differ at number {}", c);
  if (const auto i = first_difference(a.axial, b.axial); i < a.axial.size())
    return fmt::format("coordinates differ at node {} by {:.3g} m along the axle", i,
                       std::abs(a.axial[i] - b.axial[i]));
  if (const auto k = first_difference(a.boundary, b.boundary); k < a.boundary.size())
    return fmt::format("contact nodes differ: number {} is node {} against {}", k, a.boundary[k],
                       b.boundary[k]);
  if (const auto k = first_difference(a.tributary, b.tributary); k < a.tributary.size())
    return fmt::format("tributary {} differ at contact node {} by {:.3g} {}",
                       a.is_solid() ? "areas" : "lengths", k,
                       std::abs(a.tributary[k] - b.tributary[k]), a.is_solid() ? "m²" : "m");
  if (first_difference(a.sector, b.sector) < a.sector.size() ||
      first_difference(a.sector_node, b.sector_node) < a.sector_node.size())
    return "the numbering of the sectors differs";
  return {};
}

}  // namespace rondo::io
