// SPDX-License-Identifier: BSD-3-Clause
/// @file  What a road is like, in numbers and in the lines that `rondo check` prints.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "rondo/road/road.hpp"
#include "rondo/road/road_part.hpp"
#include "rondo/road/surface.hpp"

namespace rondo::road {

/// Slopes and differences are those of the part, all else of the whole road.
struct RoadReport {
  RoadPart part;
  double lowest = 0.0,
         highest = 0.0;          ///< of the points of the grid, slope and banking included [m]
  double missing_share = 0.0;    ///< of the heights in the file                            [-]
  RoadPlace steepest;            ///< largest slope of the smooth surface, in any direction [-]
  RoadPlace largest_difference;  ///< of the smooth surface to the bilinear one             [m]
  double rms_difference = 0.0;   ///< root mean square of this difference                   [m]
  double seam_u = 0.0;  ///< largest height difference of the first and the last row             [m]
  double seam_v = 0.0;  ///< likewise of the right and the left edge [m]
  std::size_t samples = 0;  ///< points where both surfaces were evaluated
};

/// Both surfaces are compared at the quarters of each cell, 4 x 4 places, of more than 500,000
/// cells at 2 x 2 of them, the first quarter and the half.
[[nodiscard]] RoadReport report_of(const Road& road, const Surface& surface,
                                   const RoadPart& part = {});

/// Whole sentences: file and format, extent and grid, heights, missing ones, slopes, the difference
/// of both surfaces, a seam where the road repeats, and what the reader noticed.
[[nodiscard]] std::vector<std::string> lines_of(const Road& road, const RoadReport& report,
                                                const Edges& edges);

}  // namespace rondo::road
