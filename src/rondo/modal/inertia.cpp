// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/modal/inertia.hpp"

#include <Eigen/SparseCholesky>

namespace rondo::modal {

template <class Scalar>
std::optional<int> negative_eigenvalues(const Eigen::SparseMatrix<Scalar>& lower) {
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<Scalar>, Eigen::Lower> factor(lower);
  if (factor.info() != Eigen::Success) return std::nullopt;
  const auto pivots = factor.vectorD();
  int negative = 0;
  for (Eigen::Index i = 0; i < pivots.size(); ++i) {
    const double pivot = Eigen::numext::real(pivots[i]);
    if (!std::isfinite(pivot)) return std::nullopt;
    negative += pivot < 0.0 ? 1 : 0;
  }
  return negative;
}

template std::optional<int> negative_eigenvalues(const Eigen::SparseMatrix<double>&);
template std::optional<int> negative_eigenvalues(const Eigen::SparseMatrix<std::complex<double>>&);

}  // namespace rondo::modal
