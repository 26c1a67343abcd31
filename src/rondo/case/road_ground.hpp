// SPDX-License-Identifier: BSD-3-Clause
/// @file  The ground of a plane body from a measured road: the section of the road at one v
/// (docs/roads.md, section 3).
#pragma once
#include "rondo/case/case_values.hpp"
#include "rondo/road/road.hpp"

namespace rondo::study {

/// Reads ground.road and makes the points of the ground from it: x is u - road_start, and y is the
/// height without that at x = 0. Faults of the keys and of the file are collected in `in`.
/// @pre all keys are read
void take_road(CaseValues& in, Case& c);

/// The borders of the road as the case asks for them. @pre a road is read
[[nodiscard]] road::Edges edges_of(const RoadCase& road);

}  // namespace rondo::study
