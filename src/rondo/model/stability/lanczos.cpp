// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/model/stability/lanczos.hpp"

#include <Spectra/SymEigsSolver.h>

#include <algorithm>
#include <cmath>
#include <exception>

namespace rondo::dynamics {
namespace {

/// Relative residual at which Lanczos stops. It is added to the eigenvalue, whose own error is
/// smaller, so that it only shortens the step, by at most half of it (docs/decisions/008).
constexpr double lanczos_tolerance = 1e-3;
constexpr Eigen::Index lanczos_vectors = 20;

/// The interface that Spectra requires.
struct Product {
  using Scalar = double;
  const SymmetricOperator& a;
  [[nodiscard]] Eigen::Index rows() const { return a.size; }
  [[nodiscard]] Eigen::Index cols() const { return a.size; }
  void perform_op(const double* x, double* y) const { a.product(x, y); }
};

}  // namespace

std::optional<RitzPair> largest_ritz_pair(const SymmetricOperator& a) {
  if (a.size < 2) return std::nullopt;  // masses that underflow to 0
  Product op{a};
  Spectra::SymEigsSolver<Product> lanczos(op, 1, std::min(lanczos_vectors, a.size));
  try {
    lanczos.init();
    lanczos.compute(Spectra::SortRule::LargestAlge, 300, lanczos_tolerance);
  } catch (const std::exception&) {  // Spectra throws if numbers are not usable
    return std::nullopt;
  }
  if (lanczos.info() != Spectra::CompInfo::Successful) return std::nullopt;
  const double ritz = lanczos.eigenvalues()[0];
  const Eigen::VectorXd x = lanczos.eigenvectors().col(0);
  Eigen::VectorXd ax(x.size());
  a.product(x.data(), ax.data());
  const RitzPair pair{ritz, (ax - ritz * x).norm()};
  return std::isfinite(pair.value + pair.residual) ? std::optional(pair) : std::nullopt;
}

}  // namespace rondo::dynamics
