// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/core/dense.hpp"

#include <lapacke.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <limits>

#include "rondo/core/contract.hpp"
#include "rondo/core/process_wide.hpp"

namespace rondo {
namespace {

using Eigen::Index, Eigen::MatrixXcd, Eigen::MatrixXd, Eigen::VectorXcd, Eigen::VectorXd;

template <class Matrix>
Axes<Matrix> axes(const Matrix& a) {
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(a);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

template <class Matrix>
VectorXd eigenvalues(const Matrix& a) {
  return Eigen::SelfAdjointEigenSolver<Matrix>(a, Eigen::EigenvaluesOnly).eigenvalues();
}

int lapack_length(Index n) {
  RONDO_DEMAND(n >= 0 && n <= std::numeric_limits<int>::max(), n);
  return static_cast<int>(n);
}

}  // namespace

VectorXd solve(const MatrixXd& a, const VectorXd& b) {
  return a.partialPivLu().solve(b);
}
VectorXcd solve(const MatrixXcd& a, const VectorXcd& b) {
  return a.partialPivLu().solve(b);
}
MatrixXcd solve(const MatrixXcd& a, const MatrixXcd& b) {
  return a.partialPivLu().solve(b);
}

MatrixXd solve_definite(const MatrixXd& a, const MatrixXd& b) {
  return a.llt().solve(b);
}
MatrixXcd solve_definite(const MatrixXcd& a, const MatrixXcd& b) {
  return a.llt().solve(b);
}

Axes<MatrixXd> axes_of(const MatrixXd& a) {
  return axes(a);
}
Axes<MatrixXcd> axes_of(const MatrixXcd& a) {
  return axes(a);
}
VectorXd eigenvalues_of(const MatrixXd& a) {
  return eigenvalues(a);
}
VectorXd eigenvalues_of(const MatrixXcd& a) {
  return eigenvalues(a);
}

Svd thin_svd(MatrixXd& a) {
  const Index k = std::min(a.rows(), a.cols());
  Svd out{VectorXd(k), MatrixXd(a.rows(), k), {}};
  if (k == 0) {
    out.v.resize(a.cols(), 0);
    return out;
  }
  const OneBlasThread one_thread;
  MatrixXd vt(k, a.cols());
  const int rows = lapack_length(a.rows()), columns = lapack_length(a.cols());
  const int info =
      LAPACKE_dgesdd(LAPACK_COL_MAJOR, 'S', rows, columns, a.data(), rows, out.sigma.data(),
                     out.u.data(), rows, vt.data(), static_cast<int>(k));
  RONDO_DEMAND(info == 0, info, rows, columns);
  out.v = vt.transpose();
  return out;
}

}  // namespace rondo
