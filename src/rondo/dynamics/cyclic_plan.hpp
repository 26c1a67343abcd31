// SPDX-License-Identifier: BSD-3-Clause
/// @file  How the cyclic operator lays out a disk and walks over it (docs/performance.md). A row is
/// one local node over sectors; the ring of sectors is cut into chunks, each with a halo of its
/// neighbours' sectors. Within a chunk rows are worked outwards; u of a row is advanced as soon as
/// no row needs its old value, so that step n + 1 can follow a few rows behind step n in the same
/// pass over memory.
#pragma once
#include <cstddef>
#include <vector>

#include "rondo/dynamics/kernels/kernels.hpp"
#include "rondo/dynamics/model.hpp"

namespace rondo::dynamics {

/// Sectors on each side that a chunk has from its neighbours.
enum class Halo {
  ring,    ///< one chunk, its own neighbour: wrapped around as soon as a row is advanced
  narrow,  ///< one sector, taken before each step
  wide,    ///< eight, taken before each pass and advanced with the chunk's own
};

inline constexpr int halo_columns = 8;
inline constexpr int most_steps_in_a_pass = 8;

struct CyclicChunkRange {
  int first = 0;  ///< sector of its first column
  int columns = 0;
  std::size_t first_group = 0;  ///< groups of kernels::group_packs packs, numbered round the ring
  std::size_t n_groups = 0;
};

/// A row's constants, in the sector's frame.
struct CyclicRowData {
  double mass = 0.0;     ///< [kg/m]
  Vec2 reference;        ///< X                                                         [m]
  int contact_row = -1;  ///< place in `candidate`; -1: no contact candidates
};

struct CyclicPlan {
  int n_local = 0, n_sectors = 0;
  int n_fields = 4;           ///< u, v, and with β K u_n: two each
  std::ptrdiff_t stride = 0;  ///< doubles between the fields of a row
  std::vector<CyclicRowData> rows;
  std::vector<kernels::CyclicEntry> entries;
  std::vector<int> entry_start;     ///< (n_local + 1)
  std::vector<int> advanced;        ///< rows in the order in which u may be advanced
  std::vector<int> advanced_start;  ///< (n_local + 1): those that follow row a
  std::vector<int> needs;           ///< row that the step before must have done before row a
  std::vector<std::vector<int>> candidate;  ///< (contact rows, N) place in ContactModel::nodes
  Halo halo = Halo::ring;
  int depth = 1;  ///< steps in a pass
  std::vector<CyclicChunkRange> chunks;
  std::size_t n_groups = 0;

  [[nodiscard]] std::ptrdiff_t row_at(int a) const noexcept { return a * n_fields * stride + lead; }
  [[nodiscard]] std::size_t chunk_size() const noexcept {
    return static_cast<std::size_t>(row_at(n_local) + halo_columns);
  }
  /// Doubles before sector 0 of a chunk's first field.
  static constexpr std::ptrdiff_t lead = 2 * halo_columns;
};

/// @pre model.sector is there. Bits do not depend on how the ring is cut.
CyclicPlan make_cyclic_plan(const Model& model);

}  // namespace rondo::dynamics
