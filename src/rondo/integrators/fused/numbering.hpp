// SPDX-License-Identifier: BSD-3-Clause
/// @file  In which order the rows of the sparse operator stand: neighbours in the mesh near to each
/// other, so that what the product reads of u is in the cache already (docs/performance.md).
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "rondo/core/large_array.hpp"
#include "rondo/fem/assembly.hpp"

namespace rondo::dynamics {

/// |i - j| of the blocks (i, j) of K, rows and columns numbered by their places in an order.
struct Bandwidth {
  double mean = 0.0;
  int maximum = 0;
};

/// @param order nodes; all that they couple with are among them.
Bandwidth bandwidth(const fem::BlockCsr& k, std::span<const int> order);

/// The nodes in reverse Cuthill-McKee order: each connected part breadth first from one of its
/// ends, nodes of few neighbours first. Method: George and Liu, ACM Trans. Math. Softw. 5 (1979)
/// 284.
/// @pre as for `bandwidth`; the blocks of K come in pairs (i, j), (j, i).
std::vector<int> reverse_cuthill_mckee(const fem::BlockCsr& k, std::span<const int> nodes);

/// The nodes as given, or in reverse Cuthill-McKee order where that has the lower mean bandwidth.
/// Not the maximum: on a ring numbered sector by sector that is the one seam, which costs nothing.
std::vector<int> row_order(const fem::BlockCsr& k, std::span<const int> nodes);

/// Brings rows of one length in `order` together, long ones first, over a distance that the cache
/// does not feel. @param k whose rows are packed, on the nodes of `order`
void sort_by_length(const fem::BlockCsr& k, std::vector<int>& order);

/// K in packs of eight rows, each as long as its longest: zero blocks on their own row fill the
/// others up. As in kernels::SparseRows.
struct RowPacks {
  std::vector<std::int64_t> start;
  LargeArray blocks;
  LargeArrayOf<std::int32_t> column;
};

/// @param node of each row, the longest of a pack first; -1, or past its end: padding, without
/// blocks. @param row (n) of each node
[[nodiscard]] RowPacks make_row_packs(const fem::BlockCsr& k, std::span<const int> node,
                                      std::size_t n_packs, std::span<const int> row);

}  // namespace rondo::dynamics
