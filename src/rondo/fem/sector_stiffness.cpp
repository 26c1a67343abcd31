// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/fem/sector_stiffness.hpp"

#include <algorithm>
#include <numbers>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/fem/assembly.hpp"
#include "rondo/fem/sector_rows.hpp"

namespace rondo::fem {
namespace detail {
namespace {

/// (nodes_per_sector) Layer of each node: 0 if clamped; -1: not connected to clamped nodes.
std::vector<int> layers_of(const std::vector<SectorElement>& elements,
                           const std::vector<char>& clamped) {
  std::vector<int> layer(clamped.size(), -1);
  for (std::size_t i = 0; i < clamped.size(); ++i)
    if (clamped[i]) layer[i] = 0;
  const auto lowest = [&](const SectorElement& c) {
    int found = -1;
    for (std::size_t i = 0; i < c.n; ++i) {
      const int l = layer[at(c.node[i])];
      if (l >= 0 && (found < 0 || l < found)) found = l;
    }
    return found;
  };
  for (int current = 0;; ++current) {
    bool grew = false;
    for (const SectorElement& c : elements) {
      if (lowest(c) != current) continue;
      for (std::size_t i = 0; i < c.n; ++i) {
        int& l = layer[at(c.node[i])];
        if (l < 0) l = current + 1, grew = true;
      }
    }
    if (!grew) break;
  }
  return layer;
}

}  // namespace

SectorRows sector_rows(const mesh::Mesh& mesh, const std::vector<SectorElement>& elements) {
  SectorRows rows;
  RONDO_DEMAND(mesh.n_sectors >= 3, mesh.n_sectors);
  rows.nodes_per_sector = static_cast<int>(mesh.n_nodes()) / mesh.n_sectors;
  RONDO_DEMAND(
      static_cast<std::size_t>(rows.nodes_per_sector) * static_cast<std::size_t>(mesh.n_sectors) ==
          mesh.n_nodes(),
      rows.nodes_per_sector, mesh.n_sectors);
  for (int j = 0; j < mesh.n_sectors; ++j)
    rows.turn.push_back(rotation(2.0 * std::numbers::pi * j / mesh.n_sectors));
  const auto n = static_cast<std::size_t>(rows.nodes_per_sector);
  std::vector<char> clamped(n, 0);
  for (const int node : mesh.clamped)
    clamped[at(mesh.sector_node[static_cast<std::size_t>(node)])] = 1;
  const std::vector<int> layer = layers_of(elements, clamped);
  for (std::size_t i = 0; i < n; ++i)
    if (!clamped[i]) rows.nodes.push_back(static_cast<int>(i));
  std::stable_sort(rows.nodes.begin(), rows.nodes.end(),
                   [&](int a, int b) { return layer[at(a)] < layer[at(b)]; });
  rows.place.assign(n, -1);
  for (std::size_t a = 0; a < rows.nodes.size(); ++a)
    rows.place[at(rows.nodes[a])] = static_cast<int>(a);
  return rows;
}

}  // namespace detail

SectorStiffness assemble_sector(const mesh::Mesh& mesh, std::span<const Material> materials,
                                std::span<const Vec2> prestress) {
  const auto elements =
      detail::sector_elements(mesh, mesh.cells.size(), [&](std::size_t e) -> std::span<const int> {
        return {mesh.cells[e].data(), static_cast<std::size_t>(mesh::n_corners(mesh.cells[e]))};
      });
  const detail::SectorRows rows = detail::sector_rows(mesh, elements);
  const NodalDilatation dilatation(mesh, materials);
  RONDO_DEMAND(dilatation.empty());  // couples beyond adjacent sectors
  const auto stiffness = [&](std::size_t cell) {
    return cell_stiffness(mesh, materials, prestress, cell, dilatation);
  };
  return detail::sector_blocks<2>(detail::forward_blocks<2>(elements, rows, stiffness), rows);
}

void apply(const SectorStiffness& k, std::span<const Vec2> u, std::span<Vec2> out) {
  const auto n = static_cast<std::size_t>(k.n_sectors);
  std::fill(out.begin(), out.end(), Vec2{});
  for (std::size_t j = 0; j < n; ++j) {
    const std::array<std::size_t, 3> sector{(j + n - 1) % n, j, (j + 1) % n};
    for (std::size_t a = 0; a < k.n_local(); ++a) {
      Vec2 sum;
      for (const SectorStiffness::Entry& e : k.row(a)) {
        const int place = e.shift + 1;
        const std::size_t there = sector[at(place)];
        const Vec2 c = conj(k.turn[there]) * u[k.node(static_cast<std::size_t>(e.column), there)];
        sum += {e.block[0] * c.x + e.block[2] * c.y, e.block[1] * c.x + e.block[3] * c.y};
      }
      out[k.node(a, j)] = k.turn[j] * sum;
    }
  }
}

}  // namespace rondo::fem
