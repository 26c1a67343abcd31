// SPDX-License-Identifier: BSD-3-Clause
/// @file  How the step of several bodies lays them out: the free nodes in groups that move in one
/// frame, whole packs of eight rows each; K in the same order; blocks of packs, which are the unit
/// of sums and threads.
#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include "rondo/core/large_array.hpp"
#include "rondo/integrators/bodies/kernels/kernels.hpp"
#include "rondo/integrators/fused/numbering.hpp"
#include "rondo/model/model.hpp"

namespace rondo::dynamics {

/// The nodes of a free body, or all that are held.
struct BodyGroup {
  int body = -1;  ///< place in Model::free_bodies, -1: held
  std::size_t first_pack = 0, last_pack = 0;
  std::size_t first_block = 0, last_block = 0;
  // Members of a free body, with arm = X - X_c:
  double mass = 0.0;     ///< [kg/m]
  Vec2 center;           ///< X_c                                                        [m]
  Vec2 offset;           ///< Σ m arm, nonzero by round-off                              [kg]
  double inertia = 0.0;  ///< Σ m |arm|²                                                 [kg m]

  [[nodiscard]] bool held() const noexcept { return body < 0; }
};

/// Some packs of a group.
struct RowBlock {
  std::size_t group = 0, first_pack = 0, last_pack = 0;
};

struct BodyPlan {
  std::vector<BodyGroup> groups;  ///< held nodes first, then by free body
  std::vector<RowBlock> blocks;   ///< ascending packs
  std::vector<int> node;          ///< (packs·lanes) node of the model of each row; -1: padding
  std::vector<int> row;           ///< (n) of each node; -1: clamped
  std::size_t n_packs = 0;
  RowPacks matrix;
  LargeArray constants;  ///< constants of the rows, see kernels::BodyFields

  /// Place of the first number of a row in `motion` or `constants`: four a row, lanes apart.
  [[nodiscard]] static std::size_t at(int at_row) noexcept {
    const auto i = static_cast<std::size_t>(at_row);
    return i / kernels::lanes * 4 * kernels::lanes + i % kernels::lanes;
  }
  [[nodiscard]] std::size_t group_of(int at_row) const noexcept;
};

/// @pre model.stiffness is there. Does not depend on model.threads.
BodyPlan make_body_plan(const Model& model);

}  // namespace rondo::dynamics
