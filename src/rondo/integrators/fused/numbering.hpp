// SPDX-License-Identifier: BSD-3-Clause
/// @file  In which order the rows of the sparse operator stand: neighbours in the mesh near to each
/// other, so that what the product reads of u is in the cache already (docs/performance.md).
#pragma once
#include <span>
#include <vector>

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

}  // namespace rondo::dynamics
