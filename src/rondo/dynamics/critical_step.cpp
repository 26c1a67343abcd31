// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/dynamics/critical_step.hpp"

#include <Spectra/SymEigsSolver.h>
#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <vector>

#include "rondo/dynamics/operator.hpp"

namespace rondo::dynamics {
namespace {

/// y = M^-½ K M^-½ x on the free degrees of freedom, as Spectra wants it.
class ScaledStiffness {
 public:
  using Scalar = double;
  ScaledStiffness(const fem::BlockCsr& k, std::span<const double> mass, std::span<const int> free)
      : k_(k), free_(free), scale_(free.size()), u_(k.n_rows()), p_(k.n_rows()) {
    for (std::size_t i = 0; i < free.size(); ++i)
      scale_[i] = 1.0 / std::sqrt(mass[static_cast<std::size_t>(free[i])]);
  }
  [[nodiscard]] Eigen::Index rows() const { return static_cast<Eigen::Index>(2 * free_.size()); }
  [[nodiscard]] Eigen::Index cols() const { return rows(); }
  void perform_op(const double* x, double* y) const {
    for (std::size_t i = 0; i < free_.size(); ++i)
      u_[static_cast<std::size_t>(free_[i])] = scale_[i] * Vec2{x[2 * i], x[2 * i + 1]};
    apply(k_, u_, p_, 1);
    for (std::size_t i = 0; i < free_.size(); ++i) {
      const Vec2 p = scale_[i] * p_[static_cast<std::size_t>(free_[i])];
      y[2 * i] = p.x;
      y[2 * i + 1] = p.y;
    }
  }

 private:
  const fem::BlockCsr& k_;
  std::span<const int> free_;
  std::vector<double> scale_;
  mutable std::vector<Vec2> u_, p_;
};

}  // namespace

double critical_step_of(double omega, double beta) noexcept {
  const double xi = 0.5 * beta * omega;
  return 2.0 / omega / (std::sqrt(1.0 + xi * xi) + xi);  // = (2/ω)(√(1+ξ²) - ξ), no cancellation
}

CriticalStep critical_step(const fem::BlockCsr& k, std::span<const double> mass,
                           std::span<const int> free, double beta,
                           double element_eigenvalue_bound) {
  CriticalStep out;
  out.element_bound = std::sqrt(element_eigenvalue_bound);
  out.omega = out.element_bound;
  ScaledStiffness a(k, mass, free);
  Spectra::SymEigsSolver<ScaledStiffness> lanczos(a, 1, std::min<Eigen::Index>(40, a.rows()));
  lanczos.init();
  lanczos.compute(Spectra::SortRule::LargestAlge, 300, 1e-7);
  if (lanczos.info() == Spectra::CompInfo::Successful) {
    const double ritz = lanczos.eigenvalues()[0];
    const Eigen::VectorXd x = lanczos.eigenvectors().col(0);
    Eigen::VectorXd ax(x.size());
    a.perform_op(x.data(), ax.data());
    const double residual = (ax - ritz * x).norm();
    out.residual = residual / ritz;
    out.omega = std::min(out.element_bound, std::sqrt(ritz + residual));
    out.converged = true;
  }
  out.step = critical_step_of(out.omega, beta);
  return out;
}

}  // namespace rondo::dynamics
