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
  double omega = 0.0;  ///< ω: at least the largest frequency, at most the element bound [rad/s]
  /// Relative width within which ω² is known: ‖A x - λ x‖ / λ of a Ritz pair, A = M^-½ K M^-½, or,
  /// if it is proven, of the interval that contains the largest eigenvalue [-].
  double uncertainty = 0.0;
  double element_bound = 0.0;  ///< upper bound of ω by elements [rad/s]
  bool converged = false;      ///< false: ω is the element bound
  bool proven = false;         ///< by factorisations, (3.8b); false: 3.8 says what is not proven
};

/// Damping that acts at the old half step and therefore shortens the stable step.
struct LaggedDamping {
  double stiffness = 0.0;  ///< β                                                       [s]
  double mass = 0.0;       ///< α_l: α where the scheme lags it (as printed), else 0    [1/s]
};

/// Finds ω = √(Ritz value + residual norm) by Lanczos.
/// @param mass (n); `free` the free nodes; `threads` for the products with K.
CriticalStep critical_step(const fem::BlockCsr& k, std::span<const double> mass,
                           std::span<const int> free, LaggedDamping damping,
                           double element_eigenvalue_bound, int threads = 1);

/// The critical step of a body of N equal sectors, harmonic by harmonic, without the assembled K.
/// The largest eigenvalue is enclosed to 1e-6 by Cholesky factorisations and thus proven. If the
/// sectors are so large that this would take more than some seconds, Lanczos is used as above.
/// @param mass (n) of all nodes of the mesh.
template <int C>
CriticalStep critical_step(const fem::SectorBlocks<C>& k, std::span<const double> mass,
                           LaggedDamping damping, double element_eigenvalue_bound);

/// Upper bound of the eigenvalues of one harmonic of such a body, found in the same way [1/s²].
/// @pre 0 <= harmonic <= N/2
template <int C>
double harmonic_eigenvalue_bound(const fem::SectorBlocks<C>& k, std::span<const double> mass,
                                 int harmonic, double element_eigenvalue_bound);

/// Bound of the distance, relative to the largest diagonal entry, between a factorised matrix and
/// the matrix whose exact factor was computed, with at most m numbers in a row or column of the
/// factor (3.8); at least 1e-8.
double cholesky_rounding(std::ptrdiff_t m) noexcept;

/// Δt_c for the given largest frequency.
double critical_step_of(double omega, LaggedDamping damping) noexcept;

}  // namespace rondo::dynamics
