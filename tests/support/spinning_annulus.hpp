// SPDX-License-Identifier: BSD-3-Clause
/// @file  Closed form of the annulus in stationary spin (docs/theory.md, 6.2).
#pragma once
#include <cmath>

#include "rondo/fem/elasticity.hpp"

namespace rondo::test {

namespace detail {

inline double j1(double x) {
  return std::cyl_bessel_j(1, x);
}
inline double y1(double x) {
  return std::cyl_neumann(1, x);
}
/// dJ1/dx and dY1/dx.
inline double j1_slope(double x) {
  return std::cyl_bessel_j(0, x) - std::cyl_bessel_j(1, x) / x;
}
inline double y1_slope(double x) {
  return std::cyl_neumann(0, x) - std::cyl_neumann(1, x) / x;
}

}  // namespace detail

/// Rim r = a fixed, top r = b free: r + u_r = A J1(κr) + B Y1(κr), κ² = ρ s²/D11, including
/// centrifugal softening. Valid in plane strain and plane stress, with the material's D11 and D12.
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

inline SpinningAnnulus::SpinningAnnulus(const fem::Material& material, double a, double b,
                                        double spin) {
  const fem::Hooke hooke = fem::hooke(material);
  lambda_ = hooke.d12;
  modulus_ = hooke.d11;
  kappa_ = std::abs(spin) * std::sqrt(material.density / modulus_);
  // u(a) = 0 and σ_rr(b) = D11 u' + D12 u/r = 0.
  const auto stress = [&](double value, double slope) {
    return modulus_ * slope + lambda_ * value / b;
  };
  const double j = detail::j1(kappa_ * a), y = detail::y1(kappa_ * a);
  const double sj = stress(detail::j1(kappa_ * b), kappa_ * detail::j1_slope(kappa_ * b));
  const double sy = stress(detail::y1(kappa_ * b), kappa_ * detail::y1_slope(kappa_ * b));
  const double sr = stress(b, 1.0);  // the contribution of the "r" on the left
  const double det = j * sy - y * sj;
  a_ = (a * sy - y * sr) / det;
  b_ = (j * sr - a * sj) / det;
}

inline double SpinningAnnulus::displacement(double r) const {
  return a_ * detail::j1(kappa_ * r) + b_ * detail::y1(kappa_ * r) - r;
}

inline double SpinningAnnulus::radial_stress(double r) const {
  return modulus_ * slope(r) + lambda_ * displacement(r) / r;
}

inline double SpinningAnnulus::hoop_stress(double r) const {
  return lambda_ * slope(r) + modulus_ * displacement(r) / r;
}

inline double SpinningAnnulus::slope(double r) const {
  return kappa_ * (a_ * detail::j1_slope(kappa_ * r) + b_ * detail::y1_slope(kappa_ * r)) - 1.0;
}

}  // namespace rondo::test
