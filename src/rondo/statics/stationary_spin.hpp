// SPDX-License-Identifier: BSD-3-Clause
/// @file  Equilibrium of a body in stationary spin: (K - s²M) u = s² M X (docs/theory.md, 6.1), and
/// the stress that stiffens it (2.8).
#pragma once
#include <span>
#include <vector>

#include "rondo/core/field.hpp"
#include "rondo/fem/assembly.hpp"
#include "rondo/fem/hyperelastic/hyperelasticity.hpp"
#include "rondo/fem/sector_stiffness.hpp"

namespace rondo::statics {

enum class SpinStatus {
  solved,
  unstable,  ///< K - s²M is not positive definite: the spin is beyond the softening limit
};

struct StationarySpin {
  SpinStatus status = SpinStatus::unstable;
  Field u;                ///< (n) turning frame, 0 on clamped nodes                        [m]
  double residual = 0.0;  ///< of the equation solved, relative to ‖s² M X‖                 [-]
};

/// Sparse Cholesky (CHOLMOD). @param spin s [rad/s]; others (n).
[[nodiscard]] StationarySpin stationary_spin(const fem::BlockCsr& k, std::span<const double> mass,
                                             std::span<const Vec2> reference,
                                             std::span<const int> free, double spin);

/// Solves f(u) = s² M (X + u) for a body of rubber at finite strain by Newton's method, with lower
/// spins first if needed. The status is "unstable" also if the full spin was not reached.
[[nodiscard]] StationarySpin stationary_spin(const fem::Hyperelasticity& body,
                                             std::span<const double> mass,
                                             std::span<const Vec2> reference,
                                             std::span<const int> free, double spin);

/// Displacement whose stress stiffens a body in stationary spin, (2.8a): K u = s² M X, without
/// softening. @param k without geometric stiffness. @pre something is clamped.
[[nodiscard]] StationarySpin centrifugal_prestress(const fem::BlockCsr& k,
                                                   std::span<const double> mass,
                                                   std::span<const Vec2> reference,
                                                   std::span<const int> free, double spin);

/// True where K - shift M is positive definite on the free nodes: every eigenvalue of M⁻¹K is above
/// `shift` [1/s²]. By the same Cholesky factorisation.
[[nodiscard]] bool eigenvalues_above(const fem::BlockCsr& k, std::span<const double> mass,
                                     std::span<const int> free, double shift);

/// Solves for a body of N equal sectors without the assembled K: u is the same in each sector,
/// found from harmonic 0 alone; all harmonics are factorised to see whether it is stable (6.1a).
[[nodiscard]] StationarySpin stationary_spin(const fem::SectorStiffness& k,
                                             std::span<const double> mass,
                                             std::span<const Vec2> reference, double spin);

/// Solves (K - s²MP) u = (s² - s0²) M P X in three dimensions, with P = diag(1, 1, 0).
/// @param rest_spin s0, at which X is in equilibrium [rad/s]
[[nodiscard]] StationarySpin stationary_spin(const fem::SolidSector& k,
                                             std::span<const double> mass,
                                             std::span<const Vec2> reference, double spin,
                                             double rest_spin = 0.0);

/// Solves for a body of N equal sectors, from harmonic 0 alone.
[[nodiscard]] StationarySpin centrifugal_prestress(const fem::SectorStiffness& k,
                                                   std::span<const double> mass,
                                                   std::span<const Vec2> reference, double spin);

/// Answers for a body of N equal sectors by a factorisation of each harmonic.
[[nodiscard]] bool eigenvalues_above(const fem::SectorStiffness& k, std::span<const double> mass,
                                     double shift);

/// Answers in three dimensions for K - shift M P with P = diag(1, 1, 0): whether a wheel is stable
/// at a spin whose square is `shift`.
[[nodiscard]] bool eigenvalues_above(const fem::SolidSector& k, std::span<const double> mass,
                                     double shift);

}  // namespace rondo::statics
