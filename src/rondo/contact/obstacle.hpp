// SPDX-License-Identifier: BSD-3-Clause
/// @file  Obstacles on the ground: cleats, steps and potholes across the track, at an angle to it
/// in three dimensions (docs/roads.md).
#pragma once

namespace rondo::contact {

enum class ObstacleKind {
  cleat,    ///< a bar of rectangular section on the ground
  step,     ///< the ground goes on at another level behind it
  pothole,  ///< a trough of rectangular section
};

/// Along a line that crosses the middle of the track (t2 = 0) at x = `at`.
struct Obstacle {
  ObstacleKind kind = ObstacleKind::cleat;
  double at = 0.0;      ///< where it begins: its edge that faces a wheel rolling towards +x    [m]
  double height = 0.0;  ///< of a cleat, > 0; of a step, < 0: down; of a pothole: its depth, > 0 [m]
  double length = 0.0;  ///< of a cleat or pothole, across its own edges, > 0                   [m]
  double angle = 0.0;   ///< of its edges from t2, positive from t2 towards t1; 0: straight    [rad]
  double fillet = 0.0;  ///< radius of its convex edges, 0: sharp                               [m]
};

}  // namespace rondo::contact
