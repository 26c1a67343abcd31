// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/case/ground/ground_shape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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
    for (const std::string_view member : {"kind", "at", "height", "length", "angle", "fillet"})
      good &= in.good({key_of(k, member)});
  return good;
}

void check_obstacles(CaseValues& in, const std::vector<contact::Obstacle>& obstacles,
                     const contact::GroundShape& base) {
  for (const contact::ObstacleFault& fault : contact::obstacle_faults(base, obstacles))
    in.refuse(key_of(fault.obstacle, fault.member), fault.message, fault.allowed);
  for (std::size_t k = 0; k < obstacles.size(); ++k)
    if (obstacles[k].kind == contact::ObstacleKind::step && in.has(key_of(k, "length")))
      in.refuse(key_of(k, "length"), "a step has no length", "a \"cleat\"; or no length");
}

void refuse_on_road(CaseValues& in) {
  in.refuse(item_of(list, 0),
            "a road under a wheel with a width carries no obstacles: its surface has a slope of 1 "
            "at the most",
            "ground.profile in its place; or the obstacle in the heights of the file");
}

/// Edges at an angle are those of one profile, seen normal to them: the ground below them is level.
void check_angles(CaseValues& in, const Case& c) {
  const auto& obstacles = c.ground->obstacles;
  const auto& profile = c.ground->profile;
  const bool level = std::ranges::all_of(profile, [&](Vec2 p) { return p.y == profile.front().y; });
  for (std::size_t k = 0; k < obstacles.size(); ++k) {
    const std::string key = key_of(k, "angle");
    if (obstacles[k].angle != obstacles[0].angle)
      in.refuse(
          key,
          fmt::format("is another one than that of the first obstacle, {:.6g}", obstacles[0].angle),
          "one angle for all obstacles");
    if (obstacles[k].angle == 0.0) continue;
    if (!is_solid(c))
      in.refuse(key, "a plane body has no width to meet an edge at an angle with",
                "0; or a disk.width");
    if (!level)
      in.refuse(key, "the ground below an edge at an angle must be level",
                "0; or ground.profile = \"flat\"");
  }
}

/// The obstacles as they follow each other normal to their edges.
std::vector<contact::Obstacle> normal_to_edges(std::vector<contact::Obstacle> obstacles) {
  for (contact::Obstacle& o : obstacles)
    if (o.angle != 0.0) o.at *= std::cos(o.angle);
  return obstacles;
}

/// What the obstacles make of the profile may have no room for the fillets of both.
void check_whole(CaseValues& in, const Case& c, const contact::GroundShape& whole) {
  const double turned = std::cos(c.ground->obstacles.front().angle);
  for (const contact::ShapeFault& fault : contact::shape_faults(whole))
    in.fault(list,
             fmt::format("on this ground {}, near x = {:.6g} m",
                         fault.about_fillet ? "a fillet does not fit" : fault.message,
                         whole.profile[at(fault.point)].x / turned),
             "a smaller fillet, or another place");
}

}  // namespace

Vec2 at_middle(const Case& c, Vec2 of_shape) {
  const double angle = c.ground->edge_angle;
  return angle == 0.0 ? of_shape : Vec2{of_shape.x / std::cos(angle), of_shape.y};
}

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
  if (is_on_road_surface(c)) return refuse_on_road(in);
  const std::vector<contact::Obstacle> obstacles = normal_to_edges(c.ground->obstacles);
  check_obstacles(in, obstacles, base);
  check_angles(in, c);
  if (!all_good(in, *c.ground)) return;
  contact::GroundShape whole = contact::with_obstacles(base, obstacles);
  check_whole(in, c, whole);
  if (!in.good({list})) return;
  c.ground->shape = std::move(whole);
  c.ground->edge_angle = c.ground->obstacles.front().angle;
}

}  // namespace rondo::study
