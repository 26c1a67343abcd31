// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/contact/space/obstacle_ground.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "rondo/core/contract.hpp"

namespace rondo::contact {
namespace {

bool is_level(const Touch& touch) noexcept {
  return touch.normal.x == 0.0;
}

/// Whether the nearest surface is that of an edge, or of the ground at its foot.
bool is_at_edge(const Touches& touches) noexcept {
  for (std::size_t i = 0; i < static_cast<std::size_t>(touches.count); ++i)
    if (!is_level(touches.at[i])) return true;
  return false;
}

/// Gap to the nearest of the facets.
double nearest_gap(const Touches& touches) noexcept {
  return touches.at[static_cast<std::size_t>(touches.count) - 1].gap;
}

/// The part of the direction of the edges that is along the facet.
Vec3 line_along(Vec3 edges, Vec3 normal) noexcept {
  const Vec3 line = edges - dot(edges, normal) * normal;
  return line / norm(line);
}

/// Both facets of a concave corner have its direction as their line.
void share_line(Vec3 edges, SpaceTouches& touches) noexcept {
  const Vec3 across = cross(touches.at[0].frame.normal, touches.at[1].frame.normal);
  const Vec3 line = across / std::copysign(norm(across), dot(across, edges));
  for (SpaceTouch& touch : touches.at) touch.frame.line = line;
}

}  // namespace

ObstacleGround::ObstacleGround(std::shared_ptr<const BaseGround> base,
                               std::span<const Obstacle> obstacles, double spacing)
    : base_(std::move(base)), spacing_(spacing) {
  RONDO_DEMAND(base_ != nullptr && !obstacles.empty(), obstacles.size());
  std::vector<Obstacle> left(obstacles.begin(), obstacles.end());
  while (!left.empty()) {
    const double angle = left.front().angle;
    std::vector<Obstacle> same;
    for (Obstacle o : left) {
      if (o.angle != angle) continue;
      o.at *= std::cos(angle);
      same.push_back(o);
    }
    std::erase_if(left, [&](const Obstacle& o) { return o.angle == angle; });
    sets_.push_back({EdgeAxes(angle), Ground(with_obstacles(GroundShape{}, same), spacing)});
    top_ += std::max(0.0, sets_.back().ground.top());
  }
}

double ObstacleGround::height_of(const EdgeSet& set, Vec3 place) noexcept {
  return set.ground.surface_at(set.axes.from_ground(place).x).height;
}

double ObstacleGround::level_at(Vec3 place) const noexcept {
  double level = 0.0;
  for (const EdgeSet& set : sets_) level += height_of(set, place);
  return level;
}

double ObstacleGround::clearance(Vec3 place) const noexcept {
  return base_->clearance(place) - level_at(place);
}

double ObstacleGround::top(double from, double to) const noexcept {
  return base_->top(from, to) + top_;
}

std::span<const EdgeSet> ObstacleGround::edge_sets() const noexcept {
  if (spacing_ > 0.0) return sets_;
  return {};
}

Vec2 ObstacleGround::seen(std::size_t set, Vec3 place, const GroundBelow& below) const noexcept {
  double level = below.height;
  for (std::size_t k = 0; k < sets_.size(); ++k)
    if (k != set) level += height_of(sets_[k], place);
  return {sets_[set].axes.from_ground(place).x, place.y - level};
}

Vec2 ObstacleGround::on_set(std::size_t set, Vec3 place) const noexcept {
  return seen(set, place, base_->below(place.x, place.z));
}

SetTouches ObstacleGround::touches_on_set(Vec3 place) const noexcept {
  return find(place, base_->below(place.x, place.z));
}

/// Sees the point in the axes of each set, on ground as high as the other sets make it there, and
/// takes the one whose edge is the nearest; any, if there is no edge near.
SetTouches ObstacleGround::find(Vec3 place, const GroundBelow& below) const noexcept {
  SetTouches best;
  for (std::size_t k = 0; k < sets_.size(); ++k) {
    const Touches touches = sets_[k].ground.touches(seen(k, place, below));
    if (touches.count == 0) return {};
    const bool is_nearer =
        is_at_edge(touches) &&
        (!is_at_edge(best.touches) || nearest_gap(touches) > nearest_gap(best.touches));
    if (k == 0 || is_nearer) best = {k, touches};
  }
  return best;
}

/// Touches of the base, as if it lay so high that the point is `gap` above it.
SpaceTouches ObstacleGround::on_base(Vec3 place, const GroundBelow& below,
                                     double gap) const noexcept {
  return base_->touches({place.x, below.height + gap, place.z});
}

/// The gradient of the gap in the axes of the set, with (t1, n, t2) mapped to them: the height
/// above the base falls where the base rises.
SpaceTouch ObstacleGround::on_facet(Vec3 place, const GroundBelow& below, const EdgeSet& set,
                                    const Touch& touch) const noexcept {
  if (is_level(touch)) {
    const SpaceTouches base = on_base(place, below, touch.gap);
    if (base.count > 0) return base.at[0];
  }
  const Vec3 gradient = set.axes.to_ground({touch.normal.x, touch.normal.y, 0.0}) -
                        touch.normal.y * Vec3{below.along_t1, 0.0, below.along_t2};
  const double length = norm(gradient);
  const Vec3 normal = gradient / length;
  return {touch.gap / length,
          {.normal = normal, .line = line_along(set.axes.to_ground({0.0, 0.0, 1.0}), normal)}};
}

SpaceTouches ObstacleGround::touches(Vec3 place) const noexcept {
  const GroundBelow below = base_->below(place.x, place.z);
  // The comparison is also false where there is no ground.
  if (!(place.y - below.height <= top_)) return {};
  const auto [set, found] = find(place, below);
  if (found.count == 0) return {};
  if (!is_at_edge(found)) return on_base(place, below, found.at[0].gap);
  SpaceTouches out{.count = found.count, .at = {}};
  for (std::size_t i = 0; i < static_cast<std::size_t>(found.count); ++i)
    out.at[i] = on_facet(place, below, sets_[set], found.at[i]);
  if (out.count == 2) share_line(sets_[set].axes.to_ground({0.0, 0.0, 1.0}), out);
  return out;
}

}  // namespace rondo::contact
