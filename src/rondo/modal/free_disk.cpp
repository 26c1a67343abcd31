// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/modal/free_disk.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "rondo/core/contract.hpp"

namespace rondo::modal {

using Eigen::Index;

/// Solves λ² w + 2sJ λ w + A' w = 0 for w e^{λt}, λ = iω, as a real problem of twice the size. The
/// rotation has the two roots of smallest modulus.
RotationalRoots rotational_roots(const Eigen::MatrixXd& a, double spin) {
  const Index n = a.rows();
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  companion.topRightCorner(n, n).setIdentity();
  companion.bottomLeftCorner(n, n) = -a;
  for (Index k = 0; k < n; k += 2) {
    companion(n + k, n + k + 1) = 2.0 * spin;
    companion(n + k + 1, n + k) = -2.0 * spin;
  }
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(companion);
  RONDO_DEMAND(solver.info() == Eigen::Success, n, spin);
  std::vector<Index> order;
  for (Index k = 0; k < 2 * n; ++k) order.push_back(k);
  const auto lambda = [&](Index k) { return solver.eigenvalues()[k]; };
  std::sort(order.begin(), order.end(),
            [&](Index p, Index q) { return std::abs(lambda(p)) < std::abs(lambda(q)); });
  const auto root = [&](Index k) {
    HarmonicRoot r;
    r.omega = lambda(k).imag();
    r.w = solver.eigenvectors().col(k).head(n).normalized();
    return r;
  };
  RotationalRoots out;
  const Index rotation = lambda(order[0]).real() > lambda(order[1]).real() ? order[0] : order[1];
  out.rotation = root(rotation);
  out.rotation.omega = std::abs(out.rotation.omega);
  out.growth = std::max(0.0, lambda(rotation).real());
  for (std::size_t k = 2; k < order.size(); ++k)
    if (lambda(order[k]).imag() > 0.0) out.vibrations.push_back(root(order[k]));
  return out;
}

}  // namespace rondo::modal
