// SPDX-License-Identifier: BSD-3-Clause
/// @file  Axes of a ground whose edges lie at an angle across the track of a wheel in three
/// dimensions (docs/roads.md): a profile is drawn normal to its edges and extruded along them.
#pragma once
#include <cmath>

#include "rondo/core/vec3.hpp"

namespace rondo::contact {

/// A right-handed frame that is turned about n out of the ground frame (t1, n, t2): its first axis
/// is normal to the edges, the second is n, the third is along the edges.
class EdgeAxes {
 public:
  EdgeAxes() = default;
  /// @param angle of the edges to t2, > 0: the left side (t2 < 0) comes to an edge first      [rad]
  explicit EdgeAxes(double angle) noexcept : cos_(std::cos(angle)), sin_(std::sin(angle)) {}

  [[nodiscard]] bool are_straight() const noexcept { return sin_ == 0.0; }
  /// Components in these axes of a vector with components (t1, n, t2).
  [[nodiscard]] Vec3 from_ground(Vec3 a) const noexcept {
    if (are_straight()) return a;
    return {cos_ * a.x - sin_ * a.z, a.y, sin_ * a.x + cos_ * a.z};
  }
  /// Components (t1, n, t2) of a vector with components in these axes.
  [[nodiscard]] Vec3 to_ground(Vec3 a) const noexcept {
    if (are_straight()) return a;
    return {cos_ * a.x + sin_ * a.z, a.y, cos_ * a.z - sin_ * a.x};
  }

 private:
  double cos_ = 1.0, sin_ = 0.0;
};

}  // namespace rondo::contact
