// SPDX-License-Identifier: BSD-3-Clause
/// @file  Plane vectors, which are also complex numbers (docs/theory.md, section 1).
/// x + iy: the product turns and scales, J = i turns by +90 degrees, R(θ) = e^{iθ}.
/// std::complex is not used: its product tests for NaN at every call.
#pragma once
#include <cmath>

namespace rondo {

struct Vec2 {
  double x = 0.0;
  double y = 0.0;

  constexpr Vec2& operator+=(Vec2 b) noexcept { return x += b.x, y += b.y, *this; }
  constexpr Vec2& operator-=(Vec2 b) noexcept { return x -= b.x, y -= b.y, *this; }
  constexpr bool operator==(const Vec2&) const = default;
};

constexpr Vec2 operator+(Vec2 a, Vec2 b) noexcept {
  return {a.x + b.x, a.y + b.y};
}
constexpr Vec2 operator-(Vec2 a, Vec2 b) noexcept {
  return {a.x - b.x, a.y - b.y};
}
constexpr Vec2 operator-(Vec2 a) noexcept {
  return {-a.x, -a.y};
}
constexpr Vec2 operator*(double s, Vec2 a) noexcept {
  return {s * a.x, s * a.y};
}
constexpr Vec2 operator/(Vec2 a, double s) noexcept {
  return {a.x / s, a.y / s};
}

/// Complex product and quotient.
constexpr Vec2 operator*(Vec2 a, Vec2 b) noexcept {
  return {a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x};
}
constexpr Vec2 conj(Vec2 a) noexcept {
  return {a.x, -a.y};
}
constexpr double dot(Vec2 a, Vec2 b) noexcept {
  return a.x * b.x + a.y * b.y;
}
constexpr double cross(Vec2 a, Vec2 b) noexcept {
  return a.x * b.y - a.y * b.x;
}
constexpr Vec2 operator/(Vec2 a, Vec2 b) noexcept {
  return a * conj(b) / dot(b, b);
}
/// J a: a turned by +90 degrees.
constexpr Vec2 turn90(Vec2 a) noexcept {
  return {-a.y, a.x};
}
inline double norm(Vec2 a) noexcept {
  return std::hypot(a.x, a.y);
}
/// e^{iθ}.
inline Vec2 rotation(double theta) noexcept {
  return {std::cos(theta), std::sin(theta)};
}
/// e^{iθ} - 1 without cancellation at small θ.
inline Vec2 rotation_minus_one(double theta) noexcept {
  const double half = std::sin(0.5 * theta);
  return {-2.0 * half * half, std::sin(theta)};
}

}  // namespace rondo
