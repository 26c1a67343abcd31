// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/contact/obstacle.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "rondo/core/contract.hpp"

namespace rondo::contact {
namespace {

/// Places that are nearer to each other than this are one [m].
constexpr double one_place = 1e-9;

/// A place where the level of the ground changes, with the fillet of the edge there.
struct Rise {
  double at, height, fillet;  ///< [m]
};

double end_of(const Obstacle& o) {
  return o.kind == ObstacleKind::step ? o.at : o.at + o.length;
}

/// Where several obstacles meet, their rises are one.
std::vector<Rise> joined(const std::vector<Rise>& rises) {
  std::vector<Rise> out;
  for (const Rise& rise : rises)
    if (!out.empty() && rise.at - out.back().at < one_place) {
      out.back().height += rise.height;
      out.back().fillet = std::min(out.back().fillet, rise.fillet);
    } else {
      out.push_back(rise);
    }
  std::erase_if(out, [](const Rise& rise) { return rise.height == 0.0; });
  return out;
}

std::vector<Rise> rises_of(std::span<const Obstacle> obstacles) {
  std::vector<Rise> rises;
  for (const Obstacle& o : obstacles) {
    const double height = o.kind == ObstacleKind::pothole ? -o.height : o.height;
    rises.push_back({o.at, height, o.fillet});
    if (o.kind != ObstacleKind::step) rises.push_back({end_of(o), -height, o.fillet});
  }
  std::ranges::stable_sort(rises, {}, &Rise::at);
  return joined(rises);
}

/// Height of the line through two points. @pre a.x < b.x
double on_line(Vec2 a, Vec2 b, double x) {
  return a.y + (b.y - a.y) * ((x - a.x) / (b.x - a.x));
}

/// Heights of the ground on the left and on the right of a vertical line. Its points that are as
/// near to that as one place are on it.
std::pair<double, double> heights_at(const std::vector<Vec2>& p, double x) {
  const auto first = std::ranges::lower_bound(p, x - one_place, {}, &Vec2::x);
  const auto after = std::ranges::upper_bound(p, x + one_place, {}, &Vec2::x);
  if (first != after) return {first->y, std::prev(after)->y};
  const auto end = std::clamp(after, std::next(p.begin()), std::prev(p.end()));
  const double y = on_line(*std::prev(end), *end, x);
  return {y, y};
}

/// Adds points from left to right, none of them twice.
class Outline {
 public:
  explicit Outline(const GroundShape& base) : base_(base) {}

  void add(Vec2 point, double fillet) {
    if (!shape_.profile.empty() && shape_.profile.back() == point) {
      shape_.radii.back() = std::max(shape_.radii.back(), fillet);
      return;
    }
    shape_.profile.push_back(point);
    shape_.radii.push_back(fillet);
  }
  /// Points of the ground as it was, up to x; those at x itself are left to a rise there.
  void add_ground_before(double x) {
    for (; next_ < base_.profile.size() && base_.profile[next_].x < x - one_place; ++next_)
      add(base_.profile[next_] + Vec2{0.0, level_}, base_.radius_at(next_));
    while (next_ < base_.profile.size() && base_.profile[next_].x <= x + one_place) ++next_;
  }
  void add_rise(const Rise& rise, double left, double right) {
    add({rise.at, left + level_}, rise.fillet);
    level_ += rise.height;
    add({rise.at, right + level_}, rise.fillet);
  }
  [[nodiscard]] GroundShape shape() && { return std::move(shape_); }

 private:
  const GroundShape& base_;
  GroundShape shape_{.profile = {}, .fillet = base_.fillet, .radii = {}};
  std::size_t next_ = 0;
  double level_ = 0.0;
};

/// The ends of a profile are directions, too: a rise at an end, or beyond it, is none.
void keep_ends_going(const GroundShape& base, std::span<const Rise> rises, GroundShape& shape) {
  const std::vector<Vec2>& p = base.profile;
  if (rises.empty()) return;
  if (rises.front().at <= p.front().x + one_place) {
    const double x = rises.front().at - 1.0;
    shape.profile.insert(shape.profile.begin(), {x, on_line(p[0], p[1], x)});
    shape.radii.insert(shape.radii.begin(), 0.0);
  }
  if (rises.back().at >= p.back().x - one_place) {
    const Vec2 a = p[p.size() - 2], b = p.back(), last = shape.profile.back();
    const double x = last.x + 1.0;
    shape.profile.push_back({x, last.y + on_line(a, b, x) - on_line(a, b, last.x)});
    shape.radii.push_back(0.0);
  }
}

std::string_view name_of_height(const Obstacle& o) {
  return o.kind == ObstacleKind::pothole ? "depth" : "height";
}

void check_size(std::size_t k, const Obstacle& o, std::vector<ObstacleFault>& faults) {
  const bool steps = o.kind == ObstacleKind::step;
  if (steps ? o.height == 0.0 : !(o.height > 0.0))
    faults.push_back({k, "height",
                      fmt::format("there is no {} of {:.6g} m", name_of_height(o), o.height),
                      steps ? "> 0: up, or < 0: down" : "> 0"});
  if (!steps && !(o.length > 0.0))
    faults.push_back({k, "length", fmt::format("there is no length of {:.6g} m", o.length), "> 0"});
  if (o.fillet > std::abs(o.height))
    faults.push_back({k, "fillet",
                      fmt::format("does not fit: it needs {:.6g} m of the {} of {:.6g} m", o.fillet,
                                  name_of_height(o), std::abs(o.height)),
                      fmt::format("0 to {:.6g}", std::abs(o.height))});
  else if (o.kind == ObstacleKind::cleat && 2.0 * o.fillet > o.length)
    faults.push_back({k, "fillet",
                      fmt::format("does not fit: it needs {:.6g} m of the length of {:.6g} m",
                                  2.0 * o.fillet, o.length),
                      fmt::format("0 to {:.6g}", 0.5 * o.length)});
}

void check_pair(std::size_t k, const Obstacle& before, const Obstacle& o,
                std::vector<ObstacleFault>& faults) {
  if (o.at > end_of(before) - one_place) return;
  const auto in_the_middle = [&](double x) { return x / std::cos(before.angle); };
  faults.push_back({k, "at",
                    fmt::format("begins within the obstacle from x = {:.6g} to {:.6g} m",
                                in_the_middle(before.at), in_the_middle(end_of(before))),
                    "obstacles one behind the other"});
}

/// Where the ground ends as a wall there is none behind it.
void check_ends(const std::vector<Vec2>& p, std::size_t k, const Obstacle& o,
                std::vector<ObstacleFault>& faults) {
  const bool before = p[0].x == p[1].x && o.at <= p[0].x;
  if (before || (p[p.size() - 2].x == p.back().x && end_of(o) >= p.back().x))
    faults.push_back({k, "at",
                      fmt::format("there is no ground: it ends with a wall at x = {:.6g} m",
                                  before ? p[0].x : p.back().x),
                      "a place on the ground"});
}

}  // namespace

std::vector<ObstacleFault> obstacle_faults(const GroundShape& base,
                                           std::span<const Obstacle> obstacles) {
  std::vector<ObstacleFault> faults;
  std::vector<std::size_t> order(obstacles.size());
  for (std::size_t k = 0; k < obstacles.size(); ++k) {
    check_size(k, obstacles[k], faults);
    check_ends(base.profile, k, obstacles[k], faults);
    order[k] = k;
  }
  std::ranges::stable_sort(order, {}, [&](std::size_t k) { return obstacles[k].at; });
  for (std::size_t i = 1; i < order.size(); ++i)
    check_pair(order[i], obstacles[order[i - 1]], obstacles[order[i]], faults);
  return faults;
}

GroundShape with_obstacles(const GroundShape& base, std::span<const Obstacle> obstacles) {
  if (obstacles.empty()) return base;
  Outline outline(base);
  const std::vector<Rise> rises = rises_of(obstacles);
  for (const Rise& rise : rises) {
    const auto [left, right] = heights_at(base.profile, rise.at);
    outline.add_ground_before(rise.at);
    outline.add_rise(rise, left, right);
  }
  outline.add_ground_before(std::numeric_limits<double>::infinity());
  GroundShape shape = std::move(outline).shape();
  keep_ends_going(base, rises, shape);
  return shape;
}

}  // namespace rondo::contact
