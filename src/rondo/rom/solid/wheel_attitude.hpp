// SPDX-License-Identifier: BSD-3-Clause
/// @file  How a wheel in three dimensions stands on the ground: leaned by its camber, then turned
/// about the normal of the ground. The fixed axes are (t1, n, t2) of core/ground_frame.hpp of a
/// wheel that is not turned.
#pragma once
#include <cmath>

#include "rondo/core/ground_frame.hpp"

namespace rondo::rom {

class WheelAttitude {
 public:
  /// @param camber γ [rad] @param yaw χ, > 0 turns the heading to the left, to -t2 [rad]
  explicit WheelAttitude(double camber = 0.0, double yaw = 0.0) noexcept
      : ground_(camber), cos_(std::cos(yaw)), sin_(std::sin(yaw)) {}

  /// From the non-rotating axes of the wheel to the fixed axes.
  [[nodiscard]] Vec3 to_fixed(Vec3 a) const noexcept { return from_heading(ground_.from_wheel(a)); }
  [[nodiscard]] Vec3 from_fixed(Vec3 a) const noexcept { return ground_.to_wheel(to_heading(a)); }
  /// From axes along the heading of the wheel, the normal of the ground, and their product.
  [[nodiscard]] Vec3 from_heading(Vec3 a) const noexcept {
    return {cos_ * a.x + sin_ * a.z, a.y, cos_ * a.z - sin_ * a.x};
  }
  [[nodiscard]] Vec3 to_heading(Vec3 a) const noexcept {
    return {cos_ * a.x - sin_ * a.z, a.y, cos_ * a.z + sin_ * a.x};
  }

 private:
  GroundFrame ground_;
  double cos_, sin_;
};

}  // namespace rondo::rom
