// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/case/ground/ground_shape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

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

/// @param numbers of the obstacles in the case
void check_obstacles(CaseValues& in, const std::vector<contact::Obstacle>& obstacles,
                     const std::vector<std::size_t>& numbers, const contact::GroundShape& base) {
  for (const contact::ObstacleFault& fault : contact::obstacle_faults(base, obstacles))
    in.refuse(key_of(numbers[fault.obstacle], fault.member), fault.message, fault.allowed);
}

void check_lengths(CaseValues& in, const std::vector<contact::Obstacle>& obstacles) {
  for (std::size_t k = 0; k < obstacles.size(); ++k)
    if (obstacles[k].kind == contact::ObstacleKind::step && in.has(key_of(k, "length")))
      in.refuse(key_of(k, "length"), "a step has no length", "a \"cleat\"; or no length");
}

bool is_level(const std::vector<Vec2>& profile) {
  return std::ranges::all_of(profile, [&](Vec2 p) { return p.y == profile.front().y; });
}

/// A plane body meets no edge at an angle.
void check_angles(CaseValues& in, const Case& c) {
  const auto& obstacles = c.ground->obstacles;
  for (std::size_t k = 0; k < obstacles.size(); ++k)
    if (obstacles[k].angle != 0.0 && !is_solid(c))
      in.refuse(key_of(k, "angle"), "a plane body has no width to meet an edge at an angle with",
                "0; or a disk.width");
}

/// Obstacles of one angle are those of a profile that is drawn normal to their edges, if that is
/// the same all along them.
bool needs_own_axes(const Case& c) {
  const auto& obstacles = c.ground->obstacles;
  const double angle = obstacles.front().angle;
  return is_on_road_surface(c) || (angle != 0.0 && !is_level(c.ground->profile)) ||
         std::ranges::any_of(obstacles,
                             [&](const contact::Obstacle& o) { return o.angle != angle; });
}

/// The obstacles as they follow each other normal to their edges.
std::vector<contact::Obstacle> normal_to_edges(std::vector<contact::Obstacle> obstacles) {
  for (contact::Obstacle& o : obstacles)
    if (o.angle != 0.0) o.at *= std::cos(o.angle);
  return obstacles;
}

/// What the obstacles make of the profile may have no room for the fillets of both.
void check_whole(CaseValues& in, double angle, const contact::GroundShape& whole) {
  for (const contact::ShapeFault& fault : contact::shape_faults(whole))
    in.fault(list,
             fmt::format("on this ground {}, near x = {:.6g} m",
                         fault.about_fillet ? "a fillet does not fit" : fault.message,
                         whole.profile[at(fault.point)].x / std::cos(angle)),
             "a smaller fillet, or another place");
}

/// All obstacles in the profile of the ground.
void draw_in_profile(CaseValues& in, Case& c, const contact::GroundShape& base) {
  const std::vector<contact::Obstacle> obstacles = normal_to_edges(c.ground->obstacles);
  std::vector<std::size_t> numbers(obstacles.size());
  std::iota(numbers.begin(), numbers.end(), std::size_t{0});
  check_obstacles(in, obstacles, numbers, base);
  if (!all_good(in, *c.ground)) return;
  contact::GroundShape whole = contact::with_obstacles(base, obstacles);
  const double angle = c.ground->obstacles.front().angle;
  check_whole(in, angle, whole);
  if (!in.good({list})) return;
  c.ground->shape = std::move(whole);
  c.ground->edge_angle = angle;
}

/// On ground that is not level contact is that of nodes, which a sharp edge passes between.
void refuse_sharp_edges(CaseValues& in, const GroundCase& ground) {
  for (std::size_t k = 0; k < ground.obstacles.size(); ++k)
    if (ground.obstacles[k].fillet == 0.0)
      in.refuse(key_of(k, "fillet"),
                "an obstacle at an angle on ground that is not level, or on a road under a wheel "
                "with a width, touches its nodes alone, between which a sharp edge passes",
                "> 0, best as long as the contact nodes are apart; or ground.profile = \"flat\"");
}

/// Obstacles in axes of their own stand on ground with one height and one slope at each place.
void refuse_corners_below(CaseValues& in, const contact::GroundShape& base) {
  const auto& p = base.profile;
  for (std::size_t i = 1; i < p.size(); ++i)
    if (!(std::abs(p[i].y - p[i - 1].y) <= p[i].x - p[i - 1].x))
      in.fault("ground.profile",
               fmt::format("is steeper than 45 degrees at x = {:.6g} m, and obstacles of several "
                           "angles stand on it, or obstacles at an angle",
                           p[i].x),
               "slopes of 1 at the most; or obstacles at the angle 0");
  if (!in.good({"ground.profile"})) return;
  const contact::Ground ground(base);
  if (!ground.corners().empty())
    in.fault("ground.profile",
             fmt::format("has a sharp corner at x = {:.6g} m, and obstacles of several angles "
                         "stand on it, or obstacles at an angle",
                         ground.corners().front().position.x),
             "a ground.fillet > 0; or obstacles at the angle 0");
}

void check_own_axes(CaseValues& in, Case& c, const contact::GroundShape& base) {
  const auto& all = c.ground->obstacles;
  std::vector<double> angles;
  for (const contact::Obstacle& o : all)
    if (std::ranges::find(angles, o.angle) == angles.end()) angles.push_back(o.angle);
  for (const double angle : angles) {
    std::vector<contact::Obstacle> obstacles;
    std::vector<std::size_t> numbers;
    for (std::size_t k = 0; k < all.size(); ++k)
      if (all[k].angle == angle) obstacles.push_back(all[k]), numbers.push_back(k);
    obstacles = normal_to_edges(std::move(obstacles));
    check_obstacles(in, obstacles, numbers, {});
    if (all_good(in, *c.ground)) check_whole(in, angle, contact::with_obstacles({}, obstacles));
  }
  if (is_on_road_surface(c) || !is_level(c.ground->profile)) refuse_sharp_edges(in, *c.ground);
  if (!is_on_road_surface(c)) refuse_corners_below(in, base);
  c.ground->shape = {};
  c.ground->has_own_axes = true;
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
  check_lengths(in, c.ground->obstacles);
  check_angles(in, c);
  if (!all_good(in, *c.ground)) return;
  if (needs_own_axes(c)) return check_own_axes(in, c, base);
  draw_in_profile(in, c, base);
}

}  // namespace rondo::study
