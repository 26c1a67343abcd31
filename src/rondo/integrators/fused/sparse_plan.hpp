// SPDX-License-Identifier: BSD-3-Clause
/// @file  How the sparse operator lays out a body (docs/performance.md): the free nodes in an order
/// of its own, in packs of eight rows; K in the same order; blocks of packs, which are the unit of
/// sums, contact and threads.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "rondo/core/large_array.hpp"
#include "rondo/integrators/fused/kernels/kernels.hpp"
#include "rondo/integrators/fused/numbering.hpp"
#include "rondo/model/model.hpp"

namespace rondo::dynamics {

/// A contact candidate and its row.
struct SparseCandidate {
  Vec2 reference;  ///< X [m]
  int row = 0;
  int candidate = 0;  ///< place in ContactModel::nodes
};

struct SparsePlan {
  bool keeps_force = false;  ///< K u_n is kept: β > 0, or a loaded rim
  bool wheel = false;        ///< on a loaded rim
  std::vector<int> node;     ///< (rows) node of the model; what fills up the last pack has none
  std::size_t n_packs = 0;
  std::size_t n_blocks = 1;
  RowPacks matrix;
  LargeArray constants;  ///< constants of the rows, see kernels::SparseRows
  // Loads on nodes; empty: there are none.
  std::vector<int> first_load, load_of;
  LargeArray loads;
  std::vector<SparseCandidate> candidates;   ///< ascending rows
  std::vector<int> row;                      ///< (nb) of each candidate of the model
  std::vector<int> row_of_node;              ///< (n) -1: clamped; with elements of rubber alone
  std::vector<std::size_t> first_candidate;  ///< (n_blocks + 1) of each block; empty: no contact

  /// The first pack of a block; of the one past the last, n_packs.
  [[nodiscard]] std::size_t first_pack(std::size_t block) const noexcept {
    return n_packs * block / n_blocks;
  }
  /// Doubles of a pack in kernels::SparseRows::motion.
  [[nodiscard]] std::size_t motion_size() const noexcept {
    return std::size_t{keeps_force ? 4U : 2U} * kernels::lanes;
  }
};

/// Blocks that so many rows are cut into.
std::size_t n_sparse_blocks(std::size_t n_rows) noexcept;

/// @pre model.stiffness is there. Does not depend on model.threads.
SparsePlan make_sparse_plan(const Model& model);

}  // namespace rondo::dynamics
