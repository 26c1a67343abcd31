// SPDX-License-Identifier: BSD-3-Clause
/// @file  Small dense matrices by the BLAS and LAPACK, which know the processor. They use as many
/// threads as the caller lets them (core/process_wide.hpp). Products of matrices: svd.hpp.
#pragma once
#include <Eigen/Core>

namespace rondo::pod {

/// y = A x. Allocates nothing. @pre y has A's rows, and is not x
void multiply(const Eigen::MatrixXd& a, const Eigen::VectorXd& x, Eigen::VectorXd& y) noexcept;

/// A⁻¹ by LU. What is singular gives numbers that are not finite.
[[nodiscard]] Eigen::MatrixXd inverse(Eigen::MatrixXd a);

}  // namespace rondo::pod
