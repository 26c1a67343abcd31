// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/contact/space/road_ground.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "rondo/core/contract.hpp"

namespace rondo::contact {
namespace {

using road::Border;
using road::SurfacePoint;

/// So many rows of the grid have one highest point: a wheel lies over a few of these blocks.
constexpr std::size_t row_block = 64;

/// Newton's method ends with a step below this length: the next one changes the foot by less than
/// the round-off of coordinates [m].
constexpr double least_step = 1e-9;

/// Step of the foot of a point that is `above` below the surface at `from` it, towards the place
/// where (u, v, height) has the least distance. Where that distance is not convex, because the
/// point is deeper than the radius of a crest, the curvature is left out (Gauss–Newton).
Vec2 foot_step(const SurfacePoint& s, Vec2 from, double above) noexcept {
  const Vec2 slope{s.slope_u, s.slope_v}, gradient = from + above * slope;
  const auto solved = [&](double weight, Vec2& step) {
    const double uu = 1.0 + slope.x * slope.x + weight * s.bend_uu,
                 uv = slope.x * slope.y + weight * s.bend_uv,
                 vv = 1.0 + slope.y * slope.y + weight * s.bend_vv;
    const double determinant = uu * vv - uv * uv;
    if (!(uu > 0.0 && determinant > 0.0)) return false;
    step = Vec2{uv * gradient.y - vv * gradient.x, uv * gradient.x - uu * gradient.y} / determinant;
    return true;
  };
  Vec2 step;
  if (!solved(above, step)) static_cast<void>(solved(0.0, step));
  return step;
}

}  // namespace

RoadGround::RoadGround(road::Surface surface, const RoadPlacing& placing,
                       const road::RoadPart& part)
    : surface_(std::move(surface)), placing_(placing) {
  RONDO_DEMAND(std::isfinite(placing.start) && std::isfinite(placing.offset) &&
                   std::isfinite(placing.height),
               placing.start, placing.offset, placing.height);
  find_tops(part);
}

/// A patch stays between its corners, so that the highest points of the grid are enough.
void RoadGround::find_tops(const road::RoadPart& part) {
  const road::Axis &u = surface_.u_axis(), &v = surface_.v_axis();
  const bool beside = part.v_from < v.first() || part.v_to > v.last();
  const road::RoadCells cells = road::cells_in(surface_, beside ? road::RoadPart{} : part);
  const road::Edges& edges = surface_.edges();
  const double raised = beside ? std::max(0.0, edges.offset_v) : 0.0;
  constexpr double lowest = -std::numeric_limits<double>::infinity();
  tops_.assign((u.size() + row_block - 1) / row_block, lowest);
  for (std::size_t i = 0; i < u.size(); ++i) {
    double& top = tops_[i / row_block];
    for (std::size_t j = cells.v_begin; j <= cells.v_end; ++j)
      top = std::max(top, surface_.height_at(i, j) + raised);
    if (beside && edges.v == Border::zero) top = std::max(top, edges.offset_v);
  }
  for (double& top : tops_) top -= placing_.height;
  top_ = std::ranges::max(tops_);
  beyond_ = top_ + std::max(0.0, edges.offset_u);
  if (edges.u == Border::zero)
    beyond_ = std::max(beyond_, edges.offset_u + raised - placing_.height);
}

double RoadGround::top(double from, double to) const noexcept {
  const road::Axis& axis = surface_.u_axis();
  const double low = from + placing_.start, high = to + placing_.start;
  if (!(low >= axis.first() && high <= axis.last())) return beyond_;
  const std::size_t first = axis.locate(low).cell / row_block,
                    last = (axis.locate(high).cell + 1) / row_block;
  return *std::max_element(tops_.begin() + static_cast<std::ptrdiff_t>(first),
                           tops_.begin() + static_cast<std::ptrdiff_t>(last) + 1);
}

RoadFoot RoadGround::straight_foot(Vec3 place) const noexcept {
  RoadFoot foot{place.x + placing_.start, placing_.offset - place.z, {}};
  foot.surface = surface_.at(foot.u, foot.v);
  return foot;
}

double RoadGround::clearance(Vec3 place) const noexcept {
  const double above = place.y - (straight_foot(place).surface.height - placing_.height);
  return std::isnan(above) ? std::numeric_limits<double>::infinity() : above;
}

GroundBelow RoadGround::below(double t1, double t2) const noexcept {
  const road::SurfacePoint surface = straight_foot({t1, 0.0, t2}).surface;
  return {surface.height - placing_.height, surface.slope_u, -surface.slope_v};
}

void RoadGround::improve(RoadFoot& foot, Vec3 place, int steps) const noexcept {
  const double u = foot.u, v = foot.v;
  Vec2 from;
  for (int i = 0; i < steps; ++i) {
    const double above = foot.surface.height - placing_.height - place.y;
    const Vec2 step = foot_step(foot.surface, from, above);
    if (!(std::abs(step.x) + std::abs(step.y) > least_step)) return;
    const RoadFoot next{u + (from + step).x, v + (from + step).y,
                        surface_.at(u + (from + step).x, v + (from + step).y)};
    if (std::isnan(next.surface.height)) return;
    from = from + step;
    foot = next;
  }
}

RoadFoot RoadGround::foot_of(Vec3 place, int steps) const noexcept {
  RoadFoot foot = straight_foot(place);
  if (!std::isnan(foot.surface.height)) improve(foot, place, steps);
  return foot;
}

SpaceTouch RoadGround::touch_at(const RoadFoot& foot, Vec3 place) const noexcept {
  const double along_u = foot.surface.slope_u, along_v = foot.surface.slope_v;
  const double length = std::sqrt(1.0 + along_u * along_u + along_v * along_v);
  const Vec3 normal{-along_u / length, 1.0 / length, along_v / length};
  const Vec3 from_foot{place.x + placing_.start - foot.u,
                       place.y - (foot.surface.height - placing_.height),
                       place.z - (placing_.offset - foot.v)};
  return {dot(normal, from_foot), frame_along_t1(normal)};
}

SpaceTouches RoadGround::touches(Vec3 place) const noexcept {
  SpaceTouches out;
  // Both comparisons are also false where there is no road.
  if (!(place.y <=
        surface_.bound(place.x + placing_.start, placing_.offset - place.z) - placing_.height))
    return out;
  const RoadFoot straight = straight_foot(place);
  if (!(place.y <= straight.surface.height - placing_.height)) return out;
  RoadFoot foot = straight;
  improve(foot, place, newton_steps);
  out.count = 1;
  out.at[0] = touch_at(foot, place);
  // A point that is deeper than the ground is round may be before the tangent plane of the foot.
  if (!(out.at[0].gap <= 0.0)) out.at[0] = touch_at(straight, place);
  return out;
}

}  // namespace rondo::contact
