// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/road/road_section.hpp"

#include <algorithm>
#include <cmath>

#include "rondo/core/contract.hpp"

namespace rondo::road {
namespace {

constexpr double round_off = 1e-9;  ///< of the length within which slopes are compared

/// Length of the level stretches; the ground continues them for ever [m].
constexpr double level_length = 1.0;
/// A lower step at an end is one of round-off, and is left out [m].
constexpr double least_step = 1e-9;

double slope_of(Vec2 from, Vec2 to) noexcept {
  return (to.y - from.y) / (to.x - from.x);
}

}  // namespace

std::vector<Vec2> section_of(const Surface& surface, double v) {
  const Axis &u_axis = surface.u_axis(), &v_axis = surface.v_axis();
  RONDO_DEMAND(v >= v_axis.first() && v <= v_axis.last(), v, v_axis.first(), v_axis.last());
  const AxisPlace place = v_axis.locate(v);
  const double t = place.fraction;
  std::vector<Vec2> section;
  section.reserve(u_axis.size());
  for (std::size_t i = 0; i < u_axis.size(); ++i) {
    const double right = surface.height_at(i, place.cell),
                 left = surface.height_at(i, place.cell + 1);
    // On a line of the grid the height is that of its point, whatever is beside it.
    const double height = t == 0.0 ? right : t == 1.0 ? left : (1.0 - t) * right + t * left;
    section.push_back({u_axis.position(i), height});
  }
  return section;
}

double height_in(std::span<const Vec2> section, double u) noexcept {
  RONDO_ASSERT(section.size() >= 2, section.size());
  const auto behind = std::lower_bound(section.begin() + 1, section.end() - 1, u,
                                       [](Vec2 p, double at) { return p.x < at; });
  const Vec2 a = *(behind - 1), b = *behind;
  const double t = (u - a.x) / (b.x - a.x);
  return t == 0.0 ? a.y : t == 1.0 ? b.y : (1.0 - t) * a.y + t * b.y;
}

std::vector<Vec2> with_level_ends(std::span<const Vec2> section, const Surface& surface, double v) {
  const Border border = surface.u_axis().border();
  RONDO_DEMAND(border == Border::keep || border == Border::zero, static_cast<int>(border));
  const Vec2 first = section.front(), last = section.back();
  const double before = surface.bilinear(first.x - level_length, v),
               behind = surface.bilinear(last.x + level_length, v);
  const bool step_before = std::abs(before - first.y) > least_step,
             step_behind = std::abs(behind - last.y) > least_step;
  std::vector<Vec2> whole;
  whole.reserve(section.size() + 4);
  whole.push_back({first.x - level_length, step_before ? before : first.y});
  if (step_before) whole.push_back({first.x, before});
  whole.insert(whole.end(), section.begin(), section.end());
  if (step_behind) whole.push_back({last.x, behind});
  whole.push_back({last.x + level_length, step_behind ? behind : last.y});
  return whole;
}

RoadPlace largest_bend(std::span<const Vec2> section, double length,
                       const RoadPart& part) noexcept {
  RONDO_ASSERT(length > 0.0, length);
  const auto counts = [&](std::size_t k) {
    return section[k].x >= part.u_from && section[k + 1].x <= part.u_to &&
           section[k + 1].x > section[k].x;
  };
  const auto middle = [&](std::size_t k) { return 0.5 * (section[k].x + section[k + 1].x); };
  RoadPlace largest;
  for (std::size_t i = 0; i + 2 < section.size(); ++i) {
    if (!counts(i)) continue;
    const double slope = slope_of(section[i], section[i + 1]);
    for (std::size_t k = i + 1; k + 1 < section.size(); ++k) {
      if (middle(k) - middle(i) > length * (1.0 + round_off)) break;
      const double change =
          counts(k) ? std::abs(slope_of(section[k], section[k + 1]) - slope) : 0.0;
      if (change > largest.value) largest = {change, section[i + 1].x, part.v_from};
    }
  }
  return largest;
}

}  // namespace rondo::road
