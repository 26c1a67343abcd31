// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/mesh/edges.hpp"
#include "rondo/mesh/solid/face.hpp"
#include "rondo/mesh/solid/wheel.hpp"

namespace rondo::mesh {
namespace {

/// The lines of nodes of a sector: each has the section's nodes at one angle.
struct Lines {
  int nodes_per_sector = 0;
  std::vector<std::vector<int>> number;  ///< [line][node of the section] in the sector; -1: none
};

/// The free nodes of the contact surface, each with its share of the adjacent faces.
void find_candidates(std::string_view contact, Mesh& mesh) {
  mesh.boundary.clear();
  mesh.tributary.clear();
  const auto surface = std::ranges::find(mesh.surfaces, contact, &Surface::name);
  if (surface == mesh.surfaces.end()) return;
  std::vector<double> area(mesh.n_nodes(), 0.0);
  for (const Face& face : surface->faces) {
    const std::array<Vec3, 4> share = face_shares(face_corners(mesh, face));
    for (std::size_t i = 0; i < 4; ++i) area[at(face[i])] += norm(share[i]);
  }
  for (const int node : mesh.clamped) area[at(node)] = 0.0;
  for (std::size_t i = 0; i < area.size(); ++i)
    if (area[i] > 0.0) {
      mesh.boundary.push_back(static_cast<int>(i));
      mesh.tributary.push_back(area[i]);
    }
}

class Sweep {
 public:
  Sweep(const Mesh& section, const Columns& columns)
      : section_(section), columns_(columns), edges_(section) {
    number_lines();
  }

  Mesh mesh(std::string_view contact) const {
    Mesh mesh;
    mesh.n_sectors = columns_.n_sectors;
    mesh.region_names = section_.region_names;
    add_nodes(mesh);
    add_hexahedra(mesh);
    add_surfaces(mesh);
    find_candidates(contact, mesh);
    return mesh;
  }

 private:
  /// Whether `column` of a sector has the cell.
  [[nodiscard]] bool kept(int column, std::size_t cell) const {
    const auto place = static_cast<std::size_t>(column) * section_.cells.size() + cell;
    return columns_.kept.empty() || columns_.kept[place] != 0;
  }

  /// A line gets the nodes of the cells on either side of it.
  void number_lines() {
    const auto n = static_cast<std::size_t>(columns_.columns);
    std::vector<std::vector<char>> used(n, std::vector<char>(section_.n_nodes(), 0));
    for (int c = 0; c < columns_.columns; ++c)
      for (std::size_t e = 0; e < section_.cells.size(); ++e)
        if (kept(c, e))
          for (const int node : section_.cells[e])
            for (const std::size_t line :
                 {static_cast<std::size_t>(c), (static_cast<std::size_t>(c) + 1) % n})
              used[line][at(node)] = 1;
    for (const std::vector<char>& line : used) {
      lines_.number.emplace_back(section_.n_nodes(), -1);
      for (std::size_t i = 0; i < line.size(); ++i)
        if (line[i]) lines_.number.back()[i] = lines_.nodes_per_sector++;
    }
  }

  /// The node of the mesh on the line at which column `column` of a sector begins; `column` may be
  /// one past the last.
  [[nodiscard]] int node(int sector, int column, int of_section) const {
    const int line = column % columns_.columns;
    const int there = (sector + column / columns_.columns) % columns_.n_sectors;
    const int number = lines_.number[at(line)][at(of_section)];
    return there * lines_.nodes_per_sector + number;
  }

  void add_nodes(Mesh& mesh) const {
    const std::vector<char> clamped = clamped_flags(section_);
    const int n_lines = columns_.n_sectors * columns_.columns;
    for (int line = 0; line < n_lines; ++line) {
      const double angle = 2.0 * std::numbers::pi * line / n_lines - 0.5 * std::numbers::pi;
      const Vec2 direction = direction_at(angle);
      const auto& number = lines_.number[at(line % columns_.columns)];
      for (std::size_t i = 0; i < number.size(); ++i) {
        if (number[i] < 0) continue;
        if (clamped[i]) mesh.clamped.push_back(static_cast<int>(mesh.n_nodes()));
        mesh.coordinates.push_back(section_.coordinates[i].x * direction);
        mesh.axial.push_back(section_.coordinates[i].y);
        mesh.sector.push_back(line / columns_.columns);
        mesh.sector_node.push_back(number[i]);
      }
    }
  }

  /// Calls visit(sector, column), counter-clockwise from -90°.
  template <class Visit>
  void each_column(const Visit& visit) const {
    for (int s = 0; s < columns_.n_sectors; ++s)
      for (int c = 0; c < columns_.columns; ++c) visit(s, c);
  }

  void add_hexahedra(Mesh& mesh) const {
    each_column([&](int s, int c) {
      for (std::size_t e = 0; e < section_.cells.size(); ++e) {
        if (!kept(c, e)) continue;
        const Cell& cell = section_.cells[e];  // counter-clockwise in (r, z), which is clockwise
        Hexahedron h{};                        // when seen along the way around
        for (std::size_t i = 0; i < 4; ++i) {
          const int corner = cell[(4 - i) % 4];
          h[i] = node(s, c, corner);
          h[i + 4] = node(s, c + 1, corner);
        }
        mesh.hexahedra.push_back(h);
        if (!section_.region.empty()) mesh.region.push_back(section_.region[e]);
      }
    });
  }

  /// The faces that edges of the section's boundary sweep, where their cells exist.
  [[nodiscard]] std::vector<Face> swept(std::span<const Edge> edges) const {
    std::vector<Face> faces;
    each_column([&](int s, int c) {
      for (const auto& [p, q] : edges) {
        const auto cells = edges_.find({p, q});
        if (cells.size() != 1 || !kept(c, static_cast<std::size_t>(cells[0].cell))) continue;
        faces.push_back({node(s, c, p), node(s, c + 1, p), node(s, c + 1, q), node(s, c, q)});
      }
    });
    return faces;
  }

  void add_surfaces(Mesh& mesh) const {
    for (const Curve& curve : section_.curves) {
      std::vector<Face> faces = swept(curve.edges);
      if (!faces.empty()) mesh.surfaces.push_back({curve.name, std::move(faces)});
    }
  }

  const Mesh& section_;
  const Columns& columns_;
  EdgeTable edges_;
  Lines lines_;
};

}  // namespace

void move_nodes(Mesh& mesh, std::span<const Vec3> by, std::string_view contact) {
  RONDO_DEMAND(mesh.is_solid() && by.size() == mesh.n_nodes(), by.size(), mesh.n_nodes());
  for (std::size_t i = 0; i < by.size(); ++i) {
    mesh.coordinates[i] += by[i].plane();
    mesh.axial[i] += by[i].z;
  }
  find_candidates(contact, mesh);
}

std::vector<Edge> rolling_edges(const Mesh& mesh, std::string_view contact) {
  std::vector<Edge> edges;
  const auto is_candidate = [&](int node) {
    return std::ranges::binary_search(mesh.boundary, node);
  };
  const auto surface = std::ranges::find(mesh.surfaces, contact, &Surface::name);
  if (surface == mesh.surfaces.end()) return edges;
  for (const Face& f : surface->faces)
    for (const Edge edge : {Edge{f[0], f[1]}, Edge{f[3], f[2]}})
      if (is_candidate(edge[0]) && is_candidate(edge[1])) edges.push_back(edge);
  std::ranges::sort(edges);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

Mesh revolve(const Mesh& section, const Columns& columns, std::string_view contact) {
  RONDO_DEMAND(columns.n_sectors >= 3 && columns.columns >= 1, columns.n_sectors, columns.columns);
  const auto n = static_cast<std::size_t>(columns.columns) * section.cells.size();
  RONDO_DEMAND(columns.kept.empty() || columns.kept.size() == n, columns.kept.size(), n);
  for (const Cell& cell : section.cells) {
    RONDO_DEMAND(n_corners(cell) == 4, cell[0], cell[1], cell[2]);
    for (const int node : cell) {
      const double r = section.coordinates[at(node)].x;
      RONDO_DEMAND(r > 0.0, node, r);
    }
  }
  return Sweep(section, columns).mesh(contact);
}

}  // namespace rondo::mesh
