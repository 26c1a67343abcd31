// SPDX-License-Identifier: BSD-3-Clause
/// @file  The part of a road that a wheel can reach, and places on it.
#pragma once
#include <cstddef>
#include <limits>

#include "rondo/road/surface.hpp"

namespace rondo::road {

/// A value and the place where it is found.
struct RoadPlace {
  double value = 0.0;
  double u = 0.0, v = 0.0;  ///< [m]
};

/// By default all of the road.
struct RoadPart {
  double u_from = -std::numeric_limits<double>::infinity();  ///< [m]
  double u_to = std::numeric_limits<double>::infinity();     ///< [m]
  double v_from = -std::numeric_limits<double>::infinity();  ///< [m]
  double v_to = std::numeric_limits<double>::infinity();     ///< [m]
};

/// Cells of the grid that have a point in the part: i from u_begin to u_end - 1, j likewise. At
/// least one each way, the nearest if the part lies beyond the grid.
struct RoadCells {
  std::size_t u_begin = 0, u_end = 0, v_begin = 0, v_end = 0;
};
[[nodiscard]] RoadCells cells_in(const Surface& surface, const RoadPart& part) noexcept;

/// Lengths of an element along u and across, > 0                                         [m]
struct ElementLengths {
  double u = 0.0, v = 0.0;
};

/// The largest change of slope, along u or along v, between two points of a grid line that are at
/// most an element apart: features that change the slope so much within an element pass between its
/// nodes. The place is the first of the two points.
[[nodiscard]] RoadPlace largest_slope_change(const Surface& surface, const ElementLengths& element,
                                             const RoadPart& part = {}) noexcept;

}  // namespace rondo::road
