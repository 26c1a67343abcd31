// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/spinning_annulus.hpp"

#include <cmath>

namespace rondo::statics {
namespace {

double j1(double x) {
  return std::cyl_bessel_j(1, x);
}
double y1(double x) {
  return std::cyl_neumann(1, x);
}
/// dJ1/dx and dY1/dx.
double j1_slope(double x) {
  return std::cyl_bessel_j(0, x) - std::cyl_bessel_j(1, x) / x;
}
double y1_slope(double x) {
  return std::cyl_neumann(0, x) - std::cyl_neumann(1, x) / x;
}

}  // namespace

SpinningAnnulus::SpinningAnnulus(const fem::Material& material, double a, double b, double spin) {
  const fem::Hooke hooke = fem::hooke(material);
  lambda_ = hooke.d12;
  modulus_ = hooke.d11;
  kappa_ = std::abs(spin) * std::sqrt(material.density / modulus_);
  // u(a) = 0 and σ_rr(b) = D11 u' + D12 u/r = 0.
  const auto stress = [&](double value, double slope) {
    return modulus_ * slope + lambda_ * value / b;
  };
  const double j = j1(kappa_ * a), y = y1(kappa_ * a);
  const double sj = stress(j1(kappa_ * b), kappa_ * j1_slope(kappa_ * b));
  const double sy = stress(y1(kappa_ * b), kappa_ * y1_slope(kappa_ * b));
  const double sr = stress(b, 1.0);  // what the "r" on the left takes away
  const double det = j * sy - y * sj;
  a_ = (a * sy - y * sr) / det;
  b_ = (j * sr - a * sj) / det;
}

double SpinningAnnulus::displacement(double r) const {
  return a_ * j1(kappa_ * r) + b_ * y1(kappa_ * r) - r;
}

double SpinningAnnulus::radial_stress(double r) const {
  return modulus_ * slope(r) + lambda_ * displacement(r) / r;
}

double SpinningAnnulus::hoop_stress(double r) const {
  return lambda_ * slope(r) + modulus_ * displacement(r) / r;
}

double SpinningAnnulus::slope(double r) const {
  return kappa_ * (a_ * j1_slope(kappa_ * r) + b_ * y1_slope(kappa_ * r)) - 1.0;
}

}  // namespace rondo::statics
