// SPDX-License-Identifier: BSD-3-Clause
/// @file  Products of small dense matrices by BLAS and LAPACK, which adapt to the processor. They
/// use as many threads as the caller allows (core/process_wide.hpp). Other products: svd.hpp.
#pragma once
#include <Eigen/Core>

namespace rondo::pod {

/// y = A x. Allocates nothing. @pre y has A's rows, and is not x
void multiply(const Eigen::MatrixXd& a, const Eigen::VectorXd& x, Eigen::VectorXd& y) noexcept;

/// A⁻¹ by LU. A singular matrix gives numbers that are not finite.
[[nodiscard]] Eigen::MatrixXd inverse(Eigen::MatrixXd a);

}  // namespace rondo::pod
