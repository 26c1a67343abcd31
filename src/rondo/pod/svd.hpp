// SPDX-License-Identifier: BSD-3-Clause
/// @file  The dense algebra of the decompositions by OpenBLAS and LAPACK: products and Householder
/// QR. Used by this module and by the reduced steps.
#pragma once
#include <Eigen/Core>

#include "rondo/core/dense.hpp"

namespace rondo::pod {

using Eigen::Index;
/// Matrices and blocks of matrices with contiguous columns.
using In = Eigen::Ref<const Eigen::MatrixXd>;
using Out = Eigen::Ref<Eigen::MatrixXd>;

/// c = scale · c + factor · a b
void multiply(const In& a, const In& b, Out c, double factor = 1.0, double scale = 0.0);
/// c = aᵀ b
void multiply_transposed(const In& a, const In& b, Out c);
/// m ← m t, in place: t has at most as many columns as m, and the result fills the first of m's.
void multiply_in_place(Out m, const In& t);

/// Q R in place: R in the upper triangle, the reflectors of Q below it. @return factors of these
[[nodiscard]] Eigen::VectorXd factor_qr(Out a);
/// The upper triangle (or trapezium) in the result of factor_qr.
[[nodiscard]] Eigen::MatrixXd upper(const In& factored);
/// Replaces the reflectors by the first min(rows, columns) columns of Q.
void form_q(Out factored, const Eigen::VectorXd& factors);
/// c ← Q c
void apply_q(const In& factored, const Eigen::VectorXd& factors, Out c);
/// L Q in place: that of the transpose of factor_qr.
[[nodiscard]] Eigen::VectorXd factor_lq(Out a);
/// c ← Qᵀ c with the Q of factor_lq
void apply_lq_transposed(const In& factored, const Eigen::VectorXd& factors, Out c);

/// Makes the columns orthonormal, one after another: the first r span what the first r of `a` span,
/// and each points to the side of the column it replaces. @pre rows >= columns
void orthonormalise(Out a);
/// max |aᵀa - I|
[[nodiscard]] double orthonormality(const In& a);

/// R of a matrix whose rows come in blocks: R ← R of all rows so far and the new ones.
class StackedQr {
 public:
  explicit StackedQr(Index columns);
  /// Adds rows to the matrix. Destroys `rows`.
  void add(Out rows);
  /// (columns, columns) upper triangular
  [[nodiscard]] Eigen::MatrixXd& r() noexcept { return r_; }

 private:
  Eigen::MatrixXd r_, t_;
};

}  // namespace rondo::pod
