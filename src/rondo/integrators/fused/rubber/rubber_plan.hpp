// SPDX-License-Identifier: BSD-3-Clause
/// @file  How the sparse operator lays out elements of rubber (docs/rubber.md, section 4): by
/// material, in the order of their rows, eight a pack; blocks of packs, which are the unit of sums
/// and threads; of every row the corners of the elements around it.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rondo/core/large_array.hpp"
#include "rondo/integrators/fused/kernels/rubber/layout.hpp"
#include "rondo/model/model.hpp"

namespace rondo::dynamics {

/// Packs of one material.
struct RubberBlock {
  std::ptrdiff_t first_pack = 0, last_pack = 0;
  int lanes_of_last = 0;
  std::size_t material = 0;       ///< place in RubberPart::materials
  std::size_t first_history = 0;  ///< where the branches of its first pack are, in doubles
};

struct RubberPlan {
  std::vector<int> element;  ///< (packs, lanes) of RubberPart::cells; repeated where a pack ends
  std::vector<RubberBlock> blocks;
  std::size_t n_packs = 0, n_history = 0;  ///< n_history: doubles of all branches
  // Arrays of kernels::RubberElements and RubberRows.
  LargeArray geometry;
  LargeArrayOf<std::int32_t> node;
  std::vector<std::int64_t> start;
  LargeArrayOf<std::int32_t> corner;
  std::vector<std::vector<kernels::RubberBranch>> branches;  ///< branches of each material
};

/// @param row (n) of each node of the model; -1: clamped, at `zero` then
/// @param n_row_packs packs of rows
[[nodiscard]] RubberPlan make_rubber_plan(const Model& model, std::span<const int> row, int zero,
                                          std::size_t n_row_packs);

}  // namespace rondo::dynamics
