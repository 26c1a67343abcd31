// SPDX-License-Identifier: BSD-3-Clause
/// @file  How the cyclic operator lays out a disk and walks over it (docs/performance.md). A row is
/// one local node over sectors; the ring of sectors is cut into chunks, each with a halo of its
/// neighbours' sectors. Within a chunk rows are worked outwards in strips of kernels::most_rows. u
/// has two fields, of even and of odd steps: a strip reads u_{n+1} from one and writes u_{n+2} into
/// the other, so that step n + 1 can follow step n in the same pass over memory, behind by the
/// strips that its own couples with: on a smooth disk one.
#pragma once
#include <cstddef>
#include <vector>

#include "rondo/integrators/fused/kernels/kernels.hpp"
#include "rondo/model/model.hpp"

namespace rondo::dynamics {

/// Sectors on each side that a chunk has from its neighbours.
enum class Halo {
  ring,    ///< one chunk, its own neighbour: wrapped around as soon as a row is advanced
  narrow,  ///< one sector, taken before each step
  wide,    ///< eight, taken before each pass and advanced with the chunk's own
};

inline constexpr int halo_columns = 8;
inline constexpr int most_steps_in_a_pass = 4;
static_assert(most_steps_in_a_pass <= halo_columns);

struct CyclicChunkRange {
  int first = 0;  ///< sector of its first column
  int columns = 0;
  std::size_t first_group = 0;  ///< groups of kernels::group_packs packs, numbered round the ring
  std::size_t n_groups = 0;
};

/// How a ring of sectors is cut.
struct RingCut {
  Halo halo = Halo::ring;
  int depth = 1;  ///< steps in a pass
  std::vector<CyclicChunkRange> chunks;
  std::size_t n_groups = 0;
};

/// The forces of a load on a row.
struct CyclicLoad {
  int row = 0;
  int load = 0;             ///< place in Model::pressures
  std::vector<Vec2> force;  ///< (N) per pressure, in the sectors' frames             [m]
};

/// The place of a candidate.
struct CyclicPlace {
  int row = 0, sector = 0;
};

struct CyclicPlan {
  int n_local = 0, n_sectors = 0;
  bool keeps_force = false;   ///< K u_n is a field: β > 0, or a loaded rim
  bool stepwise = false;      ///< one step a pass: on a loaded rim, or with a tail
  bool wheel = false;         ///< on a loaded rim: v is V in the axes of R, one step a pass
  std::ptrdiff_t stride = 0;  ///< doubles between the fields of a row
  std::vector<kernels::CyclicRow> rows;  ///< (n_local)
  std::vector<kernels::CyclicEntry> entries;
  std::vector<kernels::MirrorRow> mirror;  ///< (n_local), or empty: sectors are no mirrors
  std::vector<int> needs;        ///< strip that the step before must have done before strip i
  std::vector<int> contact_row;  ///< (n_local) place in `candidate`; -1: no contact candidates
  std::vector<std::vector<int>> candidate;  ///< (contact rows, N) place in ContactModel::nodes
  std::vector<CyclicPlace> place;           ///< (nb) the reverse
  int first_contact_strip = 0, last_contact_strip = -1;
  std::vector<CyclicLoad> loads;  ///< by rows; those of a strip are one after the other
  std::vector<int> load_of;       ///< (loads) CyclicLoad::load
  Halo halo = Halo::ring;
  int depth = 1;  ///< steps in a pass
  std::vector<CyclicChunkRange> chunks;
  std::size_t n_groups = 0;

  [[nodiscard]] int n_fields() const noexcept { return keeps_force ? 8 : 6; }
  [[nodiscard]] std::ptrdiff_t row_size() const noexcept { return n_fields() * stride; }
  [[nodiscard]] std::size_t chunk_size() const noexcept {
    return static_cast<std::size_t>(lead + n_local * row_size() + halo_columns);
  }
  /// Rows that are worked on together: this one and those above it, up to most_rows.
  [[nodiscard]] int n_strips() const noexcept {
    return (n_local + kernels::most_rows - 1) / kernels::most_rows;
  }
  [[nodiscard]] int n_sums() const noexcept {
    return wheel ? int{kernels::n_wheel_sums} : int{kernels::n_sums};
  }
  /// A strip's first load; of the one past the last, loads.size().
  [[nodiscard]] std::size_t first_load(int strip) const noexcept;
  /// Doubles before sector 0 of a chunk's first field.
  static constexpr std::ptrdiff_t lead = 2 * halo_columns;
  static_assert(lead >= halo_columns && lead % kernels::lanes == 0);  // packs stay aligned
};

/// Sizes that the cut is fitted to. The bits of the results do not depend on them.
struct CyclicTuning {
  /// Fields below this stay in the cache of a core from step to step: no passes of several steps.
  std::size_t cache_bytes = 1'200'000;
  /// Columns of a chunk that several steps pass over: its rows stay in the cache, its halo is
  /// small.
  int chunk_columns = 768;
  /// A halo of eight columns is advanced along where no chunk is narrower than this.
  int wide_halo_columns = 16 * halo_columns;
};

/// Groups of kernels::group_packs packs round a ring: what it can be cut into.
std::size_t n_cyclic_groups(int n_sectors) noexcept;

/// Chunks for the threads and for the cache; many steps in a pass where the fields, of `bytes`, are
/// larger than it. @param columns_of_group of the groups, which chunks are made of
/// @param stepwise one step a pass, whatever their size
RingCut cut_ring(int n_sectors, int columns_of_group, std::size_t bytes, bool stepwise, int threads,
                 const CyclicTuning& tuning);

/// Doubles between the fields of a row of the widest chunk.
std::ptrdiff_t cyclic_stride(const std::vector<CyclicChunkRange>& chunks) noexcept;

/// @pre model.sector, with all free nodes in its rows
CyclicPlan make_cyclic_plan(const Model& model, const CyclicTuning& tuning = {});

}  // namespace rondo::dynamics
