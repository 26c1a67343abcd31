// SPDX-License-Identifier: BSD-3-Clause
/// @file  Obstacles on the ground: cleats, steps and potholes across the track, at an angle to it
/// in three dimensions (docs/roads.md). An obstacle adds its height to that of the ground.
#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "rondo/contact/ground.hpp"

namespace rondo::contact {

enum class ObstacleKind {
  cleat,    ///< a bar of rectangular section
  step,     ///< behind it the ground goes on at another level
  pothole,  ///< a trough of rectangular section
};

/// Its edges are parallel lines. The first one crosses the middle of the track (t2 = 0) at x =
/// `at`.
struct Obstacle {
  ObstacleKind kind = ObstacleKind::cleat;
  double at = 0.0;      ///< where it begins, seen by a wheel that rolls towards +x             [m]
  double height = 0.0;  ///< of a cleat, > 0; of a step, < 0: down; of a pothole: its depth, > 0 [m]
  double length = 0.0;  ///< of a cleat or pothole, normal to its edges, > 0                    [m]
  double angle = 0.0;   ///< of its edges to t2, > 0: the left side (t2 < 0) meets it first    [rad]
  double fillet = 0.0;  ///< radius of its convex edges, 0: sharp                               [m]
};

/// Something wrong with an obstacle, by the name of its member.
struct ObstacleFault {
  std::size_t obstacle = 0;
  std::string member, message, allowed;
};

/// All that is wrong with obstacles, as they follow each other normal to their edges, by
/// themselves, and with pairs that overlap where they cross the middle of the track. @pre
/// shape_faults(base) is empty
[[nodiscard]] std::vector<ObstacleFault> obstacle_faults(const GroundShape& base,
                                                         std::span<const Obstacle> obstacles);

/// The ground with the obstacles on it as if they lay straight across, whatever their angles. @pre
/// shape_faults(base) and obstacle_faults(base, obstacles) are empty
[[nodiscard]] GroundShape with_obstacles(const GroundShape& base,
                                         std::span<const Obstacle> obstacles);

}  // namespace rondo::contact
