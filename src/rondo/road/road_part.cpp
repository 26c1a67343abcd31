// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/road/road_part.hpp"

#include <algorithm>
#include <cmath>

namespace rondo::road {
namespace {

struct CellRange {
  std::size_t begin, end;
};

CellRange cells_between(const Axis& axis, double from, double to) noexcept {
  const auto cell = [&](double x) {
    return axis.locate(std::clamp(x, axis.first(), axis.last())).cell;
  };
  const std::size_t first = cell(from);
  return {first, std::max(first, cell(std::max(from, to))) + 1};
}

/// Changes of one component of the slope along one line of n points.
template <class Slope, class Keep>
void look_along(const Axis& axis, CellRange points, double length, const Slope& slope,
                const Keep& keep) noexcept {
  for (std::size_t i = points.begin; i < points.end; ++i)
    for (std::size_t k = i + 1; k < points.end; ++k) {
      if (axis.position(k) - axis.position(i) > length * (1.0 + 1e-9)) break;
      keep(i, std::abs(slope(k) - slope(i)));
    }
}

}  // namespace

RoadCells cells_in(const Surface& surface, const RoadPart& part) noexcept {
  const CellRange u = cells_between(surface.u_axis(), part.u_from, part.u_to);
  const CellRange v = cells_between(surface.v_axis(), part.v_from, part.v_to);
  return {u.begin, u.end, v.begin, v.end};
}

RoadPlace largest_slope_change(const Surface& surface, const ElementLengths& element,
                               const RoadPart& part) noexcept {
  const RoadCells cells = cells_in(surface, part);
  const Axis &u = surface.u_axis(), &v = surface.v_axis();
  RoadPlace largest;
  const auto keep = [&](std::size_t i, std::size_t j, double change) {
    if (change > largest.value) largest = {change, u.position(i), v.position(j)};
  };
  for (std::size_t j = cells.v_begin; j <= cells.v_end; ++j)
    look_along(
        u, {cells.u_begin, cells.u_end + 1}, element.u,
        [&](std::size_t i) { return surface.slopes_at(i, j).u; },
        [&](std::size_t i, double change) { keep(i, j, change); });
  for (std::size_t i = cells.u_begin; i <= cells.u_end; ++i)
    look_along(
        v, {cells.v_begin, cells.v_end + 1}, element.v,
        [&](std::size_t j) { return surface.slopes_at(i, j).v; },
        [&](std::size_t j, double change) { keep(i, j, change); });
  return largest;
}

}  // namespace rondo::road
