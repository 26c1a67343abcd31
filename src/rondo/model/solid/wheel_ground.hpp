// SPDX-License-Identifier: BSD-3-Clause
/// @file  The ground of a wheel in three dimensions, whatever its kind: ContactModel::space, or
/// where that is absent the profile of ContactModel::ground, extruded along its edges. Places are
/// (t1, n, t2) [m].
#pragma once
#include "rondo/contact/space/space_ground.hpp"
#include "rondo/core/contract.hpp"
#include "rondo/model/model.hpp"

namespace rondo::dynamics {

/// A place as the profile of ContactModel::ground sees it, along its edges.
[[nodiscard]] inline Vec2 on_profile(const ContactModel& contact, Vec3 place) noexcept {
  return contact.axes.from_ground(place).plane();
}

/// What a point touches.
[[nodiscard]] inline contact::SpaceTouches touches_in_space(const ContactModel& contact,
                                                            Vec3 place) noexcept {
  return contact.space
             ? contact.space->touches(place)
             : contact::extruded(contact.ground.touches(on_profile(contact, place)), contact.axes);
}

/// The nearest place of the surface, also for a point outside of the ground. @pre a profile
[[nodiscard]] inline contact::SpaceTouch nearest_in_space(const ContactModel& contact,
                                                          Vec3 place) noexcept {
  RONDO_DEMAND(!contact.space);
  const contact::Touch near = contact.ground.facet_near(on_profile(contact, place));
  return {near.gap,
          {.normal = contact.axes.to_ground(near.normal),
           .line = contact.axes.to_ground({0.0, 0.0, 1.0})}};
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
