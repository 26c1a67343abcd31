// SPDX-License-Identifier: BSD-3-Clause
/// @file  Largest stable step of the central differences (docs/theory.md, 3.8).
#pragma once
#include <cstddef>
#include <span>

#include "rondo/fem/assembly.hpp"
#include "rondo/fem/sector_stiffness.hpp"

namespace rondo::dynamics {

struct CriticalStep {
  double step = 0.0;   ///< Δt_c = (2/ω)(√(1+ξ²) - ξ), ξ = (βω + α_l/ω)/2  [s]
  double omega = 0.0;  ///< ω: no less than the largest frequency, at most the element bound [rad/s]
  /// Relative width within which ω² is known: ‖A x - λ x‖ / λ of a Ritz pair, A = M^-½ K M^-½,
  /// or, where it is proven, of the interval that holds the largest eigenvalue [-].
  double uncertainty = 0.0;
  double element_bound = 0.0;  ///< upper bound of ω by elements [rad/s]
  bool converged = false;      ///< false: ω is the element bound
  bool proven = false;         ///< by factorisations, (3.8b); false: see 3.8 for what is not
};

/// Damping that acts at the old half step and so shortens the step.
struct LaggedDamping {
  double stiffness = 0.0;  ///< β                                                       [s]
  double mass = 0.0;       ///< α_l: α where the scheme lags it (as printed), else 0    [1/s]
};

/// ω = √(Ritz value + residual norm) by Lanczos.
/// @param mass (n); `free` the free nodes; `threads` for the products with K.
CriticalStep critical_step(const fem::BlockCsr& k, std::span<const double> mass,
                           std::span<const int> free, LaggedDamping damping,
                           double element_eigenvalue_bound, int threads = 1);

/// Of a body of N equal sectors, harmonic by harmonic, without the assembled K. The largest
/// eigenvalue is enclosed by Cholesky factorisations, and proven, to 1e-6; by Lanczos as above
/// where the sectors are so large that this would take more than some seconds.
/// @param mass (n) of every node of the mesh.
template <int C>
CriticalStep critical_step(const fem::SectorBlocks<C>& k, std::span<const double> mass,
                           LaggedDamping damping, double element_eigenvalue_bound);

/// Upper bound of the eigenvalues of one harmonic of such a body, found likewise [1/s²].
/// @pre 0 <= harmonic <= N/2
template <int C>
double harmonic_eigenvalue_bound(const fem::SectorBlocks<C>& k, std::span<const double> mass,
                                 int harmonic, double element_eigenvalue_bound);

/// How far, of its largest diagonal entry, a matrix that was factorised may be from the one whose
/// factor came out, with at most m numbers in a row or column of the factor (3.8): 1e-8 at the
/// least.
double cholesky_rounding(std::ptrdiff_t m) noexcept;

/// Δt_c for a given largest frequency.
double critical_step_of(double omega, LaggedDamping damping) noexcept;

}  // namespace rondo::dynamics
