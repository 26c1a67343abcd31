// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/anderson.hpp"

#include <Eigen/QR>

namespace rondo::statics {

using Eigen::Index;
using Eigen::VectorXd;

/// Least squares by the products of the changes, each scaled to length 1; what is nearly a
/// combination of the others is left out.
VectorXd Anderson::next(const VectorXd& x, const VectorXd& g) {
  constexpr double as_good_as_dependent = 1e-12;
  const VectorXd change = g - x;
  if (has_last_) steps_.push_back({g - last_g_, change - last_change_});
  if (steps_.size() > depth_) steps_.pop_front();
  last_g_ = g;
  last_change_ = change;
  has_last_ = true;
  const auto n = static_cast<Index>(steps_.size());
  if (n == 0) return g;
  Eigen::MatrixXd products(n, n);
  VectorXd right(n), length(n);
  for (Index i = 0; i < n; ++i) {
    const VectorXd& of = steps_[static_cast<std::size_t>(i)].change;
    for (Index j = 0; j <= i; ++j)
      products(i, j) = products(j, i) = of.dot(steps_[static_cast<std::size_t>(j)].change);
    right[i] = of.dot(change);
  }
  length = products.diagonal().cwiseSqrt().cwiseMax(1e-300);
  products = length.cwiseInverse().asDiagonal() * products * length.cwiseInverse().asDiagonal();
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
  solver.setThreshold(as_good_as_dependent);
  solver.compute(products);
  const VectorXd share = solver.solve(right.cwiseQuotient(length)).cwiseQuotient(length);
  VectorXd out = g;
  for (Index i = 0; i < n; ++i) out -= share[i] * steps_[static_cast<std::size_t>(i)].g;
  return out;
}

}  // namespace rondo::statics
