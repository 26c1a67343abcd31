// SPDX-License-Identifier: BSD-3-Clause
/// @file  What the loops over elements of rubber read and write (docs/rubber.md, section 4). Plain
/// pointers and numbers, as in kernels.hpp.
#pragma once
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "rondo/fem/rubber.hpp"
#include "rondo/integrators/fused/kernels/kernels.hpp"

namespace rondo::dynamics::kernels {

/// A viscous branch in the steps of a run.
struct RubberBranch {
  double modulus;  ///< g μ                                                             [Pa]
  double growth;   ///< e^{Δt/(2τ)} - 1
};

/// Sums over the elements of some packs in a step, [J/m] but for `least`.
struct RubberSums {
  double dissipation_before;  ///< dissipation of the branches, in the half step before the force
  double dissipation_after;   ///< in the half step after it
  double energy;              ///< stored at t_{n+1}, in branches too
  double least;               ///< smallest det F at a point                            [-]
};

/// Packs of eight elements of one material.
struct RubberElements {
  const double* geometry;    ///< (packs, 6, lanes) of X: along, across, twist (x, y each)   [m]
  const std::int32_t* node;  ///< (packs, 4, lanes) where a corner's pair is in u
  const double* now;         ///< (nodes, 2) u_{n+1}                                         [m]
  double* force;             ///< (packs, 4, lanes, 2) derivative of the energy by the corners [N/m]
  double* history;           ///< (packs, branches, 3, lanes) of C_i: xx, yy, xy; advanced
  std::ptrdiff_t n_packs;
  int lanes_of_last;  ///< elements of the last pack; those after it are repeated, and not counted
  const fem::Rubber* rubber;
  double shear;  ///< μ of small strain                                                      [Pa]
  const RubberBranch* branches;
  int n_branches;
  RubberSums* sums;  ///< sums of these packs, which the kernel sets
};

/// Places of the forces of the elements on a row: every row has as many as the most of its
/// pack; those left over hold zeros.
struct RubberRows {
  const std::int64_t* start;   ///< (packs + 1) first place of a pack
  const std::int32_t* corner;  ///< (places, lanes) where a pair is in `force`
  const double* force;         ///< RubberElements::force
};

static_assert(std::is_trivial_v<RubberBranch> && std::is_trivial_v<RubberSums> &&
              std::is_trivial_v<RubberElements> && std::is_trivial_v<RubberRows>);

/// The loops of one instruction set for rubber.
struct RubberTable {
  /// [one_point][law], the law as RubberLaw
  void (*elements[2][4])(const RubberElements&) noexcept;
  /// As Table::sparse_rows and WheelTable::rows, with the forces of the elements beside those of K.
  /// sum_strain is v̂·f, sum_internal v⁻·f; wheel_strain is d·f_n.
  void (*rows[2][2][2])(const SparseRows&) noexcept;
  void (*wheel_rows[2])(const SparseRows&) noexcept;
};

extern const RubberTable avx512_rubber, avx2_rubber, baseline_rubber;

}  // namespace rondo::dynamics::kernels
