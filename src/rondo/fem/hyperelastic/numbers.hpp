// SPDX-License-Identifier: BSD-3-Clause
/// @file  Number types of the laws and elements of rubber: double; dual numbers, which carry their
/// derivatives; eight doubles in a register (core/simd). Functions that all types have: + - * /,
/// fma(a, b, c) = a b + c, inverse_cube_root(a) with a > 0, log1p(a), as<T>(double).
#pragma once
#include <array>
#include <cmath>
#include <cstddef>

namespace rondo::fem::hyperelastic {

inline double fma(double a, double b, double c) noexcept {
  return a * b + c;
}
inline double inverse_cube_root(double a) noexcept {
  return 1.0 / std::cbrt(a);
}

inline double log1p(double a) noexcept {
  return std::log1p(a);
}

/// A value and its derivatives with respect to N unknowns (forward mode).
template <std::size_t N>
struct Dual {
  double value = 0.0;
  std::array<double, N> slope{};

  Dual() = default;
  explicit(false) Dual(double v) noexcept : value(v) {}
  /// The number v as the unknown with index `which`.
  static Dual unknown(double v, std::size_t which) noexcept {
    Dual d(v);
    d.slope[which] = 1.0;
    return d;
  }
};

/// f(a), whose derivative is f'.
template <std::size_t N>
Dual<N> chain(double f, double slope, const Dual<N>& a) noexcept {
  Dual<N> d(f);
  for (std::size_t i = 0; i < N; ++i) d.slope[i] = slope * a.slope[i];
  return d;
}
template <std::size_t N>
Dual<N> operator+(Dual<N> a, const Dual<N>& b) noexcept {
  a.value += b.value;
  for (std::size_t i = 0; i < N; ++i) a.slope[i] += b.slope[i];
  return a;
}
template <std::size_t N>
Dual<N> operator-(Dual<N> a, const Dual<N>& b) noexcept {
  a.value -= b.value;
  for (std::size_t i = 0; i < N; ++i) a.slope[i] -= b.slope[i];
  return a;
}
template <std::size_t N>
Dual<N> operator*(const Dual<N>& a, const Dual<N>& b) noexcept {
  Dual<N> d(a.value * b.value);
  for (std::size_t i = 0; i < N; ++i) d.slope[i] = a.value * b.slope[i] + b.value * a.slope[i];
  return d;
}
template <std::size_t N>
Dual<N> operator/(const Dual<N>& a, const Dual<N>& b) noexcept {
  Dual<N> d(a.value / b.value);
  for (std::size_t i = 0; i < N; ++i) d.slope[i] = (a.slope[i] - d.value * b.slope[i]) / b.value;
  return d;
}
template <std::size_t N>
bool operator<(const Dual<N>& a, const Dual<N>& b) noexcept {
  return a.value < b.value;
}
template <std::size_t N>
Dual<N> fma(const Dual<N>& a, const Dual<N>& b, const Dual<N>& c) noexcept {
  return a * b + c;
}
template <std::size_t N>
Dual<N> inverse_cube_root(const Dual<N>& a) noexcept {
  const double y = inverse_cube_root(a.value);
  return chain(y, -y / (3.0 * a.value), a);
}

template <std::size_t N>
Dual<N> log1p(const Dual<N>& a) noexcept {
  return chain(std::log1p(a.value), 1.0 / (1.0 + a.value), a);
}

/// A constant as a T: all its derivatives are zero.
template <class T>
T as(double value) noexcept {
  return T(value);
}

/// A plane vector of such numbers.
template <class T>
struct Pair {
  T x, y;
};

template <class T>
Pair<T> operator+(Pair<T> a, Pair<T> b) noexcept {
  return {a.x + b.x, a.y + b.y};
}
template <class T>
Pair<T> operator-(Pair<T> a, Pair<T> b) noexcept {
  return {a.x - b.x, a.y - b.y};
}
template <class T>
Pair<T> operator*(T s, Pair<T> a) noexcept {
  return {s * a.x, s * a.y};
}
/// s a + b
template <class T>
Pair<T> fma(T s, Pair<T> a, Pair<T> b) noexcept {
  return {fma(s, a.x, b.x), fma(s, a.y, b.y)};
}
template <class T>
T dot(Pair<T> a, Pair<T> b) noexcept {
  return fma(a.x, b.x, a.y * b.y);
}
/// a_x b_y - a_y b_x
template <class T>
T cross(Pair<T> a, Pair<T> b) noexcept {
  return a.x * b.y - a.y * b.x;
}

}  // namespace rondo::fem::hyperelastic
