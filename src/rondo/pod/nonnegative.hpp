// SPDX-License-Identifier: BSD-3-Clause
/// @file  A non-negative matrix as the product of two smaller ones, A ≈ W H: few patterns of which
/// all columns are sums without a minus sign (docs/reduced.md, 11).
#pragma once
#include <Eigen/Core>
#include <vector>

namespace rondo::pod {

struct NonnegativeLimits {
  int most_sweeps = 1000;
  double change = 1e-5;  ///< of the residual in a sweep, over the residual: less ends the sweeps
  double held = 1e-6;    ///< a column of A held to this share of ‖A‖ starts no pattern
};

/// k patterns, as many as were asked for or fewer: none is zero or without a part in A.
struct NonnegativeFactors {
  Eigen::MatrixXd w;              ///< (m, k) >= 0, columns of sum 1
  Eigen::MatrixXd h;              ///< (k, n) >= 0
  std::vector<double> residuals;  ///< ‖A - W H‖ / ‖A‖ at the start and after each sweep, falling
  [[nodiscard]] double residual() const noexcept { return residuals.back(); }
  [[nodiscard]] int sweeps() const noexcept { return static_cast<int>(residuals.size()) - 1; }
};

/// Start: columns of A, each the one that those before it hold worst (cone-projected greedy:
/// Benaceur, Ern, Ehrlacher, IJNME 121 (2020) 1170-1197). Then sweeps of hierarchical alternating
/// least squares (Cichocki, Phan, IEICE Trans. Fundamentals E92-A (2009) 708-721): each column of
/// W and row of H in turn takes its best value with all others fixed, so the residual never grows.
/// One thread, no random numbers: the same bits every time.
/// @param a (m, n) finite, >= 0 @pre k >= 1
[[nodiscard]] NonnegativeFactors factor_nonnegative(const Eigen::MatrixXd& a, Eigen::Index k,
                                                    const NonnegativeLimits& limits = {});

}  // namespace rondo::pod
