// SPDX-License-Identifier: BSD-3-Clause
/// @file  Plane vectors: positions, velocities, forces. A Complex (complex.hpp) turns them.
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

constexpr double dot(Vec2 a, Vec2 b) noexcept {
  return a.x * b.x + a.y * b.y;
}
constexpr double cross(Vec2 a, Vec2 b) noexcept {
  return a.x * b.y - a.y * b.x;
}
/// J a: a turned by +90 degrees.
constexpr Vec2 turn90(Vec2 a) noexcept {
  return {-a.y, a.x};
}
inline double norm(Vec2 a) noexcept {
  return std::hypot(a.x, a.y);
}
/// The unit vector at an angle from the x axis.
inline Vec2 direction_at(double angle) noexcept {
  return {std::cos(angle), std::sin(angle)};
}

}  // namespace rondo
