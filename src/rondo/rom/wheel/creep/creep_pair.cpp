// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/wheel/creep/creep_pair.hpp"

#include "rondo/core/dense.hpp"

namespace rondo::rom {

CreepPair creep_pair(const CreepLags& lags, const Eigen::MatrixXcd& ahead,
                     const Eigen::MatrixXcd& back) {
  const std::complex<double> first = lags.first, others = lags.others, d = lags.determinant();
  return {(std::conj(others) * ahead - others * back) / d,
          (first * back - std::conj(first) * ahead) / d};
}

bool is_semidefinite(const Eigen::MatrixXcd& a) {
  const Eigen::VectorXd values = eigenvalues_of(Eigen::MatrixXcd(0.5 * (a + a.adjoint())));
  return values.minCoeff() >= -1e-9 * values.maxCoeff();
}

}  // namespace rondo::rom
