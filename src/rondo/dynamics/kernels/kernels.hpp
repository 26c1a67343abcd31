// SPDX-License-Identifier: BSD-3-Clause
/// @file  The inner loops of a step, compiled once for each instruction set (docs/performance.md).
/// Plain pointers and numbers only: a file compiled for AVX-512 must not hold an inline function
/// that the linker could hand to a machine without it.
#pragma once
#include <cstddef>

namespace rondo::dynamics::kernels {

/// Columns are worked on in packs of eight at every level, so that sums have the same order.
inline constexpr int lanes = 8;
/// Packs whose sums are added up together.
inline constexpr int group_packs = 4;

/// Sums over the nodes of a step, before the factors of (5.1) and (5.3); v̂ = v⁻ + v⁺.
enum Sum {
  sum_kinetic,    ///< m |v⁻|²
  sum_strain,     ///< u_{n+1}·K u_n
  sum_frame,      ///< m v̂·Δt[(ṡJ - s²)(X + u) + Rᵀ(c̈ - g)]
  sum_mass,       ///< m |v̂|²;  as printed m v̂·v⁻
  sum_stiffness,  ///< v̂·(K u_{n+1} - K u_n)
  sum_scheme,     ///< as printed only: m v̂·J v⁻
  n_sums
};

/// What all nodes of a step share. Complex numbers as (x, y).
struct StepFactors {
  double dt;                    ///< Δt [s]
  double rate_x, rate_y;        ///< Δt (ṡJ - s²)                                     [1/s]
  double pull_x, pull_y;        ///< Δt Rᵀ(c̈ - g)                                     [m/s]
  double inverse_x, inverse_y;  ///< 1/a
  double drag_x, drag_y;        ///< of the velocity update (3.5), (3.6)
  double beta_over_dt;          ///< β/Δt [-]
};

/// Which terms a step has.
struct Terms {
  bool stiffness_damping = false;  ///< β > 0: K u_n is kept
  bool printed = false;            ///< the scheme as printed
  bool pull = false;               ///< some pull is not zero
};

/// One 2×2 block of a row, column-major, and where its vectors are: number of doubles from the
/// chunk's base to the column's u_r of sector 0 of the chunk, the shift included.
struct CyclicEntry {
  std::ptrdiff_t at;
  double k[4];
};

/// One local node over the sectors of a chunk: product, velocity update and sums in one pass. The
/// fields of a row are u_r, u_t, v_r, v_t and, with β, (K u_n)_r, (K u_n)_t, `stride` apart.
struct CyclicRow {
  double* base;
  std::ptrdiff_t at;      ///< u_r of this row, sector 0 of the chunk
  std::ptrdiff_t stride;  ///< between fields
  const CyclicEntry* entries;
  int n_entries;
  double mass;           ///< m                                                          [kg/m]
  double dt_over_mass;   ///< Δt/m
  double x, y;           ///< X in the sector's frame                                     [m]
  const double* turn_x;  ///< cos φ of the chunk's sectors (padded like a field)
  const double* turn_y;  ///< sin φ
  int first_pack;        ///< 0, or -1 where the halo is advanced too
  int last_pack;         ///< one past the last pack
  int columns;           ///< sectors of the chunk's own: the sums are over these
  bool keep_tail;        ///< lanes past `columns` in the last own pack stay as they are
  const StepFactors* step;
  double* sums;  ///< (groups, n_sums, lanes): added to
};

/// Sectors of a row that may touch: y of the node <= limit.
struct CyclicHeight {
  const double* u;  ///< u_r of sector 0 of the chunk; u_t is `stride` on
  std::ptrdiff_t stride;
  double x, y;           ///< X in the sector's frame                          [m]
  const double* turn_x;  ///< cos φ, sin φ of the sectors
  const double* turn_y;
  double rotation_x, rotation_y;  ///< R(θ_{n+1})
  double limit;                   ///< top of the ground - y of the centre              [m]
  int first, last;                ///< columns looked at
};

/// The loops of one instruction set.
struct Table {
  const char* name;
  /// [stiffness_damping][printed][pull]
  void (*cyclic_row[2][2][2])(const CyclicRow&) noexcept;
  /// u += Δt v over packs [first, last); u is u_r of sector 0 of the chunk.
  void (*advance_row)(double* u, std::ptrdiff_t stride, double dt, int first_pack,
                      int last_pack) noexcept;
  /// Columns that are low enough, ascending; returns how many.
  int (*low_columns)(const CyclicHeight&, int* columns) noexcept;
};

extern const Table avx512_table, avx2_table, baseline_table;

}  // namespace rondo::dynamics::kernels
