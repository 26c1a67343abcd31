// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/fem/sector_stiffness.hpp"

#include <algorithm>
#include <map>
#include <numbers>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/fem/assembly.hpp"

namespace rondo::fem {
namespace {

using Block = std::array<double, 4>;  // column-major

Block transposed(const Block& b) noexcept {
  return {b[0], b[2], b[1], b[3]};
}

/// block · R: its columns act on vectors turned by `turn`.
Block turned(const Block& b, Complex turn) noexcept {
  return {b[0] * turn.re + b[2] * turn.im, b[1] * turn.re + b[3] * turn.im,
          b[2] * turn.re - b[0] * turn.im, b[3] * turn.re - b[1] * turn.im};
}

/// Corners of a cell as (number within the sector, shift from sector 0).
struct LocalCell {
  std::array<int, 4> node, shift;
  std::size_t n;
  std::size_t cell;         ///< of the mesh
  ElementMatrix stiffness;  ///< of that cell
};

int shift_of(int sector, int n_sectors) noexcept {
  return sector == n_sectors - 1 ? -1 : sector;
}

/// Cells with a corner in sector 0.
std::vector<LocalCell> cells_of_sector(const mesh::Mesh& mesh) {
  std::vector<LocalCell> cells;
  for (std::size_t e = 0; e < mesh.cells.size(); ++e) {
    const mesh::Cell& cell = mesh.cells[e];
    LocalCell c{{}, {}, static_cast<std::size_t>(mesh::n_corners(cell)), e, {}};
    bool touches = false;
    for (std::size_t i = 0; i < c.n; ++i) {
      const auto node = static_cast<std::size_t>(cell[i]);
      c.node[i] = mesh.sector_node[node];
      c.shift[i] = shift_of(mesh.sector[node], mesh.n_sectors);
      touches = touches || c.shift[i] == 0;
    }
    if (touches) cells.push_back(c);
  }
  return cells;
}

/// Rows by layers: breadth-first over cells from the clamped nodes; -1 for these.
std::vector<int> order_by_layers(const std::vector<LocalCell>& cells,
                                 const std::vector<char>& clamped, SectorStiffness& k) {
  const std::size_t n = clamped.size();
  std::vector<int> layer(n, -1), place(n, -1);
  for (std::size_t i = 0; i < n; ++i)
    if (clamped[i]) layer[i] = 0;
  const auto lowest = [&](const LocalCell& c) {
    int found = -1;
    for (std::size_t i = 0; i < c.n; ++i) {
      const int l = layer[static_cast<std::size_t>(c.node[i])];
      if (l >= 0 && (found < 0 || l < found)) found = l;
    }
    return found;
  };
  for (int current = 0;; ++current) {
    bool grew = false;
    for (const LocalCell& c : cells) {
      if (lowest(c) != current) continue;
      for (std::size_t i = 0; i < c.n; ++i) {
        int& l = layer[static_cast<std::size_t>(c.node[i])];
        if (l < 0) l = current + 1, grew = true;
      }
    }
    if (!grew) break;
  }
  for (std::size_t i = 0; i < n; ++i)
    if (!clamped[i]) k.nodes.push_back(static_cast<int>(i));
  std::stable_sort(k.nodes.begin(), k.nodes.end(), [&](int a, int b) {
    return layer[static_cast<std::size_t>(a)] < layer[static_cast<std::size_t>(b)];
  });
  for (std::size_t a = 0; a < k.nodes.size(); ++a)
    place[static_cast<std::size_t>(k.nodes[a])] = static_cast<int>(a);
  return place;
}

struct Key {
  int row, column, shift;
  auto operator<=>(const Key&) const = default;
};

/// Blocks of the rows of sector 0 on the columns of sectors 0 and 1. What couples it with the
/// sector before is the transpose of what couples that one with it.
std::map<Key, Block> forward_blocks(const std::vector<LocalCell>& cells,
                                    const std::vector<int>& place, Complex turn) {
  std::map<Key, Block> blocks;
  for (const LocalCell& c : cells) {
    const ElementMatrix& e = c.stiffness;
    for (std::size_t i = 0; i < c.n; ++i)
      for (std::size_t j = 0; j < c.n; ++j) {
        const int row = place[static_cast<std::size_t>(c.node[i])],
                  column = place[static_cast<std::size_t>(c.node[j])];
        if (row < 0 || column < 0 || c.shift[i] != 0 || c.shift[j] < 0) continue;
        const auto entry = [&](std::size_t p, std::size_t q) {
          return e(static_cast<int>(std::min(p, q)), static_cast<int>(std::max(p, q)));
        };
        const Block b{entry(2 * i, 2 * j), entry(2 * i + 1, 2 * j), entry(2 * i, 2 * j + 1),
                      entry(2 * i + 1, 2 * j + 1)};
        Block& sum = blocks[{row, column, c.shift[j]}];
        const Block t = c.shift[j] == 1 ? turned(b, turn) : b;
        for (std::size_t q = 0; q < 4; ++q) sum[q] += t[q];
      }
  }
  return blocks;
}

void add_rows(const std::map<Key, Block>& forward, SectorStiffness& k) {
  std::map<Key, Block> all = forward;
  for (const auto& [key, block] : forward) {
    if (key.shift == 1) all[{key.column, key.row, -1}] = transposed(block);
    if (key.shift == 0 && key.row < key.column) all[{key.column, key.row, 0}] = transposed(block);
  }
  k.row_start.assign(k.n_local() + 1, 0);
  for (const auto& [key, block] : all) {
    k.entries.push_back({key.column, key.shift, block});
    ++k.row_start[static_cast<std::size_t>(key.row) + 1];
  }
  for (std::size_t a = 0; a < k.n_local(); ++a) k.row_start[a + 1] += k.row_start[a];
}

}  // namespace

SectorStiffness assemble_sector(const mesh::Mesh& mesh, std::span<const Material> materials,
                                std::span<const Vec2> prestress) {
  RONDO_DEMAND(mesh.n_sectors >= 3, mesh.n_sectors);
  SectorStiffness k;
  k.n_sectors = mesh.n_sectors;
  k.nodes_per_sector = static_cast<int>(mesh.n_nodes()) / mesh.n_sectors;
  RONDO_DEMAND(
      static_cast<std::size_t>(k.nodes_per_sector) * static_cast<std::size_t>(k.n_sectors) ==
          mesh.n_nodes(),
      k.nodes_per_sector, k.n_sectors);
  for (int j = 0; j < k.n_sectors; ++j)
    k.turn.push_back(rotation(2.0 * std::numbers::pi * j / k.n_sectors));
  std::vector<char> clamped(static_cast<std::size_t>(k.nodes_per_sector), 0);
  for (const int node : mesh.clamped)
    clamped[static_cast<std::size_t>(mesh.sector_node[static_cast<std::size_t>(node)])] = 1;
  std::vector<LocalCell> cells = cells_of_sector(mesh);
  const std::vector<int> place = order_by_layers(cells, clamped, k);
  const NodalDilatation dilatation(mesh, materials);
  RONDO_DEMAND(dilatation.empty());  // reaches beyond the sector beside
  for (LocalCell& c : cells)
    c.stiffness = cell_stiffness(mesh, materials, prestress, c.cell, dilatation);
  add_rows(forward_blocks(cells, place, k.turn[1]), k);
  return k;
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
        const std::size_t there = sector[static_cast<std::size_t>(place)];
        const Vec2 c = conj(k.turn[there]) * u[k.node(static_cast<std::size_t>(e.column), there)];
        sum += {e.block[0] * c.x + e.block[2] * c.y, e.block[1] * c.x + e.block[3] * c.y};
      }
      out[k.node(a, j)] = k.turn[j] * sum;
    }
  }
}

}  // namespace rondo::fem
