// SPDX-License-Identifier: BSD-3-Clause
/// @file  How the cyclic operator lays out a wheel in three dimensions (ring_layout.hpp) and walks
/// over it: in strips of rows that couple with the same nodes (docs/performance.md).
#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "rondo/integrators/fused/ring_layout.hpp"
#include "rondo/integrators/fused/solid/solid_faces.hpp"
#include "rondo/integrators/fused/solid/solid_order.hpp"
#include "rondo/integrators/fused/solid/solid_rows.hpp"
#include "rondo/integrators/fused/solid/solid_rubber.hpp"

namespace rondo::dynamics {

/// Rows that are worked on together, one after the other.
struct SolidPlanStrip {
  int first = 0;  ///< row
  int n_rows = 0;
  kernels::SolidKind kind = kernels::SolidKind::general;
  std::size_t first_entry = 0, n_entries = 0;
  std::size_t first_block = 0;  ///< in SolidPlan::numbers
};

struct SolidPlan : RingLayout {
  OrderedSector ordered;
  SolidStiffness stiffness;
  std::vector<kernels::SolidRow> rows;  ///< (n_local)
  std::vector<kernels::SolidEntry> entries;
  std::vector<double> numbers;  ///< blocks of the entries, strip by strip
  std::vector<SolidPlanStrip> strips;
  /// (pressures, n_local) force per pressure of each row, in its frame; nothing: no pressure  [m²]
  std::vector<std::vector<Vec3>> loads;
  std::optional<SolidFacesPlan> faces;    ///< cords and air that are nonlinear
  double energy_of_state = 0.0;           ///< of the faces of a sector [J]
  std::optional<SolidRubberPlan> rubber;  ///< that is nonlinear
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

/// Forces and energy of the faces in the state, by the loops of the steps; none: nothing.
void set_state_of_faces(const kernels::SolidTable& table, SolidPlan& plan);

/// Without what set_state_of_faces() sets. @pre model.solid is there.
SolidPlan make_solid_plan(const Model& model, const SolidTuning& tuning = {});

}  // namespace rondo::dynamics
