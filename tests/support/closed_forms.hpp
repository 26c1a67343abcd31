// SPDX-License-Identifier: BSD-3-Clause
/// @file  Closed forms that tests compare with.
#pragma once
#include <cmath>

#include "rondo/fem/elasticity.hpp"

namespace rondo::test {

/// Stationary spin of an annulus a <= r <= b in plane strain, rim r = a fixed, top free:
/// r + u_r = A J1(κr) + B Y1(κr), κ² = ρ s²/(λ+2μ) (centrifugal softening included).
class SpinningAnnulus {
 public:
  SpinningAnnulus(const fem::Material& m, double a, double b, double spin) {
    const fem::Hooke d = fem::hooke(m);
    lambda_ = d.d12;
    modulus_ = d.d11;
    kappa_ = spin * std::sqrt(m.density / d.d11);
    // u(a) = 0 and σ_rr(b) = modulus u' + λ u/r = 0.
    const double j = std::cyl_bessel_j(1, kappa_ * a), y = std::cyl_neumann(1, kappa_ * a);
    const auto stress = [&](double value, double slope) {
      return modulus_ * slope + lambda_ * value / b;
    };
    const double sj = stress(std::cyl_bessel_j(1, kappa_ * b), slope_j(b));
    const double sy = stress(std::cyl_neumann(1, kappa_ * b), slope_y(b));
    const double sr = stress(b, 1.0);  // what the "r" on the left takes away
    const double det = j * sy - y * sj;
    a_ = (a * sy - y * sr) / det;
    b_ = (j * sr - a * sj) / det;
  }
  [[nodiscard]] double displacement(double r) const {
    return a_ * std::cyl_bessel_j(1, kappa_ * r) + b_ * std::cyl_neumann(1, kappa_ * r) - r;
  }
  [[nodiscard]] double radial_stress(double r) const {
    return modulus_ * slope(r) + lambda_ * displacement(r) / r;
  }
  [[nodiscard]] double hoop_stress(double r) const {
    return lambda_ * slope(r) + modulus_ * displacement(r) / r;
  }

 private:
  [[nodiscard]] double slope_j(double r) const {
    const double x = kappa_ * r;
    return kappa_ * (std::cyl_bessel_j(0, x) - std::cyl_bessel_j(1, x) / x);
  }
  [[nodiscard]] double slope_y(double r) const {
    const double x = kappa_ * r;
    return kappa_ * (std::cyl_neumann(0, x) - std::cyl_neumann(1, x) / x);
  }
  [[nodiscard]] double slope(double r) const { return a_ * slope_j(r) + b_ * slope_y(r) - 1.0; }

  double lambda_, modulus_, kappa_, a_, b_;
};

}  // namespace rondo::test
