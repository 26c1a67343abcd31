// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/chosen_modes.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

#include "rondo/core/contract.hpp"
#include "rondo/pod/svd.hpp"

namespace rondo::rom {

using pod::Index;
using pod::multiply;
using pod::multiply_transposed;
using pod::Svd;

using Eigen::MatrixXd;
using Eigen::VectorXd;

ChosenModes choose_modes(const pod::Decomposition& found, const MatrixXd& extra, Index most) {
  const Index n = std::min(found.modes.cols(), found.temporal.cols());
  RONDO_DEMAND(extra.rows() == 0 || extra.cols() == found.modes.cols(), extra.rows(), extra.cols(),
               found.modes.cols());
  const MatrixXd coefficients =
      found.sigma.head(n).asDiagonal() * found.temporal.leftCols(n).transpose();
  MatrixXd normed = coefficients;
  if (extra.rows() > 0) {
    MatrixXd metric(n, n);  // eigenvalues >= 1: squaring costs no relevant accuracy
    multiply_transposed(extra.leftCols(n), extra.leftCols(n), metric);
    metric.diagonal().array() += 1.0;
    const MatrixXd root = metric.llt().matrixU();
    multiply(root, coefficients, normed);
  }
  const Svd svd = pod::thin_svd(normed);
  const double least = pod::round_off(n, coefficients.cols(), svd.sigma[0]);
  Index k = std::min(most, n);
  while (k > 0 && !(svd.sigma[k - 1] > least)) --k;
  MatrixXd of_modes(n, k);
  multiply(coefficients, svd.v.leftCols(k), of_modes);
  pod::orthonormalise(of_modes);

  ChosenModes chosen{svd.sigma, MatrixXd(found.modes.rows(), k), VectorXd(k + 1)};
  multiply(found.modes.leftCols(n), of_modes, chosen.modes);
  MatrixXd held(k, coefficients.cols());
  multiply_transposed(of_modes, coefficients, held);
  chosen.left[0] = found.energy;
  for (Index j = 0; j < k; ++j)
    chosen.left[j + 1] = std::max(0.0, chosen.left[j] - held.row(j).squaredNorm());
  return chosen;
}

}  // namespace rondo::rom
