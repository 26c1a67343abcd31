// SPDX-License-Identifier: BSD-3-Clause
/// @file  How the fields of a ring of equal sectors lie in memory, of a disk (cyclic_plan.hpp) and
/// of a wheel in three dimensions (solid/solid_plan.hpp), see docs/performance.md. A row is one
/// local node over sectors; the ring is cut into chunks, each with a halo of its neighbours'
/// sectors. u has two fields, of even and of odd steps: a strip of rows reads u_{n+1} from one and
/// writes u_{n+2} into the other, so that step n + 1 can follow step n in the same pass over
/// memory, behind by the strips that its own couples with.
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

struct CyclicChunkRange {
  int first = 0;  ///< sector of its first column
  int columns = 0;
  std::size_t first_group = 0;  ///< groups of packs, numbered round the ring
  std::size_t n_groups = 0;
};

/// How a ring of sectors is cut.
struct RingCut {
  Halo halo = Halo::ring;
  int depth = 1;  ///< steps in a pass
  std::vector<CyclicChunkRange> chunks;
  std::size_t n_groups = 0;
};

/// The place of a candidate.
struct CyclicPlace {
  int row = 0, sector = 0;
};

struct RingLayout {
  int n_local = 0, n_sectors = 0;
  int components = 2;
  int nodes_per_sector = 0;    ///< of the mesh, held ones too
  std::vector<int> nodes;      ///< (n_local) place of a row's node in its sector
  bool keeps_force = false;    ///< K u_n is a field: β > 0, or a loaded rim
  bool keeps_impulse = false;  ///< r_n of the step before is a field, for a law of friction
  bool stepwise = false;       ///< one step a pass: on a loaded rim, or with a tail
  bool wheel = false;          ///< on a loaded rim: v is V in the axes of R, one step a pass
  int n_sums = 0;              ///< of a group of columns in a step
  int group_columns = 0;       ///< sectors whose sums are added up together
  std::ptrdiff_t stride = 0;   ///< doubles between the components of a row
  std::vector<Complex> frame;  ///< (n_local) axes of a row in those of its sectors; in space
  std::vector<int> needs;  ///< (strips) strip that the step before must have done before strip i
  std::vector<int> contact_row;  ///< (n_local) place in `candidate`; -1: no contact candidates
  std::vector<std::vector<int>> candidate;  ///< (contact rows, N) place in ContactModel::nodes
  std::vector<CyclicPlace> place;           ///< (nb) the reverse of `candidate`
  RingCut cut;

  /// Number of a node in the body.
  [[nodiscard]] std::size_t node(int row, int sector) const noexcept {
    return static_cast<std::size_t>(std::ptrdiff_t{sector} * nodes_per_sector +
                                    nodes[static_cast<std::size_t>(row)]);
  }
  /// Doubles of a node.
  [[nodiscard]] int n_fields() const noexcept {
    return (3 + (keeps_force ? 1 : 0) + (keeps_impulse ? 1 : 0)) * components;
  }
  /// Place of the impulses behind the other fields: the first two components are those of the
  /// first and the second facet that a candidate touches. @pre keeps_impulse
  [[nodiscard]] int field_impulse() const noexcept { return n_fields() - components; }
  [[nodiscard]] std::ptrdiff_t row_size() const noexcept { return n_fields() * stride; }
  [[nodiscard]] std::size_t chunk_size() const noexcept {
    return static_cast<std::size_t>(lead + n_local * row_size() + halo_columns);
  }
  /// Size of the fields of the whole ring.
  [[nodiscard]] std::size_t bytes() const noexcept {
    return static_cast<std::size_t>(n_local) * static_cast<std::size_t>(n_sectors * n_fields()) *
           sizeof(double);
  }
  /// Doubles before sector 0 of a chunk's first field.
  static constexpr std::ptrdiff_t lead = 2 * halo_columns;
  static_assert(lead >= halo_columns && lead % kernels::lanes == 0);  // packs stay aligned
  static_assert(halo_columns == kernels::lanes);  // the halo on the left is pack -1
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

/// Groups round a ring: as many threads have work.
std::size_t n_groups_of(int n_sectors, int group_columns) noexcept;

/// Cuts the ring into chunks for the threads and for the cache, several steps in a pass where the
/// fields are larger than it. @param depth steps of such a pass
void cut_ring(int threads, int depth, const CyclicTuning& tuning, RingLayout& layout);

/// Room for the columns of the widest chunk.
void set_stride(RingLayout& layout) noexcept;

/// (nodes_per_sector) row of each node of a sector; -1 where it is held.
std::vector<int> rows_of_nodes(const RingLayout& layout);

/// Fills contact_row, candidate and place: the candidates must be the same local nodes in every
/// sector.
void find_candidates(const Model& model, RingLayout& layout);

}  // namespace rondo::dynamics
