// SPDX-License-Identifier: BSD-3-Clause
/// @file  The smooth surface of a measured road as the ground of a wheel with a width
/// (docs/roads.md, section 4).
#pragma once
#include <vector>

#include "rondo/contact/space/base_ground.hpp"
#include "rondo/road/road_part.hpp"
#include "rondo/road/surface.hpp"

namespace rondo::contact {

/// Where the ground frame lies on a road: t1 = u - start, t2 = offset - v, and n is the height less
/// `height`.
struct RoadPlacing {
  double start = 0.0;   ///< u at t1 = 0                                                      [m]
  double offset = 0.0;  ///< v at t2 = 0                                                      [m]
  double height = 0.0;  ///< of the road where n = 0                                          [m]
};

/// The foot of a point on the surface: the place whose normal leads to the point.
struct RoadFoot {
  double u = 0.0, v = 0.0;  ///< [m]
  road::SurfacePoint surface;
};

/// One touch for each point straight below the surface. Its gap is n·(x - p) with the foot p and
/// the normal n of the surface there; the foot is found by Newton's method from the point of the
/// surface straight above.
class RoadGround final : public BaseGround {
 public:
  static constexpr int newton_steps = 2;  ///< at most

  /// @param part of the road that the wheel comes to; top() holds for it
  /// @pre the part has a height everywhere
  RoadGround(road::Surface surface, const RoadPlacing& placing, const road::RoadPart& part = {});

  [[nodiscard]] SpaceTouches touches(Vec3 place) const noexcept override;
  [[nodiscard]] double clearance(Vec3 place) const noexcept override;
  [[nodiscard]] double top(double from, double to) const noexcept override;
  [[nodiscard]] GroundBelow below(double t1, double t2) const noexcept override;

  /// The foot of a point, by at most so many steps.
  [[nodiscard]] RoadFoot foot_of(Vec3 place, int steps = newton_steps) const noexcept;
  [[nodiscard]] const road::Surface& surface() const noexcept { return surface_; }

 private:
  [[nodiscard]] RoadFoot straight_foot(Vec3 place) const noexcept;
  [[nodiscard]] SpaceTouch touch_at(const RoadFoot& foot, Vec3 place) const noexcept;
  void improve(RoadFoot& foot, Vec3 place, int steps) const noexcept;
  void find_tops(const road::RoadPart& part);

  road::Surface surface_;
  RoadPlacing placing_;
  std::vector<double> tops_;  ///< the highest points of rows that follow each other, see row_block
  double top_ = 0.0;          ///< the largest of them                                        [m]
  double beyond_ = 0.0;       ///< the highest place before and behind the grid               [m]
};

}  // namespace rondo::contact
