// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/model/stability/critical_step.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "rondo/core/index.hpp"
#include "rondo/fem/stiffness_product.hpp"
#include "rondo/model/stability/lanczos.hpp"

namespace rondo::dynamics {
namespace {

/// y = M^-½ K M^-½ x on the free degrees of freedom.
class ScaledStiffness {
 public:
  ScaledStiffness(const fem::BlockCsr& k, std::span<const double> mass, std::span<const int> free,
                  int threads)
      : k_(k), free_(free), threads_(threads), scale_(free.size()), u_(k.n_rows()), p_(k.n_rows()) {
    for (std::size_t i = 0; i < free.size(); ++i) scale_[i] = 1.0 / std::sqrt(mass[at(free[i])]);
  }
  [[nodiscard]] Eigen::Index size() const { return static_cast<Eigen::Index>(2 * free_.size()); }
  void product(const double* x, double* y) {
    for (std::size_t i = 0; i < free_.size(); ++i)
      u_[at(free_[i])] = scale_[i] * Vec2{x[2 * i], x[2 * i + 1]};
    apply(k_, u_, p_, threads_);
    for (std::size_t i = 0; i < free_.size(); ++i) {
      const Vec2 p = scale_[i] * p_[at(free_[i])];
      y[2 * i] = p.x;
      y[2 * i + 1] = p.y;
    }
  }

 private:
  const fem::BlockCsr& k_;
  std::span<const int> free_;
  int threads_;
  std::vector<double> scale_;
  std::vector<Vec2> u_, p_;
};

}  // namespace

double critical_step_of(double omega, LaggedDamping damping) noexcept {
  const double xi = 0.5 * (damping.stiffness * omega + damping.mass / omega);
  return 2.0 / omega / (std::sqrt(1.0 + xi * xi) + xi);  // = (2/ω)(√(1+ξ²) - ξ), no cancellation
}

CriticalStep critical_step(const fem::BlockCsr& k, std::span<const double> mass,
                           std::span<const int> free, LaggedDamping damping,
                           double element_eigenvalue_bound, int threads) {
  CriticalStep out;
  out.element_bound = std::sqrt(element_eigenvalue_bound);
  out.omega = out.element_bound;
  ScaledStiffness a(k, mass, free, threads);
  if (const auto pair =
          largest_ritz_pair({a.size(), [&](const double* x, double* y) { a.product(x, y); }})) {
    out.uncertainty = pair->residual / pair->value;
    out.omega = std::min(out.element_bound, std::sqrt(pair->value + pair->residual));
    out.converged = true;
  }
  out.step = critical_step_of(out.omega, damping);
  return out;
}

}  // namespace rondo::dynamics
