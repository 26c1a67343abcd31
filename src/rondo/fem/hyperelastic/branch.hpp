// SPDX-License-Identifier: BSD-3-Clause
/// @file  A viscous branch at the center of an element: the neo-Hookean energy of the strain that
/// has not relaxed, with a unimodular strain history C_i (docs/rubber.md, 1.5). Only the plane part
/// of C_i is stored; its other component is 1/det. T as in numbers.hpp.
#pragma once
#include "rondo/fem/hyperelastic/laws.hpp"

namespace rondo::fem::hyperelastic {

/// A symmetric plane tensor.
template <class T>
struct Symmetric {
  T xx, yy, xy;
};

template <class T>
T determinant(const Symmetric<T>& c) noexcept {
  return c.xx * c.yy - c.xy * c.xy;
}

/// F by columns: the deformed X and Y axes.
template <class T>
struct Gradient {
  Pair<T> x, y;
};

/// FᵀF.
template <class T>
Symmetric<T> right_cauchy_green(const Gradient<T>& f) noexcept {
  return {dot(f.x, f.x), dot(f.y, f.y), dot(f.x, f.y)};
}

/// C_i ← uni(C_i + a C̄): the exact relaxation for constant C̄, with a = e^{Δt/τ} - 1.
/// @param y J^(-1/3)
template <class T>
Symmetric<T> relaxed(const Symmetric<T>& history, const Symmetric<T>& c, T y, T a) noexcept {
  const T scale = a * y * y;
  const Symmetric<T> sum{fma(scale, c.xx, history.xx), fma(scale, c.yy, history.yy),
                         fma(scale, c.xy, history.xy)};
  const T across = scale + as<T>(1.0) / determinant(history);
  const T to_1 = inverse_cube_root(determinant(sum) * across);
  return {to_1 * sum.xx, to_1 * sum.yy, to_1 * sum.xy};
}

/// C̄ : C_i⁻¹
template <class T>
T unrelaxed(const Symmetric<T>& history, const Symmetric<T>& c, T y) noexcept {
  const T det = determinant(history);
  const T plane =
      fma(c.xx, history.yy, fma(c.yy, history.xx, as<T>(-2.0) * c.xy * history.xy)) / det;
  return y * y * (plane + det);
}

/// P = g μ (J^(-2/3) F C_i⁻¹ - ⅓ (C̄ : C_i⁻¹) F⁻ᵀ) by columns [Pa]. @param modulus g μ [Pa]
template <class T>
Gradient<T> branch_stress(const Gradient<T>& f, const Symmetric<T>& history, T y,
                          T modulus) noexcept {
  const Symmetric<T> c = right_cauchy_green(f);
  const T scale = modulus * y * y / determinant(history);
  const T back = as<T>(-1.0 / 3.0) * modulus * unrelaxed(history, c, y) * y * y * y;
  const Pair<T> x = scale * (history.yy * f.x - history.xy * f.y);
  const Pair<T> v = scale * (history.xx * f.y - history.xy * f.x);
  // cof F = J F⁻ᵀ
  return {{fma(back, f.y.y, x.x), x.y - back * f.y.x}, {v.x - back * f.x.y, fma(back, f.x.x, v.y)}};
}

}  // namespace rondo::fem::hyperelastic
