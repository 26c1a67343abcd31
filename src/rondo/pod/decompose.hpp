// SPDX-License-Identifier: BSD-3-Clause
/// @file  Thin singular value decomposition of snapshots, in memory or streamed (docs/theory.md,
/// 7.2): A = U Σ Vᵀ.
#pragma once
#include <cstddef>
#include <functional>

#include "rondo/pod/snapshots.hpp"

namespace rondo::pod {

enum class Method {
  automatic,    ///< the first of the following that fits into the allowed memory
  direct,       ///< all snapshots in memory: QR first if tall (LQ if wide), LAPACK's gesdd
  tsqr,         ///< QR by blocks, exact: memory (shorter side)² plus one block
  incremental,  ///< block by block, truncated, with a tracked error bound
};

struct DecomposeOptions {
  Method method = Method::automatic;
  std::size_t memory = 2'000'000'000;  ///< allowed [B]
  Index modes = -1;         ///< requested; -1: as many as leave `default_discarded` of the energy,
                            ///<     if they fit into the memory (DecomposePlan::modes)
  double tolerance = 1e-8;  ///< incremental: target of the bound, relative to the norm of A
  std::function<void(long long, long long)> progress;  ///< done, total; may be empty
};

/// Share of the energy outside the modes that are kept by default.
inline constexpr double default_discarded = 1e-6;

/// Largest shorter side for direct and tsqr: beyond it LAPACK's work space exceeds its integers.
inline constexpr Index largest_side = 26000;

/// Expected cost of a decomposition.
struct DecomposePlan {
  Method method = Method::direct;  ///< the chosen one
  Index block = 0;                 ///< rows (tsqr with more rows than columns) or columns per block
  Index modes = 0;                 ///< largest number kept: requested, or what fits
  std::size_t memory = 0;          ///< estimate for the arrays (the libraries add some 8 MB) [B];
                           ///<     above the allowed memory: no method fits, this needs least
  double flops = 0.0;  ///< estimate
};

/// @pre the shorter side is at most largest_side if direct or tsqr is requested
[[nodiscard]] DecomposePlan plan(Index rows, Index columns, Index row_grain,
                                 const DecomposeOptions& options);

/// Singular values up to max(rows, columns) ε σ_1 are round-off.
[[nodiscard]] double round_off(Index rows, Index columns, double largest);

struct Decomposition {
  Method method = Method::direct;
  Eigen::VectorXd sigma;     ///< (k) singular values, descending
  Eigen::MatrixXd modes;     ///< (rows, r) U: orthonormal columns, r <= rank
  Eigen::MatrixXd temporal;  ///< (columns, k) V: orthonormal columns. After tsqr of fewer rows than
                             ///<     columns only those that fit in memory, at most `rank`
  double energy = 0.0;       ///< ‖A‖² (Frobenius)
  double lost_energy = 0.0;  ///< ‖A‖² - Σσ² of the truncated part; 0 unless incremental
  double sigma_bound = 0.0;  ///< 0 <= true σ_i - sigma[i] <= this, apart from round-off
  Index rank = 0;            ///< number of σ above round_off()
};

/// @pre every number read is finite. The largest number of each mode is made positive.
[[nodiscard]] Decomposition decompose(SnapshotMatrix& snapshots, const DecomposeOptions& options);

/// Makes the largest number of each mode positive and changes its column of V accordingly.
void fix_signs(Decomposition& d);

}  // namespace rondo::pod
