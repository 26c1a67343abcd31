// SPDX-License-Identifier: BSD-3-Clause
/// @file  Rigid ground under a wheel with a width, in the ground frame (t1, n, t2) of
/// core/ground_frame.hpp: a touch has a normal in space (docs/wheel3d.md, section 2). A profile
/// that is extruded along its edges needs nothing but ground.hpp and edge_axes.hpp; other kinds of
/// ground derive from SpaceGround.
#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "rondo/contact/ground.hpp"
#include "rondo/contact/space/edge_axes.hpp"
#include "rondo/core/vec3.hpp"

namespace rondo::contact {

/// The right-handed frame of a contact: its normal, its first tangent and its line, all unit
/// vectors with components along t1, n and t2.
struct SpaceFrame {
  Vec3 normal{0.0, 1.0, 0.0};  ///< out of the solid
  Vec3 line{0.0, 0.0, 1.0};    ///< the second tangent; t2 under a profile

  /// The first tangent; J n under a profile.
  [[nodiscard]] constexpr Vec3 tangent() const noexcept { return cross(line, normal); }
  /// Components along normal, tangent and line.
  [[nodiscard]] constexpr Vec3 to(Vec3 a) const noexcept {
    return {dot(normal, a), dot(tangent(), a), dot(line, a)};
  }
  /// The vector with these components.
  [[nodiscard]] constexpr Vec3 from(Vec3 a) const noexcept {
    return a.x * normal + a.y * tangent() + a.z * line;
  }
};

/// The frame of a normal whose tangent is in the plane of t1 and n, like J n.
/// @pre |normal| = 1, not along t2
[[nodiscard]] inline SpaceFrame frame_along_t1(Vec3 normal) noexcept {
  const double plane = std::hypot(normal.x, normal.y);
  return {normal, {-normal.z * normal.x / plane, -normal.z * normal.y / plane, plane}};
}

/// A place where a point touches the ground.
struct SpaceTouch {
  double gap = 0.0;  ///< signed distance along the normal, > 0 outside                      [m]
  SpaceFrame frame;
};

/// At most two touches at once, the deepest first. Two are those of a concave corner, whose
/// direction is the line of both.
struct SpaceTouches {
  int count = 0;
  std::array<SpaceTouch, 2> at;
};

/// The touches of a profile that is extruded along its edges.
[[nodiscard]] inline SpaceTouches extruded(const Touches& plane,
                                           const EdgeAxes& axes = {}) noexcept {
  SpaceTouches out{.count = plane.count, .at = {}};
  for (std::size_t i = 0; i < static_cast<std::size_t>(plane.count); ++i)
    out.at[i] = {
        plane.at[i].gap,
        {.normal = axes.to_ground(plane.at[i].normal), .line = axes.to_ground({0.0, 0.0, 1.0})}};
  return out;
}

/// A profile that is drawn normal to edges of one direction.
struct EdgeSet {
  EdgeAxes axes;
  Ground ground;
};

/// What a point touches by the profile of one set.
struct SetTouches {
  std::size_t set = 0;
  Touches touches;
};

/// Ground that is not the same all along t2. Places are (t1, n, t2) [m].
class SpaceGround {
 public:
  virtual ~SpaceGround() = default;

  /// What a point touches, with gap <= 0. Allocates nothing.
  [[nodiscard]] virtual SpaceTouches touches(Vec3 place) const noexcept = 0;
  /// Height of the point over the ground that is straight below it or, if < 0, above it [m].
  [[nodiscard]] virtual double clearance(Vec3 place) const noexcept = 0;
  /// No ground above this height between two places along t1, as far as the wheel comes along t2
  /// [m].
  [[nodiscard]] virtual double top(double from, double to) const noexcept = 0;

  /// Profiles whose corners may touch a body between its nodes; none: nodes alone touch the ground.
  [[nodiscard]] virtual std::span<const EdgeSet> edge_sets() const noexcept { return {}; }
  /// A place as the profile of a set sees it. @pre set < edge_sets().size()
  [[nodiscard]] virtual Vec2 on_set(std::size_t /*set*/, Vec3 place) const noexcept {
    return place.plane();
  }
  /// What a point touches, in the axes of a set. @pre edge_sets() is not empty
  [[nodiscard]] virtual SetTouches touches_on_set(Vec3 /*place*/) const noexcept { return {}; }

 protected:
  SpaceGround() = default;
  SpaceGround(const SpaceGround&) = default;
  SpaceGround& operator=(const SpaceGround&) = default;
};

}  // namespace rondo::contact
