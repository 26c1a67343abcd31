// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/pod/dense.hpp"

#include <cblas.h>
#include <lapacke.h>

#include <limits>
#include <vector>

namespace rondo::pod {

using Eigen::MatrixXd;
using Eigen::VectorXd;

void multiply(const MatrixXd& a, const VectorXd& x, VectorXd& y) noexcept {
  const auto rows = static_cast<int>(a.rows());
  cblas_dgemv(CblasColMajor, CblasNoTrans, rows, static_cast<int>(a.cols()), 1.0, a.data(), rows,
              x.data(), 1, 0.0, y.data(), 1);
}

MatrixXd inverse(MatrixXd a) {
  const auto n = static_cast<int>(a.rows());
  std::vector<int> pivots(static_cast<std::size_t>(n));
  const bool regular = LAPACKE_dgetrf(LAPACK_COL_MAJOR, n, n, a.data(), n, pivots.data()) == 0 &&
                       LAPACKE_dgetri(LAPACK_COL_MAJOR, n, a.data(), n, pivots.data()) == 0;
  if (!regular) a.setConstant(std::numeric_limits<double>::quiet_NaN());
  return a;
}

}  // namespace rondo::pod
