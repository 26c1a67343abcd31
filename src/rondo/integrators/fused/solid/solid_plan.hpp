// SPDX-License-Identifier: BSD-3-Clause
/// @file  How the cyclic operator lays out a wheel in three dimensions and walks over it: as
/// cyclic_plan.hpp has a disk, with three components, and strips of rows that couple with the same
/// nodes (docs/performance.md).
#pragma once
#include <cstddef>
#include <vector>

#include "rondo/integrators/fused/cyclic_plan.hpp"
#include "rondo/integrators/fused/solid/solid_order.hpp"
#include "rondo/integrators/fused/solid/solid_rows.hpp"

namespace rondo::dynamics {

/// Rows that are worked on together, one after the other.
struct SolidPlanStrip {
  int first = 0;  ///< row
  int n_rows = 0;
  kernels::SolidKind kind = kernels::SolidKind::general;
  std::size_t first_entry = 0, n_entries = 0;
  std::size_t first_block = 0;  ///< in SolidPlan::numbers
  int needs = 0;                ///< strip that the step before must have done before this one
};

struct SolidPlan {
  int n_local = 0, n_sectors = 0;
  bool keeps_force = false;   ///< K u_n is a field: β > 0
  std::ptrdiff_t stride = 0;  ///< doubles between the fields of a row
  OrderedSector ordered;
  SolidStiffness stiffness;
  std::vector<kernels::SolidRow> rows;  ///< (n_local)
  std::vector<kernels::SolidEntry> entries;
  std::vector<double> numbers;  ///< blocks of the entries, strip by strip
  std::vector<SolidPlanStrip> strips;
  std::vector<int> contact_row;             ///< (n_local) place in `candidate`; -1: no candidates
  std::vector<std::vector<int>> candidate;  ///< (contact rows, N) place in ContactModel::nodes
  /// (pressures, n_local) force per pressure of each row, in its frame; nothing: no pressure  [m²]
  std::vector<std::vector<Vec3>> loads;
  RingCut cut;

  [[nodiscard]] int n_fields() const noexcept { return keeps_force ? 12 : 9; }
  [[nodiscard]] std::ptrdiff_t row_size() const noexcept { return n_fields() * stride; }
  [[nodiscard]] std::size_t chunk_size() const noexcept {
    return static_cast<std::size_t>(CyclicPlan::lead + n_local * row_size() + halo_columns);
  }
};

/// More than of a disk: a wheel has more rows between two steps of a pass, and more bytes a node.
inline constexpr int solid_steps_in_a_pass = 8;
static_assert(solid_steps_in_a_pass <= halo_columns);

/// Sizes that the cut is fitted to. The bits of the results do not depend on them.
struct SolidTuning {
  /// Fields below this stay in the cache of a core from step to step: no passes of several steps.
  std::size_t cache_bytes = 1'200'000;
  /// Bytes of a chunk that the steps of a pass have in hand.
  std::size_t pass_bytes = 3'750'000;
  int fewest_columns = 128;  ///< fewest columns of a chunk that several steps pass over
  /// A halo of eight columns is advanced along where no chunk is narrower than this.
  int wide_halo_columns = 96;
};

/// Sectors of a group: what chunks are made of, and sums are added up over.
inline constexpr int solid_group_columns = kernels::solid_packs * kernels::lanes;

/// Groups round a ring: as many threads have work.
std::size_t n_solid_groups(int n_sectors) noexcept;

/// @pre model.solid is there.
SolidPlan make_solid_plan(const Model& model, const SolidTuning& tuning = {});

}  // namespace rondo::dynamics
