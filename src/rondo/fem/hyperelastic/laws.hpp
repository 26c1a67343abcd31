// SPDX-License-Identifier: BSD-3-Clause
/// @file  Laws of rubber in plane strain as functions of s = F:F and J = det F (docs/rubber.md,
/// 1.2). Every isotropic law is such a function, and its first Piola-Kirchhoff stress is a F + b
/// cof F with a = 2 ∂W/∂s, b = ∂W/∂J. T as in numbers.hpp.
#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "rondo/fem/hyperelastic/numbers.hpp"
#include "rondo/fem/rubber.hpp"

namespace rondo::fem::hyperelastic {

template <class T>
struct PlaneStress {
  T a, b;  ///< coefficients of a F + b cof F                                            [Pa]
  T w;     ///< W                                                                       [Pa]
};

/// W = c10 (I₁ - 3) of the isochoric part.
template <class T>
struct NeoHooke {
  T c10;  ///< [Pa]

  explicit NeoHooke(const Rubber& r) noexcept : c10(as<T>(r.c10)) {}

  PlaneStress<T> operator()(T s, T j) const noexcept {
    const T y = inverse_cube_root(j), y2 = y * y;
    const T a = as<T>(2.0) * c10 * y2;
    const T i1 = y2 * (s + as<T>(1.0));  // ∂I₁/∂J = -⅔ I₁/J
    return {a, as<T>(-2.0 / 3.0) * c10 * i1 * (y2 * y), c10 * (i1 - as<T>(3.0))};
  }
};

/// Mooney-Rivlin and Yeoh: polynomials of I₁ - 3 and I₂ - 3 of the isochoric part.
template <class T>
struct Polynomial {
  T c10, c01, c20, c30;  ///< [Pa]

  explicit Polynomial(const Rubber& r) noexcept
      : c10(as<T>(r.c10)), c01(as<T>(r.c01)), c20(as<T>(r.c20)), c30(as<T>(r.c30)) {}

  PlaneStress<T> operator()(T s, T j) const noexcept {
    const T y = inverse_cube_root(j), y2 = y * y, y4 = y2 * y2, inverse = y2 * y;
    const T i1 = y2 * (s + as<T>(1.0)), i2 = y4 * fma(j, j, s);
    const T x = i1 - as<T>(3.0);
    const T w1 = fma(fma(as<T>(3.0) * c30, x, as<T>(2.0) * c20), x, c10);
    const T a = as<T>(2.0) * fma(w1, y2, c01 * y4);
    const T b = as<T>(-2.0 / 3.0) * inverse * fma(w1, i1, as<T>(2.0) * c01 * i2);
    const T w = fma(fma(fma(c30, x, c20), x, c10), x, c01 * (i2 - as<T>(3.0)));
    return {a, fma(as<T>(2.0) * c01 * y4, j, b), w};
  }
};

/// d and sinh(2d) of the principal stretches e^{±d} √J: s = 2 J cosh(2d). For numbers with
/// derivatives: functions of d² have finite derivatives at d = 0.
struct Ogden {
  const std::vector<OgdenTerm>& terms;
  explicit Ogden(const Rubber& r) noexcept : terms(r.terms) {}

  PlaneStress<double> operator()(double s, double j) const noexcept;
  /// Derivatives of a and b with respect to s and J.
  struct Slope {
    double a, b;
  };
  struct Slopes {
    Slope by_s, by_j;
  };
  Slopes slopes(double s, double j) const noexcept;

  template <std::size_t N>
  PlaneStress<Dual<N>> operator()(const Dual<N>& s, const Dual<N>& j) const noexcept {
    const PlaneStress<double> p = (*this)(s.value, j.value);
    const Slopes d = slopes(s.value, j.value);
    return {chain(p.a, d.by_s.a, s) + chain(0.0, d.by_j.a, j),
            chain(p.b, d.by_s.b, s) + chain(0.0, d.by_j.b, j),
            chain(p.w, 0.5 * p.a, s) + chain(0.0, p.b, j)};
  }
};

/// The coefficients a and b of eight points at once.
void ogden_stress(const Rubber& rubber, const double* s, const double* j, double* a, double* b,
                  double* w) noexcept;

/// Stress by the law of the rubber. @param s F:F; j det F > 0
[[nodiscard]] PlaneStress<double> isochoric_stress(const Rubber& rubber, double s,
                                                   double j) noexcept;

/// U = κ/4 (J² - 1 - 2 ln J) and U' = κ/2 (J - 1/J) from J - 1, which keeps its digits.
template <class T>
struct Volumetric {
  T energy;    ///< [Pa]
  T pressure;  ///< U' [Pa]
};
template <class T>
Volumetric<T> volumetric(T bulk, T j_less_1) noexcept {
  const T square = j_less_1 * (as<T>(2.0) + j_less_1);  // J² - 1
  return {as<T>(0.25) * bulk * (square - as<T>(2.0) * log1p(j_less_1)),
          as<T>(0.5) * bulk * square / (as<T>(1.0) + j_less_1)};
}

}  // namespace rondo::fem::hyperelastic
