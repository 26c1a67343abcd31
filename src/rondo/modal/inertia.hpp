// SPDX-License-Identifier: BSD-3-Clause
/// @file  Number of negative eigenvalues of a sparse Hermitian matrix, by Sylvester's law from the
/// pivots of L D Lᴴ (docs/theory.md, 8.4).
#pragma once
#include <Eigen/SparseCore>
#include <complex>
#include <optional>

namespace rondo::modal {

/// @param lower triangle of the matrix. Returns nothing if a pivot is zero: the matrix or a leading
/// part of it is singular.
template <class Scalar>
std::optional<int> negative_eigenvalues(const Eigen::SparseMatrix<Scalar>& lower);

extern template std::optional<int> negative_eigenvalues(const Eigen::SparseMatrix<double>&);
extern template std::optional<int> negative_eigenvalues(
    const Eigen::SparseMatrix<std::complex<double>>&);

}  // namespace rondo::modal
