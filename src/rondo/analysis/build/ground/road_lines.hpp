// SPDX-License-Identifier: BSD-3-Clause
/// @file  What `rondo check` tells about a measured road under a plane body (docs/roads.md,
/// section 3); of a wheel in three dimensions wheel_road.hpp does.
#pragma once
#include "rondo/case/setup.hpp"

namespace rondo::study {

/// Within an element a larger change of slope is warned of: what makes it passes between the nodes.
inline constexpr double told_slope_change = 0.2;

/// Adds lines about the road and the part that the body reaches, and warnings where the body leaves
/// the road and where elements are too long for it. Nothing if the ground is none of a road.
/// @pre motion and contact of the model are set
void tell_road(const Case& c, Setup& s);

}  // namespace rondo::study
