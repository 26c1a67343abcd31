// SPDX-License-Identifier: BSD-3-Clause
/// @file  Vectors of space. The axes of a wheel: x along its heading, y up, z along the axle,
/// normal to the plane in which it turns. The member `plane` is (x, y).
#pragma once
#include "rondo/core/complex.hpp"

namespace rondo {

struct Vec3 {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;

  constexpr Vec3() = default;
  constexpr Vec3(double a, double b, double c) noexcept : x(a), y(b), z(c) {}
  /// A plane vector is also a vector of space.
  constexpr Vec3(Vec2 plane, double axial = 0.0) noexcept : x(plane.x), y(plane.y), z(axial) {}

  [[nodiscard]] constexpr Vec2 plane() const noexcept { return {x, y}; }
  constexpr Vec3& operator+=(Vec3 b) noexcept { return x += b.x, y += b.y, z += b.z, *this; }
  constexpr Vec3& operator-=(Vec3 b) noexcept { return x -= b.x, y -= b.y, z -= b.z, *this; }
  constexpr bool operator==(const Vec3&) const = default;
};

constexpr Vec3 operator+(Vec3 a, Vec3 b) noexcept {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
constexpr Vec3 operator-(Vec3 a, Vec3 b) noexcept {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
constexpr Vec3 operator-(Vec3 a) noexcept {
  return {-a.x, -a.y, -a.z};
}
constexpr Vec3 operator*(double s, Vec3 a) noexcept {
  return {s * a.x, s * a.y, s * a.z};
}
constexpr Vec3 operator/(Vec3 a, double s) noexcept {
  return {a.x / s, a.y / s, a.z / s};
}
/// The vector turned about the axle.
constexpr Vec3 operator*(Complex rotation, Vec3 a) noexcept {
  return {rotation * a.plane(), a.z};
}
constexpr double dot(Vec3 a, Vec3 b) noexcept {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
constexpr Vec3 cross(Vec3 a, Vec3 b) noexcept {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double norm(Vec3 a) noexcept {
  return std::hypot(a.x, a.y, a.z);
}

}  // namespace rondo
