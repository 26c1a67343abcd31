// SPDX-License-Identifier: BSD-3-Clause
/// @file  Obstacles, each at an angle of its own, on a road, on a profile or on level ground, under
/// a wheel in three dimensions (docs/roads.md, section 5). Obstacles of one
/// angle on level ground need none of this: they are a profile in the axes of their edges.
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "rondo/contact/obstacle.hpp"
#include "rondo/contact/space/base_ground.hpp"

namespace rondo::contact {

/// The height is that of the base plus those of the obstacles. A point is seen in the axes of the
/// edges, its height counted from the base straight below it: there the obstacles of one angle are
/// a profile on level ground, in whose solid the point is exactly if it is in the ground. A facet
/// that is not level there has the normal and the gap (to first order in the depth) of the surface
/// that the map back makes of it. A level facet is the base, moved up or down.
class ObstacleGround final : public SpaceGround {
 public:
  /// @pre obstacles of one angle have no obstacle_faults() and a shape; others do not overlap where
  /// points come
  /// @param spacing of the nodes, if corners and small arcs are to touch a body between these; 0:
  /// they do not                                                                            [m]
  /// @pre spacing = 0 or the base is level
  ObstacleGround(std::shared_ptr<const BaseGround> base, std::span<const Obstacle> obstacles,
                 double spacing = 0.0);

  [[nodiscard]] SpaceTouches touches(Vec3 place) const noexcept override;
  [[nodiscard]] double clearance(Vec3 place) const noexcept override;
  [[nodiscard]] double top(double from, double to) const noexcept override;
  [[nodiscard]] std::span<const EdgeSet> edge_sets() const noexcept override;
  [[nodiscard]] Vec2 on_set(std::size_t set, Vec3 place) const noexcept override;
  [[nodiscard]] SetTouches touches_on_set(Vec3 place) const noexcept override;

 private:
  [[nodiscard]] static double height_of(const EdgeSet& set, Vec3 place) noexcept;
  [[nodiscard]] double level_at(Vec3 place) const noexcept;
  [[nodiscard]] Vec2 seen(std::size_t set, Vec3 place, const GroundBelow& below) const noexcept;
  [[nodiscard]] SetTouches find(Vec3 place, const GroundBelow& below) const noexcept;
  [[nodiscard]] SpaceTouches on_base(Vec3 place, const GroundBelow& below,
                                     double gap) const noexcept;
  [[nodiscard]] SpaceTouch on_facet(Vec3 place, const GroundBelow& below, const EdgeSet& set,
                                    const Touch& touch) const noexcept;

  std::shared_ptr<const BaseGround> base_;
  std::vector<EdgeSet> sets_;
  double spacing_ = 0.0;
  double top_ = 0.0;  ///< no place is higher above the base                                  [m]
};

}  // namespace rondo::contact
