// SPDX-License-Identifier: BSD-3-Clause
/// @file  How the cyclic operator lays out a disk (ring_layout.hpp) and walks over it
/// (docs/performance.md): within a chunk rows are worked outwards in strips of kernels::most_rows.
/// A strip couples on a smooth disk with its neighbours alone.
#pragma once
#include <cstddef>
#include <vector>

#include "rondo/integrators/fused/ring_layout.hpp"

namespace rondo::dynamics {

inline constexpr int most_steps_in_a_pass = 4;
static_assert(most_steps_in_a_pass <= halo_columns);

/// The forces of a load on a row.
struct CyclicLoad {
  int row = 0;
  int load = 0;             ///< place in Model::pressures
  std::vector<Vec2> force;  ///< (N) per pressure, in the sectors' frames             [m]
};

struct CyclicPlan : RingLayout {
  std::vector<kernels::CyclicRow> rows;  ///< (n_local)
  std::vector<kernels::CyclicEntry> entries;
  std::vector<kernels::MirrorRow> mirror;  ///< (n_local), or empty: sectors are no mirrors
  int first_contact_strip = 0, last_contact_strip = -1;
  std::vector<CyclicLoad> loads;  ///< by rows; those of a strip are one after the other
  std::vector<int> load_of;       ///< (loads) CyclicLoad::load

  /// A strip's first load; of the one past the last, loads.size().
  [[nodiscard]] std::size_t first_load(int strip) const noexcept;
};

/// Groups of kernels::group_packs packs round a ring: what it can be cut into.
std::size_t n_cyclic_groups(int n_sectors) noexcept;

/// @pre model.sector, with all free nodes in its rows
CyclicPlan make_cyclic_plan(const Model& model, const CyclicTuning& tuning = {});

}  // namespace rondo::dynamics
