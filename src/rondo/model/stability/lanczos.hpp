// SPDX-License-Identifier: BSD-3-Clause
/// @file  Largest eigenvalue of a symmetric operator by restarted Lanczos (docs/theory.md, 3.8).
#pragma once
#include <Eigen/Core>
#include <functional>
#include <optional>

namespace rondo::dynamics {

struct SymmetricOperator {
  Eigen::Index size = 0;
  std::function<void(const double* x, double* y)> product;  ///< y = A x, both (size)
};

struct RitzPair {
  double value = 0.0;     ///< [1/s²]
  double residual = 0.0;  ///< ‖A x - value x‖ [1/s²]
};

/// Iterates to a relative residual of 1e-3 (docs/decisions/008). Returns nothing if Lanczos does
/// not converge or the numbers are out of range.
std::optional<RitzPair> largest_ritz_pair(const SymmetricOperator& a);

}  // namespace rondo::dynamics
