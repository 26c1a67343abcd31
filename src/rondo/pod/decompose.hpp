// SPDX-License-Identifier: BSD-3-Clause
/// @file  Thin singular value decomposition of snapshots, in memory or streamed (docs/theory.md,
/// 7.2): A = U Σ Vᵀ.
#pragma once
#include <cstddef>
#include <functional>

#include "rondo/pod/snapshots.hpp"

namespace rondo::pod {

enum class Method {
  automatic,    ///< the first of the following that fits in the memory allowed
  direct,       ///< all snapshots in memory: QR first where tall (LQ where wide), LAPACK's gesdd
  tsqr,         ///< QR by blocks, exact: memory (shorter side)² besides a block
  incremental,  ///< block by block, truncated, with a tracked bound of the error
};

struct DecomposeOptions {
  Method method = Method::automatic;
  std::size_t memory = 2'000'000'000;  ///< allowed [B]
  Index modes = -1;         ///< asked for; -1: as many as leave `default_discarded` of the energy,
                            ///<     if they fit in the memory (DecomposePlan::modes)
  double tolerance = 1e-8;  ///< incremental: bound aimed at, over the norm of A
  std::function<void(long long, long long)> progress;  ///< done, of all; may be empty
};

/// Energy that the modes kept without being asked for leave out.
inline constexpr double default_discarded = 1e-6;

/// Longest shorter side of direct and tsqr: beyond it LAPACK's work space passes its integers.
inline constexpr Index largest_side = 26000;

/// What a decomposition would take.
struct DecomposePlan {
  Method method = Method::direct;  ///< chosen
  Index block = 0;         ///< rows (tsqr of more rows than columns) or columns read at once
  Index modes = 0;         ///< most that are kept: asked for, or what fits
  std::size_t memory = 0;  ///< estimated, of the arrays (the libraries take some 8 MB besides) [B];
                           ///<     above what is allowed: no method fits, this one takes least
  double flops = 0.0;      ///< estimated
};

/// @pre the shorter side is at most largest_side where direct or tsqr is asked for
[[nodiscard]] DecomposePlan plan(Index rows, Index columns, Index row_grain,
                                 const DecomposeOptions& options);

/// Singular values not above this, max(rows, columns) ε σ_1, are round-off.
[[nodiscard]] double round_off(Index rows, Index columns, double largest);

struct Decomposition {
  Method method = Method::direct;
  Eigen::VectorXd sigma;     ///< (k) singular values, falling
  Eigen::MatrixXd modes;     ///< (rows, r) U: orthonormal columns, r <= rank
  Eigen::MatrixXd temporal;  ///< (columns, k) V: orthonormal columns. After tsqr of fewer rows than
                             ///<     columns only those that fit in memory, of at most `rank`
  double energy = 0.0;       ///< ‖A‖² (Frobenius)
  double lost_energy = 0.0;  ///< ‖A‖² - Σσ² of what was truncated; 0 unless incremental
  double sigma_bound = 0.0;  ///< 0 <= true σ_i - sigma[i] <= this, beside round-off
  Index rank = 0;            ///< σ above round_off()
};

/// @pre every number read is finite. The sign of a mode makes its largest number positive.
[[nodiscard]] Decomposition decompose(SnapshotMatrix& snapshots, const DecomposeOptions& options);

/// Makes the largest number of each mode positive, its column of V with it.
void fix_signs(Decomposition& d);

}  // namespace rondo::pod
