// SPDX-License-Identifier: BSD-3-Clause
/// @file  The ground of a wheel in three dimensions, whatever its kind: ContactModel::space, or
/// where that is absent the profile of ContactModel::ground, extruded along its edges. Places are
/// (t1, n, t2) [m].
#pragma once
#include <cmath>
#include <limits>

#include "rondo/contact/space/space_ground.hpp"
#include "rondo/model/model.hpp"

namespace rondo::dynamics {

/// A place as the profile of ContactModel::ground sees it, along its edges.
[[nodiscard]] inline Vec2 on_profile(const ContactModel& contact, Vec3 place) noexcept {
  return contact.axes.from_ground(place).plane();
}

/// How many profiles the ground has whose corners may touch a body between its nodes: that of
/// ContactModel::ground, or those of the space ground.
[[nodiscard]] inline std::size_t profile_count(const ContactModel& contact) noexcept {
  return contact.space && !contact.space->edge_sets().empty() ? contact.space->edge_sets().size()
                                                              : 1;
}
/// @pre set < profile_count()
[[nodiscard]] inline const contact::Ground& profile_of(const ContactModel& contact,
                                                       std::size_t set) noexcept {
  return contact.space && !contact.space->edge_sets().empty()
             ? contact.space->edge_sets()[set].ground
             : contact.ground;
}
[[nodiscard]] inline const contact::EdgeAxes& axes_of(const ContactModel& contact,
                                                      std::size_t set) noexcept {
  return contact.space && !contact.space->edge_sets().empty() ? contact.space->edge_sets()[set].axes
                                                              : contact.axes;
}
/// A place as one of these profiles sees it, along its edges.
[[nodiscard]] inline Vec2 on_profile(const ContactModel& contact, std::size_t set,
                                     Vec3 place) noexcept {
  return contact.space && !contact.space->edge_sets().empty() ? contact.space->on_set(set, place)
                                                              : on_profile(contact, place);
}
/// Where a point of one of these profiles is in the middle of the track.
[[nodiscard]] inline Vec2 at_middle(const ContactModel& contact, std::size_t set,
                                    Vec2 point) noexcept {
  return {point.x / axes_of(contact, set).to_ground({1.0, 0.0, 0.0}).x, point.y};
}
/// What a point touches, in the axes of one of these profiles.
[[nodiscard]] inline contact::SetTouches touches_on_profile(const ContactModel& contact,
                                                            Vec3 place) noexcept {
  if (contact.space && !contact.space->edge_sets().empty())
    return contact.space->touches_on_set(place);
  return {0, contact.ground.touches(on_profile(contact, place))};
}

/// What a point touches.
[[nodiscard]] inline contact::SpaceTouches touches_in_space(const ContactModel& contact,
                                                            Vec3 place) noexcept {
  return contact.space
             ? contact.space->touches(place)
             : contact::extruded(contact.ground.touches(on_profile(contact, place)), contact.axes);
}

/// The surface that is nearest to a point, also for one outside of the ground. Above ground that is
/// no profile it is the plane that touches the surface straight below, exact where the gap closes;
/// an infinite gap: there is no ground.
[[nodiscard]] inline contact::SpaceTouch nearest_in_space(const ContactModel& contact,
                                                          Vec3 place) noexcept {
  if (!contact.space) {
    const contact::Touch near = contact.ground.facet_near(on_profile(contact, place));
    return {near.gap,
            {.normal = contact.axes.to_ground(near.normal),
             .line = contact.axes.to_ground({0.0, 0.0, 1.0})}};
  }
  if (const contact::SpaceTouches touches = contact.space->touches(place); touches.count > 0)
    return touches.at[0];
  constexpr double inside = 1e-10;  // [m]
  const double down = contact.space->clearance(place) + inside;
  if (!std::isfinite(down)) return {.gap = std::numeric_limits<double>::infinity(), .frame = {}};
  const contact::SpaceTouches below = contact.space->touches(place - Vec3{0.0, down, 0.0});
  if (below.count == 0) return {.gap = std::numeric_limits<double>::infinity(), .frame = {}};
  return {below.at[0].gap + down * below.at[0].frame.normal.y, below.at[0].frame};
}

/// No ground above this height between two places along t1 [m]; of a profile anywhere.
[[nodiscard]] inline double top_between(const ContactModel& contact, double from,
                                        double to) noexcept {
  return contact.space ? contact.space->top(from, to) : contact.ground.top();
}

/// Signed distance of a point to the ground [m]: that to the surface of a profile; else that along
/// the normal where the point is in the ground, and the height above it where it is not.
[[nodiscard]] inline double distance_in_space(const ContactModel& contact, Vec3 place) noexcept {
  if (!contact.space) return contact.ground.distance(on_profile(contact, place));
  const contact::SpaceTouches touches = contact.space->touches(place);
  return touches.count > 0 ? touches.at[0].gap : contact.space->clearance(place);
}

}  // namespace rondo::dynamics
