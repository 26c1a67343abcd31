// SPDX-License-Identifier: BSD-3-Clause
/// @file  Ground that obstacles stand on, each in axes of its own (obstacle_ground.hpp): it has one
/// height and one slope at each place.
#pragma once
#include <utility>

#include "rondo/contact/space/space_ground.hpp"

namespace rondo::contact {

/// The surface straight below or above a place.
struct GroundBelow {
  double height = 0.0;    ///< no number: there is no ground                               [m]
  double along_t1 = 0.0;  ///< slope along t1                                              [-]
  double along_t2 = 0.0;  ///< slope along t2                                              [-]
};

class BaseGround : public SpaceGround {
 public:
  /// The surface at a place (t1, t2) [m].
  [[nodiscard]] virtual GroundBelow below(double t1, double t2) const noexcept = 0;
};

/// A profile that is extruded across the track.
class ProfileGround final : public BaseGround {
 public:
  /// @pre the ground has no walls, and its convex corners are round
  explicit ProfileGround(Ground ground) : ground_(std::move(ground)) {}

  [[nodiscard]] SpaceTouches touches(Vec3 place) const noexcept override {
    return extruded(ground_.touches(place.plane()));
  }
  [[nodiscard]] double clearance(Vec3 place) const noexcept override {
    return place.y - ground_.surface_at(place.x).height;
  }
  [[nodiscard]] double top(double /*from*/, double /*to*/) const noexcept override {
    return ground_.top();
  }
  [[nodiscard]] GroundBelow below(double t1, double /*t2*/) const noexcept override {
    const SurfaceLine line = ground_.surface_at(t1);
    return {line.height, line.slope, 0.0};
  }

 private:
  Ground ground_;
};

}  // namespace rondo::contact
