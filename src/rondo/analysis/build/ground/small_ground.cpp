// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/build/ground/small_ground.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "rondo/case/ground/ground_shape.hpp"
#include "rondo/contact/intrusion.hpp"
#include "rondo/model/solid/wheel_ground.hpp"

namespace rondo::study {
namespace {

constexpr const char* where_they_are =
    "its force is that of a point and depends on where the nodes happen to be, which runs with "
    "motion.start_x moved by parts of the spacing show";

std::string small_obstacle(const Case& c, const dynamics::ContactModel& contact, std::size_t set) {
  const contact::Ground& ground = profile_of(contact, set);
  const double spacing = ground.spacing();
  const contact::Intrusion obstacle = contact::hidden_between_nodes(ground, spacing).whole;
  if (!(obstacle.depth > contact::least_hidden * spacing)) return {};
  const Vec2 place = at_middle(contact, set, obstacle.at);
  return fmt::format(
      "{}: the obstacle {:.3g} m high at ({:.6g}, {:.6g}) m is shorter than the {:.3g} "
      "m between two contact nodes: {}; give an obstacle several times as long, or a finer mesh",
      ground_key(c), obstacle.depth, place.x, place.y, spacing, where_they_are);
}

std::string small_fillet(const Case& c, const dynamics::ContactModel& contact, std::size_t set) {
  const contact::Ground& ground = profile_of(contact, set);
  const double spacing = ground.spacing();
  const auto round = std::ranges::find_if(
      ground.corners(), [](const contact::Corner& corner) { return corner.radius > 0.0; });
  if (round == ground.corners().end()) return {};
  const double fillet = round->radius;
  const Vec2 first = at_middle(contact, set, round->position);
  return fmt::format(
      "{}: the radius of {:.3g} m is below the {:.3g} m between two contact nodes, and "
      "the corner at ({:.6g}, {:.6g}) m counts as sharp: {}; give a fillet of at least {:.3g} m, "
      "or a finer mesh",
      fillet_key(c, fillet), fillet, spacing, first.x, first.y, where_they_are, spacing);
}

}  // namespace

std::string small_ground(const Case& c, const Setup& s) {
  if (!s.model.contact || !(s.model.contact->ground.spacing() > 0.0)) return {};
  std::string told;
  for (std::size_t set = 0; set < profile_count(*s.model.contact) && told.empty(); ++set) {
    told = small_obstacle(c, *s.model.contact, set);
    if (told.empty()) told = small_fillet(c, *s.model.contact, set);
  }
  return told;
}

}  // namespace rondo::study
