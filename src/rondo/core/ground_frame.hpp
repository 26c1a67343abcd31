// SPDX-License-Identifier: BSD-3-Clause
/// @file  The ground frame of a wheel with camber (docs/wheel3d.md): t1 along the heading of the
/// wheel, n out of the ground, t2 = t1 × n. Components in it are (t1, n, t2).
#pragma once
#include <cmath>

#include "rondo/core/vec3.hpp"

namespace rondo {

/// Moments of the ground on a wheel [N m].
struct GroundMoments {
  double aligning = 0.0;     ///< about n
  double overturning = 0.0;  ///< about t1
};

class GroundFrame {
 public:
  /// @param camber γ [rad]: n is (0, cos γ, sin γ) in the axes of the wheel; 0: the frames coincide
  explicit GroundFrame(double camber = 0.0) noexcept
      : cos_(std::cos(camber)), sin_(std::sin(camber)) {}

  /// Transforms components (t1, n, t2) to the axes of the wheel.
  [[nodiscard]] constexpr Vec3 to_wheel(Vec3 a) const noexcept {
    return {a.x, cos_ * a.y - sin_ * a.z, sin_ * a.y + cos_ * a.z};
  }
  /// Transforms components in the axes of the wheel to (t1, n, t2).
  [[nodiscard]] constexpr Vec3 from_wheel(Vec3 a) const noexcept {
    return {a.x, cos_ * a.y + sin_ * a.z, cos_ * a.z - sin_ * a.y};
  }

  /// Moments about the contact centre of ISO 8855, where the line in the plane of the wheel from
  /// its center down meets the ground: h tan γ along t2 beside the point below the center. Bilinear
  /// in (moments, force) and (1, height).
  /// @param below about the point below the center. @param force (t1, n, t2), that of the ground
  /// [N]. @param height h of the center above the ground [m]
  [[nodiscard]] constexpr GroundMoments about_contact_centre(GroundMoments below, Vec3 force,
                                                             double height) const noexcept {
    const double aside = height * (sin_ / cos_);
    return {below.aligning - aside * force.x, below.overturning + aside * force.y};
  }

 private:
  double cos_, sin_;
};

}  // namespace rondo
