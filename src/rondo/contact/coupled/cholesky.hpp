// SPDX-License-Identifier: BSD-3-Clause
/// @file  Small dense systems with a positive definite matrix, in memory of the caller. LAPACK has
/// it too; problems here are small, and the solver of contacts allocates nothing.
#pragma once
#include <span>

namespace rondo::contact {

/// Solves A x = b by Cholesky's factors, which replace the lower triangle of A (n, n), by rows; x
/// replaces b (n). @return false: A is not positive definite
[[nodiscard]] bool solve_cholesky(std::span<double> a, std::span<double> b) noexcept;

}  // namespace rondo::contact
