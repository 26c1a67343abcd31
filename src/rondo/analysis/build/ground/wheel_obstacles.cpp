// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/build/ground/wheel_obstacles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "rondo/analysis/build/ground/road_reach.hpp"
#include "rondo/case/case_keys.hpp"
#include "rondo/contact/space/obstacle_ground.hpp"
#include "rondo/core/contract.hpp"

namespace rondo::study {
namespace {

using contact::Obstacle;
using contact::ObstacleKind;

/// Obstacles that touch each other do not overlap [m].
constexpr double one_place = 1e-9;

double begin_at(const Obstacle& o, double t2) {
  return o.at + std::tan(o.angle) * t2;
}

double end_at(const Obstacle& o, double t2) {
  const double length = o.kind == ObstacleKind::step ? 0.0 : o.length / std::cos(o.angle);
  return begin_at(o, t2) + length;
}

/// Edges are straight: one obstacle is before another all across if it is so on both sides.
bool is_before(const Obstacle& a, const Obstacle& b, const Stretch& across) {
  return end_at(a, across.from) <= begin_at(b, across.from) + one_place &&
         end_at(a, across.to) <= begin_at(b, across.to) + one_place;
}

void refuse_overlaps_across(const Case& c, const Stretch& across) {
  const auto& all = c.ground->obstacles;
  const auto [left, right] = across;
  for (std::size_t k = 1; k < all.size(); ++k)
    for (std::size_t i = 0; i < k; ++i)
      if (!is_before(all[i], all[k], across) && !is_before(all[k], all[i], across))
        throw case_error(
            c, item_of("ground.obstacle", k) + ".at",
            fmt::format("meets ground.obstacle[{}] where the wheel comes: it is at x = {:.4g} to "
                        "{:.4g} m where t2 = {:.3g} m and {:.4g} to {:.4g} m where t2 = {:.3g} m, "
                        "and the other one at {:.4g} to {:.4g} m and {:.4g} to {:.4g} m",
                        i, begin_at(all[k], left), end_at(all[k], left), left,
                        begin_at(all[k], right), end_at(all[k], right), right,
                        begin_at(all[i], left), end_at(all[i], left), begin_at(all[i], right),
                        end_at(all[i], right)),
            "obstacles one behind the other all across the track of the wheel");
}

/// On level ground edges touch the wheel between its nodes, as those of a profile do.
bool stand_on_level_ground(const Case& c) {
  const auto& p = c.ground->profile;
  return !is_on_road_surface(c) &&
         std::ranges::all_of(p, [&](Vec2 point) { return point.y == p.front().y; });
}

void warn_of_small_fillets(const Case& c, Setup& s) {
  const double spacing = s.model.contact->ground.spacing();
  const auto warn = [&](const std::string& key, double fillet) {
    s.warnings.push_back(fmt::format(
        "{}: the radius of {:.3g} m is below the {:.3g} m between two contact nodes, which alone "
        "touch obstacles on a road, or at an angle on ground that is not level: an edge passes "
        "between them, and forces "
        "depend on where they happen to be, which runs with motion.start_x moved by parts of the "
        "spacing show; give a fillet of at least {:.3g} m, or a finer mesh",
        key, fillet, spacing, spacing));
  };
  if (c.ground->fillet > 0.0 && c.ground->fillet < spacing) warn("ground.fillet", c.ground->fillet);
  for (std::size_t k = 0; k < c.ground->obstacles.size(); ++k)
    if (const double fillet = c.ground->obstacles[k].fillet; fillet < spacing)
      return warn(item_of("ground.obstacle", k) + ".fillet", fillet);
}

}  // namespace

std::shared_ptr<const contact::SpaceGround> obstacles_on(
    const Case& c, std::shared_ptr<const contact::BaseGround> base, Setup& s) {
  RONDO_DEMAND(c.ground && s.model.contact && s.model.solid, c.ground.has_value());
  if (!has_obstacles_of_own_axes(c)) return base;
  refuse_overlaps_across(c, reach_across(c, s.mesh));
  const bool is_level = stand_on_level_ground(c);
  if (!is_level) warn_of_small_fillets(c, s);
  return std::make_shared<const contact::ObstacleGround>(
      std::move(base), c.ground->obstacles, is_level ? s.model.contact->ground.spacing() : 0.0);
}

void set_wheel_obstacles(const Case& c, Setup& s) {
  if (!has_obstacles_of_own_axes(c) || is_on_road_surface(c) || !s.model.contact) return;
  const contact::GroundShape base{c.ground->profile, c.ground->fillet};
  s.model.contact->space =
      obstacles_on(c, std::make_shared<const contact::ProfileGround>(contact::Ground(base)), s);
}

}  // namespace rondo::study
