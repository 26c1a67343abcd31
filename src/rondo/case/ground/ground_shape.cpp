// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/case/ground/ground_shape.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "rondo/core/index.hpp"

namespace rondo::study {
namespace {

constexpr std::string_view list = "ground.obstacle";

std::string key_of(std::size_t obstacle, std::string_view member) {
  return fmt::format("{}.{}", item_of(list, obstacle), member);
}

/// Whether all keys of the obstacles have been read without a fault.
bool all_good(const CaseValues& in, const GroundCase& ground) {
  bool good = true;
  for (std::size_t k = 0; k < ground.obstacles.size(); ++k)
    for (const std::string_view member : {"kind", "at", "height", "length", "fillet"})
      good &= in.good({key_of(k, member)});
  return good;
}

void check_obstacles(CaseValues& in, const Case& c, const contact::GroundShape& base) {
  const auto& obstacles = c.ground->obstacles;
  for (const contact::ObstacleFault& fault : contact::obstacle_faults(base, obstacles))
    in.refuse(key_of(fault.obstacle, fault.member), fault.message, fault.allowed);
  for (std::size_t k = 0; k < obstacles.size(); ++k) {
    if (obstacles[k].kind == contact::ObstacleKind::step && in.has(key_of(k, "length")))
      in.refuse(key_of(k, "length"), "a step has no length", "a \"cleat\"; or no length");
  }
}

/// What the obstacles make of the profile may have no room for the fillets of both.
void check_whole(CaseValues& in, const contact::GroundShape& whole) {
  for (const contact::ShapeFault& fault : contact::shape_faults(whole))
    in.fault(list,
             fmt::format("on this ground {}, near x = {:.6g} m",
                         fault.about_fillet ? "a fillet does not fit" : fault.message,
                         whole.profile[at(fault.point)].x),
             "a smaller fillet, or another place");
}

}  // namespace

std::string fillet_key(const Case& c, double radius) {
  const auto& obstacles = c.ground->obstacles;
  const auto of = std::ranges::find(obstacles, radius, &contact::Obstacle::fillet);
  if (of == obstacles.end()) return "ground.fillet";
  return key_of(static_cast<std::size_t>(of - obstacles.begin()), "fillet");
}

void make_shape(CaseValues& in, Case& c) {
  if (!c.ground) return;
  const contact::GroundShape base{c.ground->profile, c.ground->fillet};
  c.ground->shape = base;
  if (c.ground->obstacles.empty() || !shape_faults(base).empty() || !all_good(in, *c.ground))
    return;
  check_obstacles(in, c, base);
  if (!all_good(in, *c.ground)) return;
  contact::GroundShape whole = contact::with_obstacles(base, c.ground->obstacles);
  check_whole(in, whole);
  if (in.good({list})) c.ground->shape = std::move(whole);
}

}  // namespace rondo::study
