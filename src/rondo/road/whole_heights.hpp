// SPDX-License-Identifier: BSD-3-Clause
/// @file  The heights at the points of the grid with everything in them.
#pragma once
#include <vector>

#include "rondo/road/road.hpp"

namespace rondo::road {

/// (n_u, n_v) heights [m]: missing ones filled, height of the reference line and banking added.
/// Where Missing::keep leaves them out, the border along v decides: zero gives its offset, none not
/// a number, and all others the last valid height of the row.
[[nodiscard]] std::vector<double> whole_heights(const Road& road, const Edges& edges);

}  // namespace rondo::road
