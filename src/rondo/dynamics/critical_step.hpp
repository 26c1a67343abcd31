// SPDX-License-Identifier: BSD-3-Clause
/// @file  Largest stable step of the central differences (docs/theory.md, 3.8).
#pragma once
#include <span>

#include "rondo/fem/assembly.hpp"

namespace rondo::dynamics {

struct CriticalStep {
  double step = 0.0;   ///< Δt_c = (2/ω)(√(1+ξ²) - ξ), ξ = βω/2                        [s]
  double omega = 0.0;  ///< ω: √(Ritz value + residual norm), at most the element bound [rad/s]
  double residual = 0.0;  ///< ‖A x - λ x‖ / λ of the Ritz pair, A = M^-½ K M^-½           [-]
  double element_bound = 0.0;  ///< upper bound of ω by elements [rad/s]
  bool converged = false;      ///< false: ω is the element bound
};

/// @param mass (n); `free` the free nodes; `beta` the stiffness damping [s].
CriticalStep critical_step(const fem::BlockCsr& k, std::span<const double> mass,
                           std::span<const int> free, double beta, double element_eigenvalue_bound);

/// Δt_c for a given largest frequency.
double critical_step_of(double omega, double beta) noexcept;

}  // namespace rondo::dynamics
