// SPDX-License-Identifier: BSD-3-Clause
/// @file  Assembly of the row block of one sector (sector_stiffness.hpp), for any type of element
/// and any number of components per node.
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <span>
#include <vector>

#include "rondo/core/index.hpp"
#include "rondo/fem/sector_stiffness.hpp"

namespace rondo::fem::detail {

/// Corners of an element, each given as (number within the sector, shift from sector 0).
struct SectorElement {
  std::array<int, 8> node, shift;
  std::size_t n;
  std::size_t element;  ///< number in the mesh
};

/// Elements with a corner in sector 0. @param corners (element) function: span of corner nodes
template <class Corners>
std::vector<SectorElement> sector_elements(const mesh::Mesh& mesh, std::size_t n_elements,
                                           const Corners& corners) {
  std::vector<SectorElement> found;
  for (std::size_t e = 0; e < n_elements; ++e) {
    const std::span<const int> nodes = corners(e);
    SectorElement c{{}, {}, nodes.size(), e};
    bool touches = false;
    for (std::size_t i = 0; i < c.n; ++i) {
      const auto node = static_cast<std::size_t>(nodes[i]);
      const int sector = mesh.sector[node];
      c.node[i] = mesh.sector_node[node];
      c.shift[i] = sector == mesh.n_sectors - 1 ? -1 : sector;
      touches = touches || c.shift[i] == 0;
    }
    if (touches) found.push_back(c);
  }
  return found;
}

/// Rows of a sector, layer after layer, found breadth-first over elements from the clamped nodes.
struct SectorRows {
  int nodes_per_sector = 0;
  std::vector<Complex> turn;  ///< (N)
  std::vector<int> nodes;     ///< (n_local)
  std::vector<int> place;     ///< (nodes_per_sector) row of each node; -1: clamped
};
SectorRows sector_rows(const mesh::Mesh& mesh, const std::vector<SectorElement>& elements);

template <int C>
using NodeBlock = std::array<double, static_cast<std::size_t>(C* C)>;  // column-major

template <int C>
NodeBlock<C> transposed(const NodeBlock<C>& b) noexcept {
  NodeBlock<C> t{};
  for (std::size_t r = 0; r < C; ++r)
    for (std::size_t c = 0; c < C; ++c) t[r * C + c] = b[c * C + r];
  return t;
}

/// block · R: its columns then act on vectors whose first two components are turned by `turn`.
template <int C>
NodeBlock<C> turned(const NodeBlock<C>& b, Complex turn) noexcept {
  NodeBlock<C> t = b;
  for (std::size_t r = 0; r < C; ++r) {
    t[r] = b[r] * turn.re + b[C + r] * turn.im;
    t[C + r] = b[C + r] * turn.re - b[r] * turn.im;
  }
  return t;
}

struct BlockKey {
  int row, column, shift;
  auto operator<=>(const BlockKey&) const = default;
};

template <int C>
using SectorMap = std::map<BlockKey, NodeBlock<C>>;

/// Block of two corners of an element. Only the upper triangle of its matrix is used, for both.
template <int C, class Matrix>
NodeBlock<C> corner_block(const Matrix& e, std::size_t i, std::size_t j) {
  NodeBlock<C> b{};
  for (std::size_t c = 0; c < C; ++c)
    for (std::size_t r = 0; r < C; ++r) {
      const std::size_t p = C * i + r, q = C * j + c;
      b[C * c + r] = e(static_cast<int>(std::min(p, q)), static_cast<int>(std::max(p, q)));
    }
  return b;
}

/// Blocks of the rows of sector 0 on the columns of sectors 0 and 1. The coupling with the previous
/// sector is the transpose of the coupling of that sector with this one.
/// @param stiffness (element of the mesh) its matrix, components C i … of corner i
template <int C, class Stiffness>
SectorMap<C> forward_blocks(const std::vector<SectorElement>& elements, const SectorRows& rows,
                            const Stiffness& stiffness) {
  SectorMap<C> blocks;
  for (const SectorElement& c : elements) {
    const auto e = stiffness(c.element);
    for (std::size_t i = 0; i < c.n; ++i)
      for (std::size_t j = 0; j < c.n; ++j) {
        const int row = rows.place[at(c.node[i])], column = rows.place[at(c.node[j])];
        if (row < 0 || column < 0 || c.shift[i] != 0 || c.shift[j] < 0) continue;
        const NodeBlock<C> b = corner_block<C>(e, i, j);
        const NodeBlock<C> t = c.shift[j] == 1 ? turned<C>(b, rows.turn[1]) : b;
        NodeBlock<C>& sum = blocks[{row, column, c.shift[j]}];
        for (std::size_t q = 0; q < sum.size(); ++q) sum[q] += t[q];
      }
  }
  return blocks;
}

template <int C>
SectorBlocks<C> sector_blocks(const SectorMap<C>& forward, const SectorRows& rows) {
  SectorBlocks<C> k;
  k.n_sectors = static_cast<int>(rows.turn.size());
  k.nodes_per_sector = rows.nodes_per_sector;
  k.nodes = rows.nodes;
  k.turn = rows.turn;
  SectorMap<C> all = forward;
  for (const auto& [key, block] : forward) {
    if (key.shift == 1) all[{key.column, key.row, -1}] = transposed<C>(block);
    if (key.shift == 0 && key.row < key.column)
      all[{key.column, key.row, 0}] = transposed<C>(block);
  }
  k.row_start.assign(k.n_local() + 1, 0);
  for (const auto& [key, block] : all) {
    k.entries.push_back({key.column, key.shift, block});
    ++k.row_start[static_cast<std::size_t>(key.row) + 1];
  }
  for (std::size_t a = 0; a < k.n_local(); ++a) k.row_start[a + 1] += k.row_start[a];
  return k;
}

}  // namespace rondo::fem::detail
