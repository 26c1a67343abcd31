// SPDX-License-Identifier: BSD-3-Clause
/// @file  Closed form of the annulus in stationary spin (docs/theory.md, 6.2).
#pragma once
#include "rondo/fem/elasticity.hpp"

namespace rondo::statics {

/// Rim r = a fixed, top r = b free: r + u_r = A J1(κr) + B Y1(κr), κ² = ρ s²/D11, centrifugal
/// softening included. In plane strain as in plane stress, by the material's D11 and D12.
class SpinningAnnulus {
 public:
  /// @param a, b radii, 0 < a < b [m]. @param spin s ≠ 0, below the softening limit [rad/s]
  SpinningAnnulus(const fem::Material& material, double a, double b, double spin);
  [[nodiscard]] double displacement(double r) const;   ///< u_r [m]
  [[nodiscard]] double radial_stress(double r) const;  ///< σ_rr [Pa]
  [[nodiscard]] double hoop_stress(double r) const;    ///< σ_θθ [Pa]

 private:
  [[nodiscard]] double slope(double r) const;  ///< du_r/dr [-]

  double lambda_, modulus_;  ///< D12, D11                 [Pa]
  double kappa_;             ///< [1/m]
  double a_, b_;             ///< A, B                     [m]
};

}  // namespace rondo::statics
