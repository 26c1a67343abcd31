// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/dynamics/critical_step.hpp"

#include <Spectra/SymEigsSolver.h>
#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <exception>
#include <optional>
#include <vector>

#include "rondo/dynamics/operator.hpp"

namespace rondo::dynamics {
namespace {

/// y = M^-½ K M^-½ x on the free degrees of freedom, as Spectra wants it.
class ScaledStiffness {
 public:
  using Scalar = double;
  ScaledStiffness(const fem::BlockCsr& k, std::span<const double> mass, std::span<const int> free,
                  int threads)
      : k_(k), free_(free), threads_(threads), scale_(free.size()), u_(k.n_rows()), p_(k.n_rows()) {
    for (std::size_t i = 0; i < free.size(); ++i)
      scale_[i] = 1.0 / std::sqrt(mass[static_cast<std::size_t>(free[i])]);
  }
  [[nodiscard]] Eigen::Index rows() const { return static_cast<Eigen::Index>(2 * free_.size()); }
  [[nodiscard]] Eigen::Index cols() const { return rows(); }
  void perform_op(const double* x, double* y) const {
    for (std::size_t i = 0; i < free_.size(); ++i)
      u_[static_cast<std::size_t>(free_[i])] = scale_[i] * Vec2{x[2 * i], x[2 * i + 1]};
    apply(k_, u_, p_, threads_);
    for (std::size_t i = 0; i < free_.size(); ++i) {
      const Vec2 p = scale_[i] * p_[static_cast<std::size_t>(free_[i])];
      y[2 * i] = p.x;
      y[2 * i + 1] = p.y;
    }
  }

 private:
  const fem::BlockCsr& k_;
  std::span<const int> free_;
  int threads_;
  std::vector<double> scale_;
  mutable std::vector<Vec2> u_, p_;
};

}  // namespace

double critical_step_of(double omega, LaggedDamping damping) noexcept {
  const double xi = 0.5 * (damping.stiffness * omega + damping.mass / omega);
  return 2.0 / omega / (std::sqrt(1.0 + xi * xi) + xi);  // = (2/ω)(√(1+ξ²) - ξ), no cancellation
}

namespace {

/// Relative residual at which Lanczos stops. It is added to the eigenvalue, whose own error is
/// smaller, so it only shortens the step, by half of it at the most (docs/decisions/008).
constexpr double lanczos_tolerance = 1e-3;
constexpr Eigen::Index lanczos_vectors = 20;

struct RitzPair {
  double value = 0.0;     ///< [1/s²]
  double residual = 0.0;  ///< ‖A x - value x‖ [1/s²]
};

/// Largest eigenvalue; nothing where Lanczos does not converge, or the numbers are out of range.
std::optional<RitzPair> largest_ritz_pair(ScaledStiffness op) {
  Spectra::SymEigsSolver<ScaledStiffness> lanczos(op, 1, std::min(lanczos_vectors, op.rows()));
  try {
    lanczos.init();
    lanczos.compute(Spectra::SortRule::LargestAlge, 300, lanczos_tolerance);
  } catch (const std::exception&) {  // Spectra throws on numbers that it cannot work with
    return std::nullopt;
  }
  if (lanczos.info() != Spectra::CompInfo::Successful) return std::nullopt;
  const double ritz = lanczos.eigenvalues()[0];
  const Eigen::VectorXd x = lanczos.eigenvectors().col(0);
  Eigen::VectorXd ax(x.size());
  op.perform_op(x.data(), ax.data());
  const RitzPair pair{ritz, (ax - ritz * x).norm()};
  return std::isfinite(pair.value + pair.residual) ? std::optional(pair) : std::nullopt;
}

}  // namespace

CriticalStep critical_step(const fem::BlockCsr& k, std::span<const double> mass,
                           std::span<const int> free, LaggedDamping damping,
                           double element_eigenvalue_bound, int threads) {
  CriticalStep out;
  out.element_bound = std::sqrt(element_eigenvalue_bound);
  out.omega = out.element_bound;
  if (const auto pair = largest_ritz_pair(ScaledStiffness(k, mass, free, threads))) {
    out.residual = pair->residual / pair->value;
    out.omega = std::min(out.element_bound, std::sqrt(pair->value + pair->residual));
    out.converged = true;
  }
  out.step = critical_step_of(out.omega, damping);
  return out;
}

}  // namespace rondo::dynamics
