// SPDX-License-Identifier: BSD-3-Clause
/// @file  Largest stable step of the central differences (docs/theory.md, 3.8).
#pragma once
#include <span>

#include "rondo/fem/assembly.hpp"

namespace rondo::dynamics {

struct CriticalStep {
  double step = 0.0;   ///< Δt_c = (2/ω)(√(1+ξ²) - ξ), ξ = (βω + α_l/ω)/2  [s]
  double omega = 0.0;  ///< ω: √(Ritz value + residual norm), at most the element bound [rad/s]
  double residual = 0.0;  ///< ‖A x - λ x‖ / λ of the Ritz pair, A = M^-½ K M^-½           [-]
  double element_bound = 0.0;  ///< upper bound of ω by elements [rad/s]
  bool converged = false;      ///< false: ω is the element bound
};

/// Damping that acts at the old half step and so shortens the step.
struct LaggedDamping {
  double stiffness = 0.0;  ///< β                                                       [s]
  double mass = 0.0;       ///< α_l: α where the scheme lags it (as printed), else 0    [1/s]
};

/// @param mass (n); `free` the free nodes; `threads` for the products with K.
CriticalStep critical_step(const fem::BlockCsr& k, std::span<const double> mass,
                           std::span<const int> free, LaggedDamping damping,
                           double element_eigenvalue_bound, int threads = 1);

/// Δt_c for a given largest frequency.
double critical_step_of(double omega, LaggedDamping damping) noexcept;

}  // namespace rondo::dynamics
