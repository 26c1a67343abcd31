// SPDX-License-Identifier: BSD-3-Clause
/// @file  Decompositions of dense matrices, compiled once: their templates take seconds in every
/// file that names them. By Eigen; the singular values by LAPACK.
#pragma once
#include <Eigen/Core>

namespace rondo {

/// x of a x = b, by LU with partial pivoting. @pre `a` is square and not singular
[[nodiscard]] Eigen::VectorXd solve(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);
[[nodiscard]] Eigen::VectorXcd solve(const Eigen::MatrixXcd& a, const Eigen::VectorXcd& b);
[[nodiscard]] Eigen::MatrixXcd solve(const Eigen::MatrixXcd& a, const Eigen::MatrixXcd& b);

/// Solves a x = b by Cholesky's factors. @pre `a` is positive definite; its lower triangle is read
[[nodiscard]] Eigen::MatrixXd solve_definite(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);
[[nodiscard]] Eigen::MatrixXcd solve_definite(const Eigen::MatrixXcd& a, const Eigen::MatrixXcd& b);

/// Eigenvalues, ascending, and orthonormal eigenvectors, one a column.
template <class Matrix>
struct Axes {
  Eigen::VectorXd values;
  Matrix vectors;
};
/// Decomposes a symmetric or Hermitian matrix, whose lower triangle it reads.
[[nodiscard]] Axes<Eigen::MatrixXd> axes_of(const Eigen::MatrixXd& a);
[[nodiscard]] Axes<Eigen::MatrixXcd> axes_of(const Eigen::MatrixXcd& a);
/// Finds the eigenvalues alone.
[[nodiscard]] Eigen::VectorXd eigenvalues_of(const Eigen::MatrixXd& a);
[[nodiscard]] Eigen::VectorXd eigenvalues_of(const Eigen::MatrixXcd& a);

struct Svd {
  Eigen::VectorXd sigma;  ///< (k) descending
  Eigen::MatrixXd u;      ///< (rows, k)
  Eigen::MatrixXd v;      ///< (columns, k)
};
/// Thin SVD by gesdd: errors of sigma are a few ε σ_1. Destroys `a`. @pre all numbers are finite
[[nodiscard]] Svd thin_svd(Eigen::MatrixXd& a);

}  // namespace rondo
