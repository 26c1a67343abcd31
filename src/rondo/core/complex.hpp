// SPDX-License-Identifier: BSD-3-Clause
/// @file  Complex numbers: rotations of the plane and operators that commute with them
/// (docs/theory.md, section 1). A product with a vector turns and scales it: J = i turns by +90
/// degrees, R(θ) = e^{iθ}. std::complex is not used: its product tests for NaN at each call.
#pragma once
#include <cmath>

#include "rondo/core/vec2.hpp"

namespace rondo {

struct Complex {
  double re = 0.0;
  double im = 0.0;

  constexpr Complex& operator+=(Complex b) noexcept { return re += b.re, im += b.im, *this; }
  constexpr bool operator==(const Complex&) const = default;
};

constexpr Complex operator+(Complex a, Complex b) noexcept {
  return {a.re + b.re, a.im + b.im};
}
constexpr Complex operator-(Complex a, Complex b) noexcept {
  return {a.re - b.re, a.im - b.im};
}
constexpr Complex operator-(Complex a) noexcept {
  return {-a.re, -a.im};
}
constexpr Complex operator*(double s, Complex a) noexcept {
  return {s * a.re, s * a.im};
}
constexpr Complex operator/(Complex a, double s) noexcept {
  return {a.re / s, a.im / s};
}
constexpr Complex operator*(Complex a, Complex b) noexcept {
  return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}
constexpr Vec2 operator*(Complex a, Vec2 b) noexcept {
  return {a.re * b.x - a.im * b.y, a.re * b.y + a.im * b.x};
}
constexpr Complex conj(Complex a) noexcept {
  return {a.re, -a.im};
}
/// J a.
constexpr Complex turn90(Complex a) noexcept {
  return {-a.im, a.re};
}
/// |a|²
constexpr double norm_squared(Complex a) noexcept {
  return a.re * a.re + a.im * a.im;
}
constexpr Complex operator/(Complex a, Complex b) noexcept {
  return a * conj(b) / norm_squared(b);
}
constexpr Vec2 operator/(Vec2 a, Complex b) noexcept {
  return conj(b) * a / norm_squared(b);
}
inline double norm(Complex a) noexcept {
  return std::hypot(a.re, a.im);
}
/// e^{iθ}.
inline Complex rotation(double theta) noexcept {
  return {std::cos(theta), std::sin(theta)};
}
/// e^{iθ} - 1 without cancellation at small θ.
inline Complex rotation_minus_one(double theta) noexcept {
  const double half = std::sin(0.5 * theta);
  return {-2.0 * half * half, std::sin(theta)};
}

/// conj(a) b as complex numbers; for unit vectors it is the rotation that takes a to b.
constexpr Complex rotation_between(Vec2 a, Vec2 b) noexcept {
  return {dot(a, b), cross(a, b)};
}

// The contact frame (normal, tangential): the tangent is the normal turned by +90 degrees.

/// The rotation that takes (1, 0) to the normal. @pre |normal| = 1
constexpr Complex frame_of(Vec2 normal) noexcept {
  return {normal.x, normal.y};
}
/// The vector with the components (normal, tangential).
constexpr Vec2 from_frame(Vec2 normal, Vec2 components) noexcept {
  return frame_of(normal) * components;
}
/// The components (normal, tangential) of a vector.
constexpr Vec2 to_frame(Vec2 normal, Vec2 vector) noexcept {
  return conj(frame_of(normal)) * vector;
}

}  // namespace rondo
