// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/fem/hyperelastic/laws.hpp"

namespace rondo::fem::hyperelastic {
namespace {

/// With z = cosh 2d: cosh αd, h = sinh αd / sinh 2d and its derivative by z. These are Chebyshev
/// functions of degree n = α/2, computed by their series near z = 1.
struct Hyperbolic {
  double cosh, h, slope;
};

Hyperbolic series(double n, double less_1) noexcept {
  constexpr int terms = 8;
  double cosh = 1.0, h = n, slope = 0.0, power = 1.0;  // power: ((1 - z)/2)^k
  double of_cosh = 1.0, of_h = n;
  for (int k = 0; k < terms; ++k) {
    const double i = k + 1.0;
    of_cosh *= (k - n) * (k + n) / ((0.5 + k) * i);
    of_h *= (1.0 - n + k) * (1.0 + n + k) / ((1.5 + k) * i);
    slope += -0.5 * i * of_h * power;
    power *= -0.5 * less_1;
    cosh += of_cosh * power;
    h += of_h * power;
  }
  return {cosh, h, slope};
}

Hyperbolic hyperbolic(double exponent, double less_1) noexcept {
  constexpr double near = 1e-3;
  if (less_1 < near) return series(0.5 * exponent, less_1);
  const double z = 1.0 + less_1, d = std::asinh(std::sqrt(0.5 * less_1));
  const double sinh_2d = std::sqrt(less_1 * (z + 1.0));
  const double cosh = std::cosh(exponent * d), h = std::sinh(exponent * d) / sinh_2d;
  return {cosh, h, (exponent * cosh - 2.0 * h * z) / (2.0 * sinh_2d * sinh_2d)};
}

/// z - 1 for s = 2 J z, which round-off could make negative.
double spread(double s, double j) noexcept {
  return std::max(0.0, (s - 2.0 * j) / (2.0 * j));
}

}  // namespace

PlaneStress<double> Ogden::operator()(double s, double j) const noexcept {
  const double less_1 = spread(s, j), log_j = std::log(j);
  PlaneStress<double> p{0.0, 0.0, 0.0};
  for (const OgdenTerm& t : terms) {
    const Hyperbolic f = hyperbolic(t.exponent, less_1);
    const double of_plane = t.modulus * std::exp((t.exponent / 6.0 - 1.0) * log_j);
    const double across = t.modulus * std::exp((-t.exponent / 3.0 - 1.0) * log_j);
    p.a += of_plane * f.h;
    p.b += of_plane * (f.cosh / 3.0 - (1.0 + less_1) * f.h) - across / 3.0;
    p.w += (j * (2.0 * of_plane * f.cosh + across) - 3.0 * t.modulus) / t.exponent;
  }
  return p;
}

Ogden::Slopes Ogden::slopes(double s, double j) const noexcept {
  const double less_1 = spread(s, j), z = 1.0 + less_1, log_j = std::log(j);
  Slope by_z{0.0, 0.0}, by_j{0.0, 0.0};
  for (const OgdenTerm& t : terms) {
    const Hyperbolic f = hyperbolic(t.exponent, less_1);
    const double p = t.exponent / 6.0 - 1.0, q = -t.exponent / 3.0 - 1.0;
    const double of_plane = t.modulus * std::exp(p * log_j);
    const double across = t.modulus * std::exp(q * log_j);
    by_z.a += of_plane * f.slope;
    by_z.b += of_plane * (t.exponent * f.h / 6.0 - f.h - z * f.slope);
    by_j.a += p * of_plane * f.h / j;
    by_j.b += (p * of_plane * (f.cosh / 3.0 - z * f.h) - q * across / 3.0) / j;
  }
  const double z_s = 0.5 / j, z_j = -z / j;
  return {{z_s * by_z.a, z_s * by_z.b}, {by_j.a + z_j * by_z.a, by_j.b + z_j * by_z.b}};
}

void ogden_stress(const Rubber& rubber, const double* s, const double* j, double* a, double* b,
                  double* w) noexcept {
  constexpr int lanes = 8;
  const Ogden law(rubber);
  for (int i = 0; i < lanes; ++i) {
    const PlaneStress<double> p = law(s[i], j[i]);
    a[i] = p.a;
    b[i] = p.b;
    w[i] = p.w;
  }
}

PlaneStress<double> isochoric_stress(const Rubber& rubber, double s, double j) noexcept {
  if (rubber.law == RubberLaw::ogden) return Ogden(rubber)(s, j);
  return Polynomial<double>(rubber)(s, j);
}

}  // namespace rondo::fem::hyperelastic
